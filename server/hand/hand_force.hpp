// The force on a hand: what a governor gives out, what the wire carries, what a device renders. Declared here once; proto/hand.cpp
// compares the numbers of the wire's contract with these.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "server/base/math.hpp"
#include "server/hand/freshness.hpp"
#include "server/hand/hand_sample.hpp"
#include "server/hand/surface.hpp"

namespace mechane::hand {

/// Why a force differs from the one that the contacts ask for. Bits.
enum ForceReason : std::uint32_t {
  kNone = 0,
  kClamped = 1,      ///< over the device's limit
  kSlewLimited = 2,  ///< would change faster than the device may be asked to
  kDamped = 4,       ///< the energy observer saw the system put out energy
  kStale = 8,        ///< samples are old; the force decays
  kRamping = 16,     ///< start or end of a visit
  kNotFinite = 32,   ///< a number was not finite; the force is zero
};
inline constexpr std::size_t kReasonCount = 6;

/// Forces on the visitor's hand, in W.
struct HandForce {
  Wrench force_W;                                 ///< at the wrist (glove) or tip (one-point), N and N m
  std::array<double, kFingers> finger_force_n{};  ///< a force glove's: >= 0, along the finger's own perpendicular
  std::uint32_t reasons = kNone;                  ///< ForceReason bits
};

inline constexpr std::size_t kMaxLocalContacts = 8;

/// A contact that a client renders at its device's own rate, as the server saw it. The stiffnesses of all contacts add up to what the hand
/// feels: a server that sends four points of one finger sends a quarter of the stiffness with each.
struct LocalContact {
  Vec3 p_W = Vec3::Zero();        ///< a point of the body's surface
  Vec3 n_W = Vec3::UnitX();       ///< unit normal there, from the body into the hand
  Vec3 v_W = Vec3::Zero();        ///< velocity of the surface there, m/s
  double depth_m = 0;             ///< how far hand and body overlap along n_W; <= 0: still apart by that much
  double curvature_per_m = 0;     ///< of what the hand's point may not pass: > 0 bulges out, < 0 is hollow
  double stiffness_n_per_m = 0;   ///< >= 0
  double damping_ns_per_m = 0;    ///< >= 0; acts only while the hand pushes in
  double static_friction = 0;     ///< Coulomb, >= 0; at least the dynamic one counts
  double dynamic_friction = 0;    ///< >= 0
  double viscosity_ns_per_m = 0;  ///< along the surface, 0 .. kMaxViscosity_ns_per_m
  Grooves grooves{};              ///< their phase is that of the hand where the server saw it
  Duration validity = kHoldFor;   ///< from receipt; afterwards the contact fades out
};

/// The path on which the place that a hand holds can move: of a body on a hinge or a slider whose other side stands still. Nothing yields
/// across it, so that a client can render that at its device's own rate; how the body moves along it, only the server knows.
/// `free`: of a body that one hand carries and nothing else holds. Its weight is part of the server's force, and known beforehand.
struct HeldPath {
  enum class Kind : std::uint8_t { none, line, circle, free };
  Kind kind = Kind::none;
  Vec3 p_HG = Vec3::Zero();      ///< where the hand holds it, in the hand's frame; free: its centre of mass
  Vec3 p_W = Vec3::Zero();       ///< a point of the line; the circle's centre
  Vec3 axis_W = Vec3::UnitX();   ///< unit: the line's direction; the circle's axis; the weight's direction
  double radius_m = 0;           ///< of the circle, over 0
  double along_n = 0;            ///< force on the hand along the axis, or counterclockwise about it; free: the weight
  double stiffness_n_per_m = 0;  ///< across the path, >= 0
  double damping_ns_per_m = 0;   ///< across the path, >= 0
  double limit_n = 0;            ///< the most that the grip bears across the path, >= 0
  Duration validity = kHoldFor;  ///< from receipt; afterwards its force fades out
};

/// The strongest click.
inline constexpr double kMaxClick_n = 1.5;

/// Short shakes: a ratchet's tooth, a knock on stone. The client renders one when the count has risen.
struct Clicks {
  std::uint32_t count = 0;  ///< since this hand came
  double strength_n = 0;    ///< of the newest, 0 .. kMaxClick_n
};

/// What a server answers a sample with.
struct HapticOutput : HandForce {
  std::uint64_t echo_sequence = 0;  ///< the sample that this answers
  std::uint64_t echo_sent_ns = 0;   ///< and its sent_ns
  std::array<LocalContact, kMaxLocalContacts> contacts{};
  std::uint32_t contact_count = 0;
  bool holding = false;  ///< a grasp is on
  HeldPath held;         ///< of the grasp; none where a client has to render the server's force
  Clicks clicks;         ///< not part of force_W

  [[nodiscard]] std::span<const LocalContact> contact_span() const noexcept { return {contacts.data(), contact_count}; }
  /// Whether hand and body overlap in any of the contacts; the others are about to be made.
  [[nodiscard]] bool touches() const noexcept {
    const auto contacts_now = contact_span();
    return std::any_of(contacts_now.begin(), contacts_now.end(), [](const LocalContact& c) { return c.depth_m > 0; });
  }
};

}  // namespace mechane::hand
