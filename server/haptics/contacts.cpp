#include "server/haptics/contacts.hpp"

#include <array>

namespace mechane::haptics {
namespace {

using collision::ContactBuffer;
using collision::PointContact;

// Of one segment against one body. More points than this on one fingertip add nothing to its force.
constexpr std::size_t kContactsPerPair = 64;

bool spheres_apart(const Vec3& a, double radius_a, const Vec3& b, double radius_b) {
  const double reach = radius_a + radius_b;
  return (a - b).squaredNorm() > reach * reach;
}

/// The table keeps the deepest: a shallow contact gives its place to a deeper one.
void keep(state::UserState& user, const state::Contact& contact) {
  if (user.contact_count < user.contacts.size()) {
    user.contacts[user.contact_count++] = contact;
    return;
  }
  std::size_t shallowest = 0;
  for (std::size_t i = 1; i < user.contacts.size(); ++i) {
    if (user.contacts[i].depth_m < user.contacts[shallowest].depth_m) shallowest = i;
  }
  if (user.contacts[shallowest].depth_m < contact.depth_m) user.contacts[shallowest] = contact;
}

void touch_body(const collision::Object& object, const Pose& X_WB, BodyId body, const HandModel& hand,
                state::UserState& user) {
  const std::size_t segments = hand::segment_count(user.sample.kind);
  std::array<PointContact, kContactsPerPair> storage;
  for (std::size_t s = 0; s < segments; ++s) {
    ContactBuffer buffer(storage);
    collision::find_contacts(hand.segment(user.sample, s), user.X_WS[s], object, X_WB, buffer);
    for (const PointContact& point : buffer.contacts()) {
      keep(user, {body, static_cast<std::uint8_t>(s), point.p_WC, point.n_BA_W, point.depth_m});
    }
  }
}

}  // namespace

void find_contacts(const state::WorldDescription& description, const HandModel& hand,
                   state::WorldState& state) noexcept {
  for (state::UserState& user : state.users) {
    user.contact_count = 0;
    if (!user.present) continue;
    const double reach = hand.reach_m(user.sample);
    for (std::size_t b = 0; b < description.bodies.size(); ++b) {
      const BodyId id(b);
      const collision::Object* object = description.bodies[b].object.get();
      if (object == nullptr || !state[id].visible) continue;
      const Pose& X_WB = state[id].X_WB;
      if (spheres_apart(user.X_WH.p, reach, X_WB * object->bound_O.center, object->bound_O.radius)) continue;
      touch_body(*object, X_WB, id, hand, user);
    }
  }
}

}  // namespace mechane::haptics
