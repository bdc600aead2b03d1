#include "server/haptics/wall_sides.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
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

// In a corner, each wall touches a segment this far in front of the other wall. Beside a seam of two parts or on an edge, none does.
constexpr double kApart_m = 2e-3;
// Cosine of 120 degrees: two walls that face each other more than this leave no way out.
constexpr double kFacing = -0.5;

/// The walls of one body that hold a segment: two of them in a corner.
class Sides {
 public:
  Sides() = default;
  Sides(std::initializer_list<WallSide> sides) : size_(sides.size()) { std::ranges::copy(sides, sides_.begin()); }
  [[nodiscard]] bool full() const { return size_ == sides_.size(); }
  void add(const WallSide& side) { sides_[size_++] = side; }
  [[nodiscard]] std::span<const WallSide> all() const { return {sides_.data(), size_}; }

 private:
  std::array<WallSide, 2> sides_{};
  std::size_t size_ = 0;
};

/// A wall and how far the segment has to go out along its normal.
struct Behind {
  Vec3 n_W = Vec3::Zero();
  double in_m = 0;
};

/// The shortest way out of one wall or of both walls of a corner, until `left_m` is left of the depth in each.
Vec3 way_out_W(std::span<const Behind> walls, double left_m) {
  const Behind& a = walls.front();
  const Behind& b = walls.back();
  const double a_m = a.in_m - left_m, b_m = b.in_m - left_m, cosine = a.n_W.dot(b.n_W);
  if (walls.size() == 1 || b_m <= a_m * cosine) return a_m * a.n_W;
  if (a_m <= b_m * cosine) return b_m * b.n_W;
  return ((a_m - b_m * cosine) * a.n_W + (b_m - a_m * cosine) * b.n_W) / (1 - cosine * cosine);
}

ContactPatch patch_of(std::span<const state::Contact> contacts, const Vec3& out_W) {
  ContactPatch patch = haptics::patch_of(contacts);
  patch.out_W = out_W;
  return patch;
}

/// What a segment touches of a body when it is moved by `out_W`.
class MovedTouch {
 public:
  MovedTouch(const collision::Object& segment, const Pose& X_WS, const collision::Object& object, const Pose& X_WB,
             const ContactPatch& of, const Vec3& out_W) {
    std::array<collision::PointContact, kTouchPoints> storage;
    collision::ContactBuffer buffer(storage);
    collision::find_contacts(segment, {X_WS.p + out_W, X_WS.R}, object, X_WB, buffer);
    const auto as_contact = [&](const collision::PointContact& at) {
      return state::Contact{of.body, of.segment, at.p_WC, at.n_BA_W, at.depth_m};
    };
    std::ranges::transform(buffer.contacts(), contacts_.begin(), as_contact);
    count_ = buffer.contacts().size();
    whole_ = patch_of(contacts(), out_W);
  }

  /// All points together; depth 0 where nothing is touched.
  [[nodiscard]] const ContactPatch& whole() const { return whole_; }

  /// The two walls of a corner, where the segment is in one.
  [[nodiscard]] std::optional<std::array<ContactPatch, 2>> corner() {
    const std::span<state::Contact> all = contacts();
    const Vec3 n_W = std::ranges::max_element(all, {}, &state::Contact::depth_m)->n_BH_W;
    const auto end_of_a =
        std::partition(all.begin(), all.end(), [&](const state::Contact& at) { return at.n_BH_W.dot(n_W) > kSameWay; });
    const auto size_of_a = static_cast<std::size_t>(end_of_a - all.begin());
    const ContactPatch a = patch_of(all.first(size_of_a), whole_.out_W);
    const ContactPatch b = patch_of(all.subspan(size_of_a), whole_.out_W);
    const Vec3 p_AB_W = b.p_WC - a.p_WC;
    const double cosine = a.n_BH_W.dot(b.n_BH_W);
    const bool is_corner = b.depth_m > 0 && std::max(a.deepest_m, b.deepest_m) <= kCameFromOutside_m &&
                           cosine < kSameWay && cosine > kFacing && p_AB_W.dot(a.n_BH_W) > kApart_m &&
                           -p_AB_W.dot(b.n_BH_W) > kApart_m;
    return is_corner ? std::optional(std::array{a, b}) : std::nullopt;
  }

 private:
  [[nodiscard]] std::span<state::Contact> contacts() { return std::span(contacts_).first(count_); }

  std::array<state::Contact, kTouchPoints> contacts_;
  std::size_t count_ = 0;
  ContactPatch whole_;
};

Behind behind(const ContactPatch& touch) {
  return {touch.n_BH_W, touch.deepest_m + touch.out_W.dot(touch.n_BH_W)};
}

/// What a touch pushes along the surface of the wall that the segment was moved out of. A few points may only lie nearer to the seam of two
/// parts than to the surface: they are no deeper than the segment was left in it.
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

/// Along a normal, of a ball in the segment's middle that reaches as far against it as the segment does, as it is turned now.
template <class Touch>
double height_m(const HandModel& hand, const state::WorldState& state, const UserState& user, const Touch& of,
                const Vec3& n_B, ThinWalls walls) {
  const Pose& X_WB = state[of.body].X_WB;
  const Pose& X_WS = user.X_WS[of.segment];
  const double middle_m = n_B.dot(X_WB.inverse() * X_WS.p);
  if (walls == ThinWalls::hold_tips) return middle_m;
  return middle_m - hand.stands_out_m(user.sample, of.segment, X_WS.R.conjugate() * X_WB.rotate(n_B));
}

class WallHolder {
 public:
  WallHolder(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
             const UserState& user, ThinWalls walls) noexcept
      : description_(description), hand_(hand), state_(state), user_(user), walls_(walls) {}

  /// Puts the touch right, where there were sides in the last tick; returns those for the next one.
  Sides hold(ContactPatch& patch, const Sides& known) const noexcept {
    Sides before;
    std::array<Behind, 2> walls;
    double told = kTells;
    for (const WallSide& side : known.all()) {
      const Behind wall{state_[patch.body].X_WB.rotate(side.n_B), depth_behind_m(hand_, state_, user_, side, walls_)};
      if (wall.in_m <= kShallow_m || wall.in_m > kLetsGo_m) continue;
      walls[before.all().size()] = wall;
      before.add(side);
      told = std::min(told, patch.push_m.dot(wall.n_W) / (kPatchShare * wall.in_m));
    }
    const auto passed = std::span(walls).first(before.all().size());
    if (passed.empty()) return first_side(patch);
    if (told >= kTells) return patch.deepest_m > passed.front().in_m ? Sides{side_of(patch)} : before;
    return hold_from(patch, before, passed, std::clamp((kTells - told) / (kTells - kMisleads), 0.0, 1.0));
  }

 private:
  Sides hold_from(ContactPatch& patch, const Sides& before, std::span<const Behind> walls, double share) const {
    const collision::Object* const object = description_.bodies[patch.body.index()].object.get();
    if (object == nullptr || !state_[patch.body].visible) return first_side(patch);
    MovedTouch moved(hand_.segment(user_.sample, patch.segment), user_.X_WS[patch.segment], *object,
                     state_[patch.body].X_WB, patch, way_out_W(walls, kShallow_m));
    const ContactPatch& touch = moved.whole();
    if (touch.depth_m <= 0) return first_side(patch);
    if (const auto corner = walls_ == ThinWalls::hold_tips ? std::nullopt : moved.corner()) {
      const auto& [a, b] = *corner;
      push_out(patch, touch, kPatchShare * way_out_W(std::array{behind(a), behind(b)}, 0), share);
      patch.in_corner = true;
      return {side_of(a), side_of(b)};
    }
    const auto along = [&](const Behind& wall) { return wall.n_W.dot(touch.n_BH_W); };
    const Behind& nearest = *std::ranges::max_element(walls, {}, along);
    if (along(nearest) > kSameWay) {
      push_out(patch, touch, kPatchShare * way_out_W(std::array{behind(touch)}, 0), share);
      return {side_of(touch)};
    }
    push_out(patch, touch, kPatchShare * way_out_W(walls, 0) + of_another_wall(touch, nearest.n_W), share);
    return before;
  }
  [[nodiscard]] Sides first_side(const ContactPatch& patch) const noexcept {
    if (patch.depth_m <= 0 || patch.deepest_m > kCameFromOutside_m) return {};
    return {side_of(patch)};
  }
  [[nodiscard]] WallSide side_of(const ContactPatch& patch) const noexcept {
    const Vec3 n_B = state_[patch.body].X_WB.inverse().rotate(patch.n_BH_W);
    return {patch.body, patch.segment, n_B, height_m(hand_, state_, user_, patch, n_B, walls_) + behind(patch).in_m};
  }

  const state::WorldDescription& description_;
  const HandModel& hand_;
  const state::WorldState& state_;
  const UserState& user_;
  ThinWalls walls_;
};

Sides sides_of(std::span<const WallSide> sides, const ContactPatch& patch) {
  Sides found;
  for (const WallSide& side : sides) {
    if (side.body == patch.body && side.segment == patch.segment && !found.full()) found.add(side);
  }
  return found;
}

/// Tips and palm. Inner phalanges would hook what a hand that opens has just put down.
bool is_held(const UserState& user, std::size_t segment, ThinWalls walls) {
  const bool tip = user.sample.kind == hand::HandKind::one_point || hand::is_fingertip(segment);
  return tip || (segment == 0 && walls == ThinWalls::hold_hands);
}

}  // namespace

double depth_behind_m(const HandModel& hand, const state::WorldState& state, const UserState& user,
                      const WallSide& side, ThinWalls walls) noexcept {
  return side.height_m - height_m(hand, state, user, side, side.n_B, walls);
}

bool has_side(const UserState& user, std::size_t segment, BodyId body) noexcept {
  return std::ranges::any_of(user.side_span(),
                             [&](const WallSide& side) { return side.body == body && side.segment == segment; });
}

void hold_walls(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
                UserState& user, ThinWalls walls, ContactPatches& patches) noexcept {
  const std::array<WallSide, state::kMaxSides> all_before = user.sides;
  const std::span before(all_before.data(), user.jumped ? 0 : user.side_count);
  for (const WallSide& side : before) {  // a tip may be past all contact
    const auto of_side = [&](const ContactPatch& p) { return p.body == side.body && p.segment == side.segment; };
    // A client may go on with another kind of hand.
    if (side.segment >= hand::segment_count(user.sample.kind)) continue;
    if (patches.size() == patches.capacity() || std::ranges::any_of(patches, of_side)) continue;
    patches.emplace_back();
    patches.back().body = side.body;
    patches.back().segment = side.segment;
  }
  const WallHolder holder(description, hand, state, user, walls);
  std::uint32_t sides = 0;
  for (ContactPatch& patch : patches) {
    if (!is_held(user, patch.segment, walls) || user.holds(patch.body)) continue;
    const Sides held = holder.hold(patch, sides_of(before, patch));
    for (const WallSide& side : held.all()) {
      if (sides < user.sides.size()) user.sides[sides++] = side;
    }
  }
  user.side_count = sides;
}

}  // namespace mechane::haptics
