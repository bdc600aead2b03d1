#include "client-sdk/haptic/simulated_stylus.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::haptic {
namespace {

constexpr double kStep_s = 20e-6;

}  // namespace

Vec3 SimulatedStylus::rounded(const Vec3& p) const noexcept {
  const double step = config_.resolution_m;
  return step > 0 ? Vec3(step * (p / step).array().round().matrix()) : p;
}

void SimulatedStylus::move(double dt_s) noexcept {
  Vec3 force = force_W() + config_.load_W - config_.viscous_ns_per_m * v_WH_;
  double mass_kg = config_.mass_kg;
  if (config_.hand) {
    const ArmConfig& arm = *config_.hand;
    mass_kg += arm.mass_kg;
    const double damping = 2 * arm.damping_ratio * std::sqrt(arm.stiffness_n_per_m * arm.mass_kg);
    force += arm.stiffness_n_per_m * (intent_.X_WH.p - p_WH_) - damping * v_WH_;
  }
  v_WH_ += dt_s / mass_kg * force;
  // Dry friction takes away speed, and at rest holds.
  const double speed = v_WH_.norm();
  const double slower = std::max(0.0, speed - config_.coulomb_n / mass_kg * dt_s);
  if (speed > 0) v_WH_ *= slower / speed;
  p_WH_ += dt_s * v_WH_;
}

client::HandSample SimulatedStylus::read(Duration dt) noexcept {
  const double dt_s = to_seconds(std::max(dt, Duration{0}));
  const int steps = static_cast<int>(std::ceil(dt_s / kStep_s));
  for (int i = 0; i < steps; ++i)
    move(dt_s / steps);
  client::HandSample sample;
  sample.X_WH = {rounded(p_WH_), intent_.X_WH.R};
  sample.grasp_intent = intent_.grasp_intent;
  sample.V_WH = speed_.note(sample.X_WH, dt);
  return sample;
}

}  // namespace mechane::haptic
