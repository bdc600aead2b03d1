#include "client-sdk/scene/thing_names.hpp"

#include <algorithm>
#include <utility>

#include "client-sdk/picture/box_corners.hpp"
#include "client-sdk/scene/hand_shape.hpp"

namespace mechane::scene {
namespace {

/// Distance from a fingertip to a thing's box at which the name appears, so that it is read before the touch.
constexpr float kHandsBreadth_m = 0.10F;
/// Distance at which a name still belongs visibly to the pointed place, as a share of the picture's height.
constexpr float kReadTogether = 0.14F;

Vec3 index_tip(const client::HandPose& hand) {
  return hand.kind == client::HandKind::one_point ? hand.X_WS.front().p : finger_tip(hand.X_WS, 1);
}

}  // namespace

std::optional<picture::Touched> named_near(std::span<const picture::NamedThing> things,
                                           std::span<const client::HandPose> hands) {
  std::optional<picture::Touched> nearest;
  // By distance, then by size: of nested things the inner one is meant.
  std::pair<float, float> least{kHandsBreadth_m, 0};
  for (const client::HandPose& hand : hands) {
    if (hand.stale || hand.holding) continue;
    const Vec3f p_WT = index_tip(hand).cast<float>();
    if (!p_WT.allFinite()) continue;  // Eigen would find NaN in every box
    for (const picture::NamedThing& thing : things) {
      const std::pair here{thing.box_B.exteriorDistance(Vec3f(thing.X_WB.inverse() * p_WT)), thing.box_B.volume()};
      if (!(here < least)) continue;
      least = here;
      nearest = picture::Touched{thing.object, p_WT.cast<double>()};
    }
  }
  return nearest;
}

std::optional<picture::OverlayLabel> label_of(std::span<const picture::NamedThing> things,
                                              const picture::Touched& meant, const picture::Sight& sight) {
  const auto thing = std::ranges::find(things, meant.object, &picture::NamedThing::object);
  const auto at = picture::pixel_of(sight, meant.p_WT);
  if (thing == things.end() || !at) return {};
  const Eigen::Vector2f middle(static_cast<float>(at->x), static_cast<float>(at->y));
  const Eigen::Vector2f reach = Eigen::Vector2f::Constant(kReadTogether * static_cast<float>(sight.picture.height));
  Eigen::AlignedBox2f seen;
  bool whole = true;
  for (const Vec3f& p_B : picture::corners_of(thing->box_B)) {
    const auto pixel = picture::pixel_of(sight, (thing->X_WB * p_B).cast<double>());
    whole = whole && pixel;
    if (pixel) seen.extend(Eigen::Vector2f(static_cast<float>(pixel->x), static_cast<float>(pixel->y)));
  }
  whole = whole && (seen.sizes().array() <= 2 * reach.array()).all();
  Eigen::AlignedBox2f about = whole ? seen : seen.intersection({middle - reach, middle + reach});
  if (about.isEmpty()) about = Eigen::AlignedBox2f(middle);
  return picture::OverlayLabel{thing->name, about.min().x(), about.min().y(), about.max().x(), about.max().y(), whole};
}

}  // namespace mechane::scene
