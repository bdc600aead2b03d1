#include "server/haptics/held_path.hpp"

#include <algorithm>
#include <span>

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

/// Whether a body without joints is in one hand, and nothing else can hold it.
bool is_free(const state::WorldDescription& description, const state::WorldState& state, BodyId body) {
  if (description.bodies[body.index()].collides) return false;
  const auto bears = [&](const JointDescription& joint) {
    const auto j = static_cast<std::size_t>(&joint - description.joints.data());
    return state.joints[j].enabled && (joint.body1 == body || joint.body2 == body);
  };
  const auto ties = [&](const state::Coupling& tie) {
    const auto nodes = std::span(tie.nodes).first(tie.node_count);
    return tie.enabled && (tie.body1 == body || tie.body2 == body ||
                           std::ranges::any_of(nodes, [&](const auto& node) { return node.body == body; }));
  };
  return std::ranges::none_of(description.joints, bears) && std::ranges::none_of(state.couplings, ties) &&
         std::ranges::count_if(state.users, [&](const auto& user) { return user.holds(body); }) == 1;
}

HeldPath weight(const state::WorldDescription& description, const state::WorldState& state, const state::Grasp& grasp) {
  const state::BodyDescription& body = description.bodies[grasp.body.index()];
  if (!state[grasp.body].use_gravity || description.gravity_W.isZero(0)) return {};
  HeldPath path;
  path.kind = HeldPath::Kind::free;
  path.p_HG = grasp.X_HB * body.p_BCm;
  path.axis_W = description.gravity_W.normalized();
  path.along_n = std::min(body.mass_kg * body.effort_scale * description.gravity_W.norm(), grasp.force_limit_n);
  path.stiffness_n_per_m = body.haptic.stiffness_n_per_m;
  return path;
}

}  // namespace

HeldPath held_path(const state::WorldDescription& description, const state::WorldState& state,
                   const state::UserState& user) noexcept {
  const state::Grasp& grasp = user.grasp;
  if (!grasp.active || !state[grasp.body].movable) return {};
  const std::size_t j = only_joint(description, state, grasp.body);
  if (j == description.joints.size())
    return is_free(description, state, grasp.body) ? weight(description, state, grasp) : HeldPath{};
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
