#include "server/haptics/contacts.hpp"

#include <array>

#include "server/haptics/keep_deepest.hpp"
#include "server/haptics/near_bodies.hpp"

namespace mechane::haptics {
namespace {

using collision::ContactBuffer;
using collision::PointContact;

// Of one segment against one body. More points than this on one fingertip add nothing to its force.
constexpr std::size_t kContactsPerPair = 64;

using Contacts = KeepDeepest<state::Contact, state::kMaxContacts>;

void touch_body(const collision::Object& object, const Pose& X_WB, BodyId body, const HandModel& hand,
                const state::UserState& user, Contacts& contacts) {
  const std::size_t segments = hand::segment_count(user.sample.kind);
  std::array<PointContact, kContactsPerPair> storage;
  for (std::size_t s = 0; s < segments; ++s) {
    ContactBuffer buffer(storage);
    collision::find_contacts(hand.segment(user.sample, s), user.X_WS[s], object, X_WB, buffer);
    for (const PointContact& point : buffer.contacts()) {
      contacts.add({body, static_cast<std::uint8_t>(s), point.p_WC, point.n_BA_W, point.depth_m});
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
