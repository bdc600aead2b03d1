// The contacts near a hand, as planes and spheres that a client renders at its device's own rate while the next answer
// of the server is on its way.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"
#include "server/hand/hand_force.hpp"

namespace mechane::hand {

/// How far a hand is behind the plane or sphere of a contact, and the way out.
struct Overlap {
  double depth_m;
  Vec3 n_W;
};
/// Of the hand's point H at `p_WH`. `p_WS`: where H may not pass, along the contact's normal.
[[nodiscard]] Overlap overlap_of(const LocalContact& c, const Vec3& p_WS, const Vec3& p_WH) noexcept;

/// Renders up to 8 contacts. One thread; render allocates nothing.
///
/// The hand is a point H (its reference point: the tip of a stylus, the wrist of a glove) that moves without turning
/// between two answers. Each contact becomes a plane, or a sphere of radius 1 / |curvature|, that H may not pass:
/// placed so that H is `depth_m` behind it where H was when the server looked. So the size of the tip, or the way from
/// wrist to fingertip, needs no further numbers.
///
/// Friction is a spring as stiff as the contact, from the place where the hand stuck to where it is now; beyond the cone
/// of static friction that place slides after it, with dynamic friction until the hand goes back (Hayward and Armstrong
/// 2000). A hand at rest does not creep, the force does not depend on a noisy velocity, and no slope is steeper than
/// that of the contact itself. Grooves and viscosity: see surface.hpp.
class LocalContactModel {
 public:
  static constexpr double kDampingOnset_m =
      0.5e-3;  ///< damping grows to its full value over this depth: no jolt at touch

  /// The server's newest contacts, and where H was (`p_WH0`) in the input that they answer. Where one is the plane of
  /// a contact of before, the hand goes on sticking to it. Contacts beyond the eighth,
  /// and those with a number that is not finite or a normal that is not of unit length, are left out; returns how many
  /// were taken. Grooves that are too steep are smoothed, and all viscosities together are at most the most of one.
  std::size_t set(std::span<const LocalContact> contacts, const Vec3& p_WH0) noexcept;
  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// The force on the hand, N in W, with H at `p_WH` moving at `v_WH`; `age` is the time since set(), on the caller's
  /// own clock: a contact past its validity fades out, see share_left(). Not clamped: the governor comes after it.
  [[nodiscard]] Vec3 render(const Vec3& p_WH, const Vec3& v_WH, Duration age) noexcept;

 private:
  struct Touch {
    LocalContact contact;             // p_W moved to where H may not pass; the grooves' phase is that of W's origin
    Vec3 p_WA = Vec3::Zero();         // H would feel no friction here, but for:
    Vec3 travelled_W = Vec3::Zero();  // how far the surface has moved since set()
    bool slides = false;              // dynamic friction holds, not static
  };
  [[nodiscard]] const Touch* same_surface(const LocalContact& contact) const noexcept;

  std::array<Touch, kMaxLocalContacts> touches_{};
  std::size_t count_ = 0;
};

}  // namespace mechane::hand
