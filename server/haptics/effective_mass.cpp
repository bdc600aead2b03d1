#include "server/haptics/effective_mass.hpp"

#include <limits>

namespace mechane::haptics {
namespace {

using state::JointDescription;
using state::JointKind;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// The enabled joint that ties this body, or null. A body with several is rare and only feels heavier.
const JointDescription* joint_of(const state::WorldDescription& description, const state::WorldState& state,
                                 BodyId body) {
  for (std::size_t j = 0; j < description.joints.size(); ++j) {
    if (description.joints[j].body2 == body && state.joints[j].enabled) return &description.joints[j];
  }
  return nullptr;
}

double hinge_mass(const state::BodyDescription& body, const Pose& X_WB, const JointDescription& joint, const Vec3& p_WQ,
                  const Vec3& n_W) {
  const Pose X_WJ = X_WB * joint.X_B2J;
  const Vec3 axis_W = X_WJ.rotate(Vec3::UnitZ());
  const double lever_m = axis_W.dot((p_WQ - X_WJ.p).cross(n_W));
  // Steiner: the inertia about the axis from that about the centre of mass.
  const Vec3 axis_B = X_WB.R.conjugate() * axis_W;
  const Vec3 offset_W = X_WB * body.p_BCm - X_WJ.p;
  const double distance2 = offset_W.squaredNorm() - std::pow(offset_W.dot(axis_W), 2);
  const double inertia = axis_B.dot(body.inertia_kg_m2 * axis_B) + body.mass_kg * distance2;
  return lever_m == 0 ? kInfinite : body.effort_scale * inertia / (lever_m * lever_m);
}

double free_mass(const state::BodyDescription& body, const Pose& X_WB, const Vec3& p_WQ, const Vec3& n_W) {
  const Vec3 r_B = X_WB.R.conjugate() * (p_WQ - X_WB * body.p_BCm);
  const Vec3 n_B = X_WB.R.conjugate() * n_W;
  const Vec3 turn = r_B.cross(n_B);
  const double inverse = 1 / body.mass_kg + turn.dot(body.inertia_kg_m2.inverse() * turn);
  return body.effort_scale / inverse;
}

}  // namespace

double effective_mass_kg(const state::WorldDescription& description, const state::WorldState& state, BodyId body,
                         const Vec3& p_WQ, const Vec3& n_W) noexcept {
  const state::BodyDescription& of = description.bodies[body.index()];
  if (of.fixed || !state[body].movable) return kInfinite;
  const Pose& X_WB = state[body].X_WB;
  const JointDescription* joint = joint_of(description, state, body);
  if (joint == nullptr) return free_mass(of, X_WB, p_WQ, n_W);
  if (joint->kind == JointKind::hinge) return hinge_mass(of, X_WB, *joint, p_WQ, n_W);
  if (joint->kind == JointKind::slider) {
    const double along = (X_WB * joint->X_B2J).rotate(Vec3::UnitX()).dot(n_W);
    return along == 0 ? kInfinite : of.effort_scale * of.mass_kg / (along * along);
  }
  return free_mass(of, X_WB, p_WQ, n_W);
}

}  // namespace mechane::haptics
