// Checks at compile time that the contract's sizes and numbers of the hand (idl/mechane.idl) are those of server/hand.
#include <bit>
#include <type_traits>

#include "server/hand/hand_force.hpp"
#include "server/hand/hand_sample.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::proto {
namespace {

static_assert(mechane_kMaxUsers == hand::kMaxUsers);
static_assert(mechane_kFingers == hand::kFingers);
static_assert(mechane_kHandJoints == hand::kHandJoints);
static_assert(mechane_kHandSegments == hand::kHandSegments);
static_assert(mechane_kMaxLocalContacts == hand::kMaxLocalContacts);

static_assert(std::extent_v<decltype(HapticInput::joints)> == hand::kHandJoints);
static_assert(std::extent_v<decltype(HapticInput::finger_scale)> == hand::kFingers);
static_assert(std::extent_v<decltype(HapticOutput::finger_force_n)> == hand::kFingers);
static_assert(std::extent_v<decltype(HapticOutput::contacts)> == hand::kMaxLocalContacts);
static_assert(std::extent_v<decltype(WorldAssignment::owners)> == hand::kMaxUsers);

static_assert(mechane_hand_one_point == static_cast<int>(hand::HandKind::one_point));
static_assert(mechane_hand_glove == static_cast<int>(hand::HandKind::glove));
static_assert(mechane_hand_right == static_cast<int>(hand::HandSide::right));
static_assert(mechane_hand_left == static_cast<int>(hand::HandSide::left));

static_assert(mechane_held_none == static_cast<int>(hand::HeldPath::Kind::none));
static_assert(mechane_held_line == static_cast<int>(hand::HeldPath::Kind::line));
static_assert(mechane_held_circle == static_cast<int>(hand::HeldPath::Kind::circle));
static_assert(mechane_held_free == static_cast<int>(hand::HeldPath::Kind::free));

static_assert(mechane_reason_clamped == hand::kClamped);
static_assert(mechane_reason_slew_limited == hand::kSlewLimited);
static_assert(mechane_reason_damped == hand::kDamped);
static_assert(mechane_reason_stale == hand::kStale);
static_assert(mechane_reason_ramping == hand::kRamping);
static_assert(mechane_reason_not_finite == hand::kNotFinite);
static_assert(std::bit_width(static_cast<std::uint32_t>(hand::kNotFinite)) == hand::kReasonCount);

}  // namespace
}  // namespace mechane::proto
