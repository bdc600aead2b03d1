// What staff ask of the haptic devices of a kiosk, and what their programs answer: of a draft's trial, and of a museum's kiosk.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include <mechane/client/client.hpp>
#include <mechane/client/devices.hpp>

namespace mechane::gateway {

/// {"user": 0, "action": "test"}, and with the action "place": {"place": {"center_m": [X, Y, Z], "turn_rad": A, "scale": S}}. Errors:
/// invalid_value.
[[nodiscard]] Expected<client::DeviceRequest> parse_device_order(const std::string& body);

/// On the loop's thread.
class AskedDevices {
 public:
  /// Sends the request; look() tells the answer once it came. Errors: conflict (the kiosk has no such device), io_failure.
  [[nodiscard]] Expected<void> ask(client::Client& client, const client::DeviceRequest& request, TimePoint now);
  /// Those that are there, each with what staff see of it and what became of the last request.
  [[nodiscard]] nlohmann::json look(client::Client& client, std::span<const client::DeviceReport> reports,
                                    TimePoint now) const;

 private:
  struct Asked {
    std::uint64_t id = 0;
    TimePoint at;
  };
  std::map<std::uint32_t, Asked> asked_;  ///< the last one, by the device's user
};

}  // namespace mechane::gateway
