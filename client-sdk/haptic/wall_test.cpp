#include "client-sdk/haptic/wall_test.hpp"

#include <algorithm>
#include <utility>

namespace mechane::haptic {
namespace {

constexpr double kMaxForceN = 1;
constexpr double kStiffness = 200;  // N/m: what a Phantom's own damping keeps steady without a hand
constexpr double kBelow_m = 0.01;
constexpr double kHalfClosed_rad = 1.5;  // of the sum of a finger's three flexions
constexpr double kFingerNPerRad = 2;

/// The force on a finger that is more than half closed, N.
double hold(const client::HandSample& hand, std::size_t finger) {
  const auto* const flexions = &hand.joints[finger * hand::kFingerJoints + 1];
  return std::max(0.0, kFingerNPerRad * (flexions[0] + flexions[1] + flexions[2] - kHalfClosed_rad));
}

}  // namespace

Expected<WallTest> WallTest::make(Device& device, double stiffest_n_per_m) {
  hand::GovernorConfig limits = device.limits();
  limits.max_force_n = std::min({limits.max_force_n, device.continuous_force_n(), kMaxForceN});
  limits.max_torque_nm = 0;
  limits.max_finger_force_n = std::min(limits.max_finger_force_n, kMaxForceN);
  limits.strict_energy = true;
  auto governor = hand::ForceGovernor::make(limits);
  if (!governor) return tl::unexpected(governor.error());
  const double stiffness = stiffest_n_per_m > 0 ? std::min(kStiffness, stiffest_n_per_m) : kStiffness;
  return WallTest(device, stiffness, *governor);
}

void WallTest::tick(Duration dt, bool engaged) noexcept {
  const client::HandSample hand = device_.read(dt);
  const DeviceCondition before = std::exchange(report_.condition, device_.condition());
  report_.was_lost |= report_.condition == DeviceCondition::lost && before != DeviceCondition::lost;
  ++report_.ticks;
  const bool ready = report_.condition == DeviceCondition::ready;
  if (!ready) {
    governor_.reset(governed_);
    placed_ = false;
  } else if (!placed_) {
    p_WF_ = hand.X_WH.p - Vec3(0, kBelow_m, 0);
    placed_ = true;
  }
  energy_j_ += rendered_.force_W.f.dot(hand.X_WH.p - report_.p_WH);  // zero times anything at the start
  report_.energy_out_j = std::max(report_.energy_out_j, energy_j_);
  report_.p_WH = hand.X_WH.p;
  report_.depth_m = placed_ ? std::max(0.0, p_WF_.y() - hand.X_WH.p.y()) : 0;
  hand::GovernorInput wanted;
  wanted.wanted_W.f.y() = stiffness_ * report_.depth_m;
  for (std::size_t i = 0; i < hand::kFingers; ++i)
    wanted.finger_force_n[i] = hold(hand, i);
  wanted.V_WH = hand.V_WH;
  wanted.engaged = ready && engaged;
  wanted.touching = report_.depth_m > 0;
  rendered_ = governor_.apply(governed_, wanted, dt);
  device_.write(rendered_);
  report_.force_n = rendered_.force_W.f.norm();
  report_.force_max_n = std::max(report_.force_max_n, report_.force_n);
  report_.finger_force_max_n = std::max(report_.finger_force_max_n, std::ranges::max(rendered_.finger_force_n));
}

bool WallTest::rests() const noexcept {
  return rendered_.force_W.f.isZero(0) && std::ranges::max(rendered_.finger_force_n) <= 0;
}

}  // namespace mechane::haptic
