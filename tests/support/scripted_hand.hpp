// A hand that plays a fixed course on a crank: reach, grasp, turn, release. The same samples whatever the world does.
#pragma once

#include <algorithm>
#include <cmath>

#include "server/state/input.hpp"

namespace mechane::test {

/// Samples of a one-point device at 1 kHz. `t_s` since the start: 0.3 s at the handle, then grasp, from 0.6 s on round the axis.
class ScriptedHand {
 public:
  ScriptedHand(const Vec3& p_WGrip, const Pose& X_WAxis, double rate_rad_per_s, const Vec3& offset_W = Vec3::Zero())
      : p_WGrip_(p_WGrip), X_WAxis_(X_WAxis), rate_(rate_rad_per_s), offset_W_(offset_W) {}

  [[nodiscard]] state::UserInput sample(std::uint64_t tick) const {
    const double t_s = static_cast<double>(tick) * kTickSeconds;
    state::UserInput input;
    input.present = true;
    input.fresh = true;
    input.sample.session = 7;
    input.sample.sequence = tick + 1;
    input.sample.X_WH.p = position(t_s);
    input.sample.V_WH.v = (position(t_s + 1e-4) - position(t_s - 1e-4)) / 2e-4;
    input.sample.grasp_intent = t_s > 0.3 ? 1.0 : 0.0;
    return input;
  }

 private:
  [[nodiscard]] Vec3 position(double t_s) const {
    const double turning_s = std::max(0.0, t_s - 0.6);
    const double ramp_s = 0.5;
    const double angle =
        turning_s < ramp_s ? rate_ * turning_s * turning_s / (2 * ramp_s) : rate_ * (turning_s - ramp_s / 2);
    const Vec3 arm = X_WAxis_.inverse() * p_WGrip_;
    return X_WAxis_ * Vec3(Eigen::AngleAxisd(angle, Vec3::UnitZ()) * arm) + offset_W_;
  }

  Vec3 p_WGrip_;
  Pose X_WAxis_;
  double rate_;
  Vec3 offset_W_;
};

}  // namespace mechane::test
