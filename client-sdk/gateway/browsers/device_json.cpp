#include "client-sdk/gateway/browsers/device_json.hpp"

#include <array>

#include "client-sdk/gateway/browsers/vector_json.hpp"

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

nlohmann::json details_json(const client::DeviceDetails& details) {
  const client::DeviceLimits& limits = details.limits;
  nlohmann::json out{{"wanted_hz", limits.wanted_hz},
                     {"peak_force_n", limits.peak_force_n},
                     {"continuous_force_n", limits.continuous_force_n},
                     {"peak_torque_nm", limits.peak_torque_nm},
                     {"peak_finger_force_n", limits.peak_finger_force_n},
                     {"max_stiffness_n_per_m", limits.max_stiffness_n_per_m},
                     {"rate_hz", details.rate_hz},
                     {"late_us", details.late_us},
                     {"hand_m", vector_json(details.p_WH)},
                     {"force_n", details.force_n},
                     {"testing", details.testing},
                     {"test_force_n", details.test_force_n},
                     {"test_energy_j", details.test_energy_j}};
  out["place"] = {{"center_m", vector_json(details.place.p_WD)},
                  {"turn_rad", details.place.turn_rad},
                  {"scale", details.place.scale}};
  if (limits.workspace_min_D_m != limits.workspace_max_D_m)
    out["workspace_m"] = {{"least", vector_json(limits.workspace_min_D_m)},
                          {"greatest", vector_json(limits.workspace_max_D_m)}};
  if (details.temperature >= 0) out["temperature"] = details.temperature;
  return out;
}

}  // namespace mechane::gateway
