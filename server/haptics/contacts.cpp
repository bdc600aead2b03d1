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

// Of one segment against one body. More points than this on one fingertip add nothing to its force.
constexpr std::size_t kContactsPerTouch = 64;
// The deepest of each touch stay in a full table: else the many points of a hand on a table would hide the arrow that lies there.
constexpr std::size_t kKeptOfTouch = 8;
static_assert(kKeptOfTouch * state::kMaxPatches <= state::kMaxContacts);
constexpr double kStays = 1;  // added to a rank in metres; no hand is as deep in a body

using Contacts = KeepDeepest<state::Contact, state::kMaxContacts>;

/// Points so deep are among the deepest of their touch.
double depth_that_stays(std::span<const PointContact> touch) {
  if (touch.size() <= kKeptOfTouch) return 0;
  std::array<double, kContactsPerTouch> depths_m;
  const auto end = std::ranges::transform(touch, depths_m.begin(), &PointContact::depth_m).out;
  const auto last = depths_m.begin() + kKeptOfTouch - 1;
  std::nth_element(depths_m.begin(), last, end, std::greater{});
  return *last;
}

void touch_body(const collision::Object& object, const Pose& X_WB, BodyId body, const HandModel& hand,
                const state::UserState& user, Contacts& contacts) {
  const std::size_t segments = hand::segment_count(user.sample.kind);
  std::array<PointContact, kContactsPerTouch> storage;
  for (std::size_t s = 0; s < segments; ++s) {
    ContactBuffer buffer(storage);
    collision::find_contacts(hand.segment(user.sample, s), user.X_WS[s], object, X_WB, buffer);
    const double stays_m = depth_that_stays(buffer.contacts());
    for (const PointContact& point : buffer.contacts()) {
      contacts.add({body, static_cast<std::uint8_t>(s), point.p_WC, point.n_BA_W, point.depth_m},
                   point.depth_m + (point.depth_m >= stays_m ? kStays : 0));
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
