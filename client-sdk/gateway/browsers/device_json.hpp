// A haptic device, as the API tells of it.
#pragma once

#include <nlohmann/json.hpp>

#include <mechane/client/devices.hpp>
#include <mechane/client/types.hpp>

namespace mechane::gateway {

/// {"user", "name", "state", "kind", "side"}: see STREAM.md.
[[nodiscard]] nlohmann::json device_json(const client::DeviceReport& device);
/// In SI units, as their names say.
[[nodiscard]] nlohmann::json details_json(const client::DeviceDetails& details);

}  // namespace mechane::gateway
