#include "server/haptics/friction.hpp"

#include <algorithm>
#include <span>

namespace mechane::haptics {
namespace {

constexpr double kStiffnessBound = 0.1;
constexpr double kDampingBound = 0.3;
constexpr double kDampsBelow_m_per_s = 0.02;

}  // namespace

Spring bounded_spring(const state::HapticMaterial& material, double m_eff_kg) noexcept {
  return {std::min(material.stiffness_n_per_m, kStiffnessBound * m_eff_kg / (kTickSeconds * kTickSeconds)),
          std::min(material.damping_ns_per_m, kDampingBound * m_eff_kg / kTickSeconds),
          std::min(material.viscosity_ns_per_m, kDampingBound * m_eff_kg / kTickSeconds)};
}

Vec3 sticking_friction(const Rubbing& rubbing, const Spring& spring, Stretch& stretch) noexcept {
  if (rubbing.normal_n <= 0 || spring.stiffness_n_per_m <= 0) {
    stretch = {};
    return Vec3::Zero();
  }
  const double cone_n = hand::friction_cone_n(stretch.slides, spring.stiffness_n_per_m * stretch.s_W.norm(),
                                              rubbing.material.static_friction * rubbing.normal_n,
                                              rubbing.material.dynamic_friction * rubbing.normal_n);
  const Vec3 damping_n = spring.damping_ns_per_m * rubbing.sliding_W();
  return hand::spring_friction(stretch.s_W, spring.stiffness_n_per_m, damping_n, cone_n);
}

Vec3 damping_friction(const Rubbing& rubbing) noexcept {
  const Vec3 v_tangent = rubbing.sliding_W();
  const double speed = v_tangent.norm();
  if (speed <= 0 || rubbing.normal_n <= 0) return Vec3::Zero();
  const double mu = speed < kDampsBelow_m_per_s ? rubbing.material.static_friction : rubbing.material.dynamic_friction;
  return -mu * rubbing.normal_n / std::max(speed, kDampsBelow_m_per_s) * v_tangent;
}

FrictionAnchors::FrictionAnchors(state::UserState& user) noexcept : user_(user) {
  if (!user.jumped) before_.assign(user.anchors.begin(), user.anchors.begin() + user.anchor_count);
  user.anchor_count = 0;
}

/// The tip of a one-point device is a ball that does not roll.
Pose FrictionAnchors::X_WS(std::size_t segment) const noexcept {
  Pose X = user_.X_WS[segment];
  if (user_.sample.kind == hand::HandKind::one_point) X.R = Quat::Identity();
  return X;
}

std::optional<Stretch> FrictionAnchors::stretch_of(const ContactPatch& patch, const Pose& X_WB) const noexcept {
  for (const state::FrictionAnchor& anchor : before_) {
    if (anchor.body != patch.body || anchor.segment != patch.segment) continue;
    const Vec3 p_BS_W = X_WS(patch.segment) * anchor.p_SA - X_WB * anchor.p_BA;
    return Stretch{hand::along_surface(p_BS_W, patch.n_BH_W), anchor.slides};
  }
  return {};
}

// The points are taken anew in each tick, where the touch is now, so that a finger may roll and a touch may wander.
void FrictionAnchors::keep(const ContactPatch& patch, const Pose& X_WB, const Stretch& stretch) noexcept {
  state::FrictionAnchor& anchor = user_.anchors[user_.anchor_count++];
  anchor.body = patch.body;
  anchor.segment = patch.segment;
  anchor.slides = stretch.slides;
  anchor.p_SA = X_WS(patch.segment).inverse() * patch.p_WC;
  anchor.p_BA = X_WB.inverse() * (patch.p_WC - stretch.s_W);
}

}  // namespace mechane::haptics
