#include "client-sdk/display/thing_names.hpp"

#include <algorithm>
#include <limits>

#include "client-sdk/display/hand_shape.hpp"

namespace mechane::display {
namespace {

/// From a finger's end to a thing's box. A visitor reads the name on the way there.
constexpr float kHandsBreadth_m = 0.10F;

Vec3 index_tip(const client::HandPose& hand) {
  return hand.kind == client::HandKind::one_point ? hand.X_WS.front().p : finger_tip(hand.X_WS, 1);
}

}  // namespace

std::optional<std::uint32_t> named_near(std::span<const NamedThing> things, std::span<const client::HandPose> hands) {
  std::optional<std::uint32_t> nearest;
  float least = kHandsBreadth_m;
  for (const client::HandPose& hand : hands) {
    if (hand.stale || hand.holding) continue;
    const Vec3f p_WT = index_tip(hand).cast<float>();
    if (!p_WT.allFinite()) continue;  // to Eigen it is in every box
    for (const NamedThing& thing : things) {
      const float apart = thing.box_B.exteriorDistance(Vec3f(thing.X_WB.inverse() * p_WT));
      if (!(apart < least)) continue;
      least = apart;
      nearest = thing.object;
    }
  }
  return nearest;
}

std::optional<OverlayLabel> label_of(std::span<const NamedThing> things, std::uint32_t object, const Sight& sight) {
  const auto thing = std::ranges::find(things, object, &NamedThing::object);
  if (thing == things.end()) return {};
  Eigen::AlignedBox2f seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f p_W = thing->X_WB * thing->box_B.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
    const auto pixel = pixel_of(sight, p_W.cast<double>());
    if (!pixel) return {};
    seen.extend(Eigen::Vector2f(static_cast<float>(pixel->x), static_cast<float>(pixel->y)));
  }
  return OverlayLabel{thing->name, seen.center().x(), seen.min().y(), seen.max().y()};
}

}  // namespace mechane::display
