#include "server/haptics/near_surfaces.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "server/haptics/keep_deepest.hpp"
#include "server/haptics/near_bodies.hpp"

namespace mechane::haptics {
namespace {

using collision::PointContact;
using state::Contact;
using state::UserState;

// The deepest in the ball lie around the place that is nearest to its centre.
constexpr std::size_t kPoints = 32;

bool touches(const UserState& user, std::size_t segment, BodyId body) {
  const auto contacts = user.contact_span();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const Contact& c) { return c.body == body && c.segment == segment; });
}

/// The nearest place of a surface, with the gap between it and the largest ball inside the segment. A body's own samples have normals that
/// point to the ball's centre, so the normals of all points of the same wall are averaged. Points of other walls do not count.
std::optional<Contact> nearest(std::span<const PointContact> points, const Vec3& p_WS, double inner_radius_m) {
  constexpr double kSameWall = 0.7;        // cosine: 45 degrees
  constexpr double kMostOverlap_m = 1e-3;  // of what does not touch: more is a wall that is not there
  const auto nearer = [&](const PointContact& a, const PointContact& b) {
    return (p_WS - a.p_WC).squaredNorm() < (p_WS - b.p_WC).squaredNorm();
  };
  const auto best = std::min_element(points.begin(), points.end(), nearer);
  if (best == points.end()) return std::nullopt;
  const Vec3 way_out_W = (p_WS - best->p_WC).normalized();
  Vec3 normals_W = Vec3::Zero();
  for (const PointContact& point : points) {
    if (point.n_BA_W.dot(way_out_W) > kSameWall) normals_W += point.depth_m * point.depth_m * point.n_BA_W;
  }
  if (normals_W.isZero(0)) return std::nullopt;
  const Vec3 n_BH_W = normals_W.normalized();
  const double overlap_m = inner_radius_m - (p_WS - best->p_WC).dot(n_BH_W);
  if (overlap_m > kMostOverlap_m) return std::nullopt;
  return Contact{{}, 0, best->p_WC, n_BH_W, std::min(overlap_m, 0.0)};
}

void look_from(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
               UserState& user, std::size_t segment) {
  const Pose& X_WS = user.X_WS[segment];
  const double inner_radius_m = hand.inner_radius_m(user.sample, segment);
  const auto look_at = [&](BodyId body, const collision::Object& object, const Pose& X_WB) {
    if (touches(user, segment, body)) return;
    std::array<PointContact, kPoints> storage;
    collision::ContactBuffer buffer(storage);
    collision::find_contacts(hand.near_ball(), X_WS, object, X_WB, buffer);
    std::optional<Contact> found = nearest(buffer.contacts(), X_WS.p, inner_radius_m);
    if (!found) return;
    found->body = body;
    found->segment = static_cast<std::uint8_t>(segment);
    KeepDeepest(user.near, user.near_count).add(*found);
  };
  for_each_body_near(description, state, X_WS.p, hand.near_radius_m(), look_at);
}

}  // namespace

void find_near_surfaces(const state::WorldDescription& description, const HandModel& hand,
                        state::WorldState& state) noexcept {
  for (UserState& user : state.users) {
    user.near_count = 0;
    if (!user.present) continue;
    if (user.sample.kind == hand::HandKind::one_point) {
      look_from(description, hand, state, user, 0);
      continue;
    }
    for (std::size_t f = 0; f < hand::kFingers; ++f)
      look_from(description, hand, state, user, hand::first_segment(f) + hand::kPhalanges - 1);
  }
}

}  // namespace mechane::haptics
