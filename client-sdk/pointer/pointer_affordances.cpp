#include "client-sdk/pointer/pointer_affordances.hpp"

#include <algorithm>

namespace mechane::pointer {
namespace {

using client::Affordance;

// An enabled joint holds its sides closer than this, even with poses in float that lag a little.
constexpr double kTogether_m = 0.02;
constexpr double kAlike = 0.99;  // cosine

void add_joint(const Affordance& affordance, const Pose& X_WA, const Pose& X_WB, Leeway& out) {
  const Pose X_WJ = X_WA * affordance.X_AJ;
  const Pose X_WJb = X_WB * affordance.X_BJ;
  const Vec3 axis_J = affordance.kind == Affordance::Kind::turns ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 a_W = X_WJ.rotate(axis_J);
  if (a_W.dot(X_WJb.rotate(axis_J)) < kAlike) return;
  Vec3 apart = X_WJb.p - X_WJ.p;
  if (affordance.kind == Affordance::Kind::slides) apart -= apart.dot(a_W) * a_W;
  if (apart.norm() > kTogether_m) return;
  (affordance.kind == Affordance::Kind::turns ? out.axle : out.track) = AffordanceLine{X_WJ.p, a_W};
}

void add_goal(const Affordance& affordance, const Pose& X_WA, const Pose& X_WB, Leeway& out) {
  const Pose X_WJ = X_WA * affordance.X_AJ;
  if (affordance.kind == Affordance::Kind::placed) {
    out.goals.push_back({X_WJ * affordance.X_BJ.inverse(), true});
    return;
  }
  out.goals.push_back({{X_WJ.p - X_WB.rotate(affordance.X_BJ.p), X_WB.R}, false});
}

}  // namespace

const client::SceneObject* object_of(std::span<const client::SceneObject> objects, std::uint32_t object) {
  const auto known = std::ranges::find(objects, object, &client::SceneObject::index);
  return known == objects.end() ? nullptr : &*known;
}

std::optional<Pose> pose_in(const client::Frame* frame, std::span<const client::SceneObject> objects,
                            std::uint32_t object) {
  if (frame != nullptr) {
    const auto body = std::ranges::find(frame->bodies, object, &client::BodyPose::object);
    if (body != frame->bodies.end()) return body->X_WB;
  }
  const client::SceneObject* known = object_of(objects, object);
  return known == nullptr ? std::nullopt : std::optional(known->X_WB);
}

Leeway leeway_of(std::span<const Affordance> affordances, std::span<const std::string> enabled, std::uint32_t object,
                 const PoseOf& pose_of) {
  Leeway out;
  out.taken = affordances.empty();
  const std::optional<Pose> X_WB = pose_of(object);
  if (!X_WB) return out;
  for (const Affordance& affordance : affordances) {
    if (affordance.object != object) continue;
    if (!affordance.agent.empty() && std::ranges::find(enabled, affordance.agent) == enabled.end()) continue;
    const std::optional<Pose> X_WA = affordance.base ? pose_of(*affordance.base) : Pose{};
    if (affordance.kind == Affordance::Kind::taken) {
      out.taken = true;
    } else if (!X_WA) {
      continue;
    } else if (affordance.kind == Affordance::Kind::turns || affordance.kind == Affordance::Kind::slides) {
      add_joint(affordance, *X_WA, *X_WB, out);
    } else {
      add_goal(affordance, *X_WA, *X_WB, out);
    }
  }
  return out;
}

}  // namespace mechane::pointer
