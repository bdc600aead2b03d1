#include "client-sdk/client/device_parse.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "client-sdk/client/clean_text.hpp"
#include <mechane/proto/convert.hpp>
#include <mechane/proto/names.hpp>

namespace mechane::client {
namespace {

static_assert(mechane_device_action_place == static_cast<int>(DeviceAction::place));
static_assert(mechane_device_action_calibrate == static_cast<int>(DeviceAction::calibrate));
static_assert(mechane_device_action_test == static_cast<int>(DeviceAction::test));
static_assert(mechane_device_action_end_test == static_cast<int>(DeviceAction::end_test));

/// A double on its way to a wire that has floats.
float narrow(double value) {
  return static_cast<float>(value);
}

void write_vector(const Vec3& from, float (&to)[3]) {
  std::ranges::transform(from, std::begin(to), narrow);
}

bool parse_place(const proto::WireDevicePlace& wire, DevicePlace& out) {
  out = {proto::to_vec3(wire.p_WD), wire.turn_rad, wire.scale};
  return check(out).has_value();
}

bool parse_limits(const proto::DeviceStatus& wire, DeviceLimits& out) {
  out = {wire.wanted_hz,
         wire.peak_force_n,
         wire.continuous_force_n,
         wire.peak_torque_nm,
         wire.peak_finger_force_n,
         wire.max_stiffness_n_per_m,
         proto::to_vec3(wire.workspace_min_m),
         proto::to_vec3(wire.workspace_max_m)};
  return proto::all_finite(wire.workspace_min_m) && proto::all_finite(wire.workspace_max_m) &&
         (out.workspace_min_D_m.array() <= out.workspace_max_D_m.array()).all();
}

/// Of what is a count, a size or a strength.
bool are_amounts(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value) && value >= 0; });
}

}  // namespace

Expected<void> check(const DevicePlace& place) {
  if (!(place.p_WD.cwiseAbs().maxCoeff() <= hand::kFarthestHand_m))
    return fail(ErrorCode::invalid_value, "the middle of the workspace is too far away", "place",
                fmt::format("give three numbers of metres, each within {}", hand::kFarthestHand_m));
  if (!(std::abs(place.turn_rad) <= 2 * kPi))
    return fail(ErrorCode::invalid_value, "the device is turned by more than once around", "place",
                "give an angle within 360 degrees");
  if (place.scale >= 1 && place.scale <= DevicePlace::kMostScale) return {};
  return fail(ErrorCode::invalid_value, "the scale of the workspace is out of its range", "place",
              fmt::format("give metres of the world for one of the device's, 1 to {}", DevicePlace::kMostScale));
}

Expected<void> check(const DeviceRequest& request) {
  if (request.user >= hand::kMaxUsers)
    return fail(ErrorCode::invalid_value, fmt::format("a kiosk has no user {}", request.user), "user",
                "choose one of 0 to 3");
  return request.action == DeviceAction::place ? check(request.place) : Expected<void>();
}

void write(const DevicePlace& place, proto::WireDevicePlace& wire) {
  write_vector(place.p_WD, wire.p_WD);
  wire.turn_rad = narrow(place.turn_rad);
  wire.scale = narrow(place.scale);
}

void write(const DeviceDetails& details, proto::DeviceStatus& wire) {
  wire.wanted_hz = narrow(details.limits.wanted_hz);
  wire.peak_force_n = narrow(details.limits.peak_force_n);
  wire.continuous_force_n = narrow(details.limits.continuous_force_n);
  wire.peak_torque_nm = narrow(details.limits.peak_torque_nm);
  wire.peak_finger_force_n = narrow(details.limits.peak_finger_force_n);
  wire.max_stiffness_n_per_m = narrow(details.limits.max_stiffness_n_per_m);
  write_vector(details.limits.workspace_min_D_m, wire.workspace_min_m);
  write_vector(details.limits.workspace_max_D_m, wire.workspace_max_m);
  write(details.place, wire.place);
  wire.rate_hz = narrow(details.rate_hz);
  wire.late_us = narrow(details.late_us);
  write_vector(details.p_WH, wire.p_WH);
  wire.force_n = narrow(details.force_n);
  wire.temperature = narrow(details.temperature);
  wire.testing = details.testing;
  wire.test_force_n = narrow(details.test_force_n);
  wire.test_energy_j = narrow(details.test_energy_j);
  wire.answered = details.answered;
  proto::set_text(wire.refusal, details.refusal);
}

bool parse(const proto::DeviceStatus& wire, DeviceDetails& out) {
  if (wire.protocol != proto::kProtocol || !proto::is_name(proto::text_of(wire.kiosk))) return false;
  if (wire.user >= hand::kMaxUsers || !parse_limits(wire, out.limits) || !parse_place(wire.place, out.place))
    return false;
  if (!are_amounts({wire.wanted_hz, wire.peak_force_n, wire.continuous_force_n, wire.peak_torque_nm,
                    wire.peak_finger_force_n, wire.max_stiffness_n_per_m, wire.rate_hz, wire.late_us, wire.force_n,
                    wire.test_force_n, wire.test_energy_j}))
    return false;
  if (!proto::all_finite(wire.p_WH) || !std::isfinite(wire.temperature)) return false;
  out.user = wire.user;
  out.rate_hz = wire.rate_hz;
  out.late_us = wire.late_us;
  out.p_WH = proto::to_vec3(wire.p_WH);
  out.force_n = wire.force_n;
  out.temperature = wire.temperature;
  out.testing = wire.testing;
  out.test_force_n = wire.test_force_n;
  out.test_energy_j = wire.test_energy_j;
  out.answered = wire.answered;
  out.refusal = clean(wire.refusal);
  return true;
}

bool parse(const proto::DeviceRequest& wire, DeviceRequest& out) {
  if (wire.protocol != proto::kProtocol || !proto::is_name(proto::text_of(wire.kiosk)) || wire.id == 0) return false;
  if (wire.user >= hand::kMaxUsers || wire.action > mechane_device_action_end_test) return false;
  out.id = wire.id;
  out.user = wire.user;
  out.action = static_cast<DeviceAction>(wire.action);
  return out.action != DeviceAction::place || parse_place(wire.place, out.place);
}

}  // namespace mechane::client
