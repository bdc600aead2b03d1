// What staff and the programs of devices tell each other, to the wire and from it.
#pragma once

#include <mechane/client/devices.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::client {

/// All but kiosk, user and the sample's number, session and time.
void write(const DeviceDetails& details, proto::DeviceStatus& wire);
void write(const DevicePlace& place, proto::WireDevicePlace& wire);

/// False, with `out` in an unspecified state, where the sample is of another protocol version, the kiosk has no valid name, the user does
/// not exist, a number is not finite, negative or over its limit, or check() refuses the place.
[[nodiscard]] bool parse(const proto::DeviceStatus& wire, DeviceDetails& out);
/// Also checked: the id is not 0, and the action exists.
[[nodiscard]] bool parse(const proto::DeviceRequest& wire, DeviceRequest& out);

}  // namespace mechane::client
