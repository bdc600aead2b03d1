#include "client-sdk/pointer/pointer_ways.hpp"

#include <algorithm>

namespace mechane::pointer {
namespace {

using client::Way;

// A joint that is on holds its sides closer than this; frames come as float, and lag a little.
constexpr double kTogether_m = 0.02;
constexpr double kAlike = 0.99;  // cosine

void add_joint(const Way& way, const Pose& X_WA, const Pose& X_WB, Leeway& out) {
  const Pose X_WJ = X_WA * way.X_AJ;
  const Pose X_WJb = X_WB * way.X_BJ;
  const Vec3 axis_J = way.kind == Way::Kind::turns ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 a_W = X_WJ.rotate(axis_J);
  if (a_W.dot(X_WJb.rotate(axis_J)) < kAlike) return;
  Vec3 apart = X_WJb.p - X_WJ.p;
  if (way.kind == Way::Kind::slides) apart -= apart.dot(a_W) * a_W;
  if (apart.norm() > kTogether_m) return;
  (way.kind == Way::Kind::turns ? out.axle : out.track) = WayLine{X_WJ.p, a_W};
}

void add_goal(const Way& way, const Pose& X_WA, const Pose& X_WB, Leeway& out) {
  const Pose X_WJ = X_WA * way.X_AJ;
  if (way.kind == Way::Kind::placed) {
    out.goals.push_back({X_WJ * way.X_BJ.inverse(), true});
    return;
  }
  out.goals.push_back({{X_WJ.p - X_WB.rotate(way.X_BJ.p), X_WB.R}, false});
}

}  // namespace

Leeway leeway_of(std::span<const Way> ways, std::span<const std::string> enabled, std::uint32_t object,
                 const PoseOf& pose_of) {
  Leeway out;
  out.taken = ways.empty();
  const std::optional<Pose> X_WB = pose_of(object);
  if (!X_WB) return out;
  for (const Way& way : ways) {
    if (way.object != object) continue;
    if (!way.agent.empty() && std::ranges::find(enabled, way.agent) == enabled.end()) continue;
    const std::optional<Pose> X_WA = way.base ? pose_of(*way.base) : Pose{};
    if (way.kind == Way::Kind::taken) {
      out.taken = true;
    } else if (!X_WA) {
      continue;
    } else if (way.kind == Way::Kind::turns || way.kind == Way::Kind::slides) {
      add_joint(way, *X_WA, *X_WB, out);
    } else {
      add_goal(way, *X_WA, *X_WB, out);
    }
  }
  return out;
}

}  // namespace mechane::pointer
