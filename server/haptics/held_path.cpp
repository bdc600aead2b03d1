#include "server/haptics/held_path.hpp"

namespace mechane::haptics {
namespace {

using hand::HeldPath;
using state::JointDescription;
using state::JointKind;

// A grip nearer to its hinge's axis has no path to speak of.
constexpr double kLeastRadius_m = 0.02;

/// The enabled joint that moves this body, where there is just one; else the number of joints.
std::size_t only_joint(const state::WorldDescription& description, const state::WorldState& state, BodyId body) {
  const std::size_t none = description.joints.size();
  std::size_t found = none;
  for (std::size_t j = 0; j < none; ++j) {
    if (description.joints[j].body2 != body || !state.joints[j].enabled) continue;
    if (found != none) return none;
    found = j;
  }
  return found;
}

}  // namespace

HeldPath held_path(const state::WorldDescription& description, const state::WorldState& state,
                   const state::UserState& user) noexcept {
  const state::Grasp& grasp = user.grasp;
  if (!grasp.active || !state[grasp.body].movable) return {};
  const std::size_t j = only_joint(description, state, grasp.body);
  if (j == description.joints.size()) return {};
  const JointDescription& joint = description.joints[j];
  if (joint.kind == JointKind::ball || state.joints[j].pitch_m_per_rad != 0) return {};
  // Not one that is only held still for now: agents and machines move such bodies themselves.
  if (joint.body1 && !description.bodies[joint.body1.index()].fixed) return {};

  const Pose X_WJ = (joint.body1 ? state[joint.body1].X_WB : Pose{}) * joint.X_B1J;
  const Vec3 p_WG = state[grasp.body].X_WB * grasp.p_BG;
  const state::HapticMaterial& material = description.bodies[grasp.body.index()].haptic;
  HeldPath path;
  path.p_HG = grasp.X_HB * grasp.p_BG;
  path.stiffness_n_per_m = material.stiffness_n_per_m;
  path.damping_ns_per_m = material.damping_ns_per_m;
  path.limit_n = grasp.force_limit_n;
  if (joint.kind == JointKind::slider) {
    path.kind = HeldPath::Kind::line;
    path.axis_W = X_WJ.rotate(Vec3::UnitX());
    path.p_W = p_WG;
    path.along_n = grasp.reaction_W.f.dot(path.axis_W);
    return path;
  }
  path.axis_W = X_WJ.rotate(Vec3::UnitZ());
  path.p_W = X_WJ.p + (p_WG - X_WJ.p).dot(path.axis_W) * path.axis_W;
  const Vec3 arm_W = p_WG - path.p_W;
  path.radius_m = arm_W.norm();
  if (path.radius_m < kLeastRadius_m) return {};
  path.kind = HeldPath::Kind::circle;
  path.along_n = grasp.reaction_W.f.dot(path.axis_W.cross(arm_W)) / path.radius_m;
  return path;
}

}  // namespace mechane::haptics
