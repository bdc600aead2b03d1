// Friction between a hand and a body: a spring holds the hand to where it touched, and slides after it where it pulls too hard.
#pragma once

#include <array>
#include <optional>

#include "server/hand/friction_spring.hpp"
#include "server/haptics/contact_patch.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

struct Spring {
  double stiffness_n_per_m = 0;
  double damping_ns_per_m = 0;
  double viscosity_ns_per_m = 0;  ///< bounded as the damping is
};

/// The material's spring, weakened for a body that feels as light as `m_eff_kg` in the spring's direction: an explicit spring or damper
/// must stay well below what would reverse the body's motion within one step, or it would oscillate.
[[nodiscard]] Spring bounded_spring(const state::HapticMaterial& material, double m_eff_kg) noexcept;

/// One touch, as friction sees it.
struct Rubbing {
  Vec3 n_BH_W;          ///< unit, from the body into the hand
  double normal_n = 0;  ///< force along it
  Vec3 v_rel_W;         ///< of the hand's surface over the body's, m/s
  const state::HapticMaterial& material;

  /// The velocity's part along the surface.
  [[nodiscard]] Vec3 sliding_W() const noexcept { return hand::along_surface(v_rel_W, n_BH_W); }
};

/// How far the hand has gone along the surface from where it stuck.
struct Stretch {
  Vec3 s_W = Vec3::Zero();  ///< m, perpendicular to the normal
  bool slides = false;      ///< dynamic friction holds, not static
};

/// The force on the hand, N in W: hand::spring_friction(), with static friction until the hand slides, and dynamic friction until it goes
/// back. A hand at rest does not creep, and no slope is steeper than the spring's.
[[nodiscard]] Vec3 sticking_friction(const Rubbing& rubbing, const Spring& spring, Stretch& stretch) noexcept;

/// The friction of journals before StateVersion::with_anchors: it falls linearly to zero with the speed, and so never holds.
[[nodiscard]] Vec3 damping_friction(const Rubbing& rubbing) noexcept;

/// The stretches of one user's touches from one tick to the next. Lives for one tick; allocates nothing.
class FrictionAnchors {
 public:
  /// The user's anchors are those of the last tick; from now on they are those that are kept.
  explicit FrictionAnchors(state::UserState& user) noexcept;

  /// None for a touch that was not there in the last tick.
  [[nodiscard]] std::optional<Stretch> stretch_of(const ContactPatch& patch, const Pose& X_WB) const noexcept;
  void keep(const ContactPatch& patch, const Pose& X_WB, const Stretch& stretch) noexcept;

 private:
  [[nodiscard]] Pose X_WS(std::size_t segment) const noexcept;

  state::UserState& user_;
  boost::container::static_vector<state::FrictionAnchor, kMaxPatches> before_;
};

}  // namespace mechane::haptics
