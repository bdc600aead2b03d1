#include "client-sdk/haptic/virtual_device.hpp"

#include <cmath>

namespace mechane::haptic {

void VirtualDevice::intend(const HandIntent& intent) noexcept {
  intent_ = intent;
  if (placed_) return;
  X_WH_ = intent.X_WH;
  placed_ = true;
}

client::HandSample VirtualDevice::read(Duration dt) noexcept {
  const double dt_s = to_seconds(dt);
  if (dt_s > 0) {
    const double k = arm_.stiffness_n_per_m;
    const double b = 2 * arm_.damping_ratio * std::sqrt(k * arm_.mass_kg);
    // Implicit in the arm's spring and damper, and so stable at any rate of the loop, also after a stall.
    const Vec3 pull = k * (intent_.X_WH.p - X_WH_.p - dt_s * V_WH_.v) - b * V_WH_.v + force_.force_W.f;
    V_WH_.v += dt_s * pull / (arm_.mass_kg + dt_s * b + dt_s * dt_s * k);
    X_WH_.p += dt_s * V_WH_.v;
    V_WH_.w = rotation_vector(intent_.X_WH.R * X_WH_.R.conjugate()) / dt_s;
    X_WH_.R = intent_.X_WH.R;
  }
  client::HandSample input;
  input.kind = intent_.kind;
  input.side = side_;
  input.X_WH = X_WH_;
  input.V_WH = V_WH_;
  input.joints = intent_.joints;
  input.grasp_intent = intent_.grasp_intent;
  return input;
}

}  // namespace mechane::haptic
