#include "server/haptics/wall_sides.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "server/hand/friction_spring.hpp"

namespace mechane::haptics {
namespace {

using state::UserState;
using state::WallSide;

// How deep a tip lies in a surface where its contacts tell the way out of anything that is over twice as thick.
constexpr double kShallow_m = 0.4e-3;
// A tip that is found deeper than this in its first tick began inside, or was moved there: at 3 m/s none comes so far.
constexpr double kCameFromOutside_m = 3e-3;
// How much contacts push along a side's normal, as a share of what the tip's depth below the side's plane would: from kTells on they tell
// the way out, and up to kMisleads they do not. Between, both count, so that no force jumps.
constexpr double kTells = 0.8, kMisleads = 0.6;
// Cosine of 25 degrees: no surface turns faster in a tick, under a tip that goes round an edge at 3 m/s.
constexpr double kSameWay = 0.9;
// A hand that has gone so far behind a wall is meant to be there: a device without force cannot hold it back.
constexpr double kLetsGo_m = 0.05;
// As a depth, the most that a wall that holds pushes with: 4.8 N of an ordinary surface. Hands whose device cannot stop them would push
// machines with more than any visitor feels.
constexpr double kMostPush_m = 8e-3;
constexpr std::size_t kTouchPoints = 64;

const WallSide* find_side(std::span<const WallSide> sides, std::size_t segment, BodyId body) {
  const auto is_it = [&](const WallSide& side) { return side.body == body && side.segment == segment; };
  const auto found = std::ranges::find_if(sides, is_it);
  return found == sides.end() ? nullptr : &*found;
}

/// What the tip touches of the body when it is moved by `out_W`. None: nothing.
std::optional<ContactPatch> touch_at(const collision::Object& tip, const Pose& X_WS, const collision::Object& object,
                                     const Pose& X_WB, const WallSide& side, const Vec3& out_W) {
  std::array<collision::PointContact, kTouchPoints> storage;
  collision::ContactBuffer buffer(storage);
  collision::find_contacts(tip, {X_WS.p + out_W, X_WS.R}, object, X_WB, buffer);
  std::array<state::Contact, kTouchPoints> contacts;
  const auto as_contact = [&](const collision::PointContact& at) {
    return state::Contact{side.body, side.segment, at.p_WC, at.n_BA_W, at.depth_m};
  };
  std::ranges::transform(buffer.contacts(), contacts.begin(), as_contact);
  std::array<ContactPatch, kMaxPatches> patches;
  if (gather_patches(std::span(contacts).first(buffer.contacts().size()), patches) == 0 || patches[0].depth_m <= 0)
    return std::nullopt;
  patches[0].out_W = out_W;
  return patches[0];
}

/// In a corner, the touch of a tip that was moved out of one wall is that of the other. A few points may only lie nearer to the seam of two
/// parts than to the surface: they are no deeper than the tip was left in it.
Vec3 of_another_wall(const ContactPatch& touch, const Vec3& n_W) {
  const Vec3 push_m = hand::along_surface(touch.push_m, n_W);
  return std::max(0.0, 1 - kPatchShare * kShallow_m / push_m.norm()) * push_m;
}

/// Blends the patch towards a touch that pushes so, by `share`.
void push_out(ContactPatch& patch, const ContactPatch& touch, Vec3 push_m, double share) {
  push_m *= std::min(1.0, kMostPush_m / push_m.norm());
  patch.push_m += share * (push_m - patch.push_m);
  patch.p_WC = patch.points == 0 ? touch.p_WC : Vec3(patch.p_WC + share * (touch.p_WC - patch.p_WC));
  patch.out_W = share * touch.out_W;
  patch.found_depth_m += share * (touch.found_depth_m - patch.found_depth_m);
  patch.depth_m = patch.push_m.norm();
  patch.n_BH_W = patch.push_m / patch.depth_m;
}

class WallHolder {
 public:
  WallHolder(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
             const UserState& user) noexcept
      : description_(description), hand_(hand), state_(state), user_(user) {}

  /// Puts the touch right, where there was a side in the last tick; returns the side for the next one.
  std::optional<WallSide> hold(ContactPatch& patch, const WallSide* before) const noexcept {
    if (before == nullptr) return first_side(patch);
    const Pose& X_WB = state_[patch.body].X_WB;
    const Vec3 n_W = X_WB.rotate(before->n_B);
    const double in_m = before->height_m - height_m(patch, before->n_B);
    if (in_m <= kShallow_m || in_m > kLetsGo_m) return first_side(patch);
    const double told = patch.push_m.dot(n_W) / (kPatchShare * in_m);
    if (told >= kTells) return patch.deepest_m > in_m ? side_of(patch) : *before;
    const collision::Object* const object = description_.bodies[patch.body.index()].object.get();
    if (object == nullptr || !state_[patch.body].visible) return first_side(patch);
    const auto touch = touch_at(hand_.segment(user_.sample, patch.segment), user_.X_WS[patch.segment], *object, X_WB,
                                *before, (in_m - kShallow_m) * n_W);
    if (!touch) return first_side(patch);
    const double share = std::clamp((kTells - told) / (kTells - kMisleads), 0.0, 1.0);
    if (touch->n_BH_W.dot(n_W) > kSameWay) {
      push_out(patch, *touch, kPatchShare * (touch->deepest_m + touch->out_W.dot(touch->n_BH_W)) * touch->n_BH_W,
               share);
      return side_of(*touch);
    }
    push_out(patch, *touch, kPatchShare * in_m * n_W + of_another_wall(*touch, n_W), share);
    return *before;
  }

 private:
  [[nodiscard]] std::optional<WallSide> first_side(const ContactPatch& patch) const noexcept {
    if (patch.depth_m <= 0 || patch.deepest_m > kCameFromOutside_m) return std::nullopt;
    return side_of(patch);
  }
  [[nodiscard]] double height_m(const ContactPatch& patch, const Vec3& n_B) const noexcept {
    return n_B.dot(state_[patch.body].X_WB.inverse() * user_.X_WS[patch.segment].p);
  }
  [[nodiscard]] WallSide side_of(const ContactPatch& patch) const noexcept {
    const Vec3 n_B = state_[patch.body].X_WB.inverse().rotate(patch.n_BH_W);
    const double out_m = patch.out_W.dot(patch.n_BH_W);
    return {patch.body, patch.segment, n_B, height_m(patch, n_B) + out_m + patch.deepest_m};
  }

  const state::WorldDescription& description_;
  const HandModel& hand_;
  const state::WorldState& state_;
  const UserState& user_;
};

}  // namespace

bool has_side(const UserState& user, std::size_t segment, BodyId body) noexcept {
  return find_side(user.side_span(), segment, body) != nullptr;
}

std::size_t hold_walls(const state::WorldDescription& description, const HandModel& hand,
                       const state::WorldState& state, UserState& user, std::array<ContactPatch, kMaxPatches>& patches,
                       std::size_t count) noexcept {
  const std::array<WallSide, state::kMaxSides> all_before = user.sides;
  const std::span before(all_before.data(), user.jumped ? 0 : user.side_count);
  for (const WallSide& side : before) {  // a tip may be past all contact
    const auto of_side = [&](const ContactPatch& p) { return p.body == side.body && p.segment == side.segment; };
    // A client may go on with another kind of hand.
    if (side.segment >= hand::segment_count(user.sample.kind)) continue;
    if (count == patches.size() || std::ranges::any_of(std::span(patches).first(count), of_side)) continue;
    patches[count] = ContactPatch{};
    patches[count].body = side.body;
    patches[count++].segment = side.segment;
  }
  const WallHolder holder(description, hand, state, user);
  std::uint32_t sides = 0;
  for (ContactPatch& patch : std::span(patches).first(count)) {
    const bool tip = user.sample.kind == hand::HandKind::one_point || hand::is_fingertip(patch.segment);
    if (!tip || user.holds(patch.body) || sides == user.sides.size()) continue;
    const auto side = holder.hold(patch, find_side(before, patch.segment, patch.body));
    if (side) user.sides[sides++] = *side;
  }
  user.side_count = sides;
  return count;
}

}  // namespace mechane::haptics
