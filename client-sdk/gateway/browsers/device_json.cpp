#include "client-sdk/gateway/browsers/device_json.hpp"

#include <array>

namespace mechane::gateway {

nlohmann::json device_json(const client::DeviceReport& device) {
  constexpr std::array kStates{"none",         "preparing", "ready", "let-go", "not-ready",
                               "uncalibrated", "warm",      "hot",   "lost"};
  static_assert(kStates.size() == static_cast<std::size_t>(client::DeviceState::lost) + 1);
  return {{"user", device.user},
          {"name", device.name},
          {"state", kStates[static_cast<std::size_t>(device.state)]},
          {"kind", device.kind == client::HandKind::glove ? "glove" : "one-point"},
          {"side", device.side == client::HandSide::left ? "left" : "right"}};
}

}  // namespace mechane::gateway
