#include "server/haptics/contacts.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <span>

#include "server/haptics/keep_deepest.hpp"
#include "server/haptics/near_bodies.hpp"

namespace mechane::haptics {
namespace {

using collision::ContactBuffer;
using collision::PointContact;

// A touch is of one segment with one body. More points than this on one fingertip add nothing to its force.
constexpr std::size_t kContactsPerTouch = 64;
// The deepest of each touch stay in a full table: otherwise the many points of a hand on a table would hide the arrow that lies there.
constexpr std::size_t kKeptOfTouch = 8;
static_assert(kKeptOfTouch * state::kMaxPatches <= state::kMaxContacts);
constexpr double kStays_m = 1;  // added to a depth: more than any hand is deep in a body

using Contacts = KeepDeepest<state::Contact, state::kMaxContacts>;

/// Which points of a touch stay in a full table: kKeptOfTouch of them, or all where they are fewer.
struct Staying {
  double depth_m = 0;       ///< all that are deeper
  std::size_t as_deep = 0;  ///< and so many that are as deep, the first of them

  bool take(const PointContact& point) {
    if (point.depth_m != depth_m || as_deep == 0) return point.depth_m > depth_m;
    --as_deep;
    return true;
  }
};

Staying staying_of(std::span<const PointContact> touch) {
  if (touch.size() <= kKeptOfTouch) return {};
  std::array<double, kContactsPerTouch> depths_m;
  const auto end = std::ranges::transform(touch, depths_m.begin(), &PointContact::depth_m).out;
  const auto last = depths_m.begin() + kKeptOfTouch - 1;
  std::nth_element(depths_m.begin(), last, end, std::greater{});
  const double least_m = *last;
  const auto deeper = std::ranges::count_if(touch, [=](const PointContact& at) { return at.depth_m > least_m; });
  return {least_m, kKeptOfTouch - static_cast<std::size_t>(deeper)};
}

void touch_body(const collision::Object& object, const Pose& X_WB, BodyId body, const HandModel& hand,
                const state::UserState& user, Contacts& contacts) {
  const std::size_t segments = hand::segment_count(user.sample.kind);
  std::array<PointContact, kContactsPerTouch> storage;
  for (std::size_t s = 0; s < segments; ++s) {
    ContactBuffer buffer(storage);
    collision::find_contacts(hand.segment(user.sample, s), user.X_WS[s], object, X_WB, buffer);
    Staying staying = staying_of(buffer.contacts());
    for (const PointContact& point : buffer.contacts()) {
      contacts.add({body, static_cast<std::uint8_t>(s), point.p_WC, point.n_BA_W, point.depth_m},
                   point.depth_m + (staying.take(point) ? kStays_m : 0));
    }
  }
}

}  // namespace

void find_contacts(const state::WorldDescription& description, const HandModel& hand,
                   state::WorldState& state) noexcept {
  for (state::UserState& user : state.users) {
    user.contact_count = 0;
    if (!user.present) continue;
    Contacts contacts(user.contacts, user.contact_count);
    for_each_body_near(description, state, user.X_WH.p, hand.reach_m(user.sample),
                       [&](BodyId body, const collision::Object& object, const Pose& X_WB) {
                         touch_body(object, X_WB, body, hand, user, contacts);
                       });
  }
}

}  // namespace mechane::haptics
