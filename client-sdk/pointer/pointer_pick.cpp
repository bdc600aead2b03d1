// What a finger points at. A finger is broad, so things that can be taken are preferred to those beside them.
#include <algorithm>
#include <cmath>
#include <set>

#include "client-sdk/pointer/pointer_input.hpp"

namespace mechane::pointer {
namespace {

// Shares of the picture's height: 7 mm on a screen 30 cm high.
constexpr std::array<double, 4> kFingertip{0.006, 0.012, 0.018, 0.024};
constexpr int kRound = 12;
constexpr std::size_t kTries = 28;

picture::RenderScene only_takeable(const PointerScene& scene) {
  picture::RenderScene out;
  std::set<std::uint32_t> yes, no;
  for (const picture::Instance& instance : scene.scene.instances) {
    if (!instance.object || no.contains(*instance.object)) continue;
    if (!yes.contains(*instance.object) && !scene.takeable(*instance.object)) {
      no.insert(*instance.object);
      continue;
    }
    yes.insert(*instance.object);
    out.instances.push_back(instance);
  }
  return out;
}

/// Within a fingertip's breadth.
std::optional<picture::Touched> takeable_about(const PointerScene& scene, const picture::Sight& sight,
                                               picture::PixelPlace place) {
  const picture::RenderScene these = only_takeable(scene);
  if (these.instances.empty()) return {};
  for (const double share : kFingertip) {
    for (int k = 0; k < kRound; ++k) {
      const double angle = 2 * kPi * k / kRound;
      const double radius = share * sight.picture.height;
      const picture::PixelPlace near{place.x + radius * std::cos(angle), place.y + radius * std::sin(angle)};
      const auto one = picture::picked_at(these, scene.assets, sight, near);
      if (!one) continue;
      const auto seen = picture::picked_at(scene.scene, scene.assets, sight, near);
      if (seen && seen->object == one->object) return picture::Touched{*one->object, one->p_WT};
    }
  }
  return {};
}

/// Some places of an object's surface, spread over its triangles.
std::vector<Vec3> places_of(const PointerScene& scene, std::uint32_t object) {
  std::vector<Vec3> out;
  for (const picture::Instance& instance : scene.scene.instances) {
    if (instance.object != object) continue;
    const picture::MeshData& mesh = scene.assets.meshes[instance.mesh];
    const std::size_t triangles = mesh.indices.size() / 3;
    for (std::size_t k = 0; k < std::min(kTries, triangles); ++k) {
      const std::size_t first = 3 * (k * triangles / std::min(kTries, triangles));
      const Vec3f middle = (mesh.positions[mesh.indices[first]] + mesh.positions[mesh.indices[first + 1]] +
                            mesh.positions[mesh.indices[first + 2]]) /
                           3;
      out.push_back((instance.X_WM * middle).cast<double>());
    }
  }
  return out;
}

/// A crank is taken by its far end, another thing by its middle.
std::optional<picture::PixelPlace> place_to_take(const PointerScene& scene, const picture::Sight& sight,
                                                 std::uint32_t object) {
  const Leeway leeway = scene.leeway(object);
  std::vector<Vec3> seen_W;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p_W : places_of(scene, object)) {
    const auto pixel = picture::pixel_of(sight, p_W);
    if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x >= sight.picture.width || pixel->y >= sight.picture.height)
      continue;
    const auto picked = picture::picked_at(scene.scene, scene.assets, sight, *pixel);
    if (!picked || picked->object != object) continue;
    seen_W.push_back(p_W);
    mean += p_W;
  }
  if (seen_W.empty()) return {};
  mean /= static_cast<double>(seen_W.size());
  const auto worth = [&](const Vec3& p_W) {
    return leeway.axle ? (p_W - leeway.axle->p_W).cross(leeway.axle->a_W).norm() : -(p_W - mean).norm();
  };
  return picture::pixel_of(sight, *std::ranges::max_element(seen_W, {}, worth));
}

}  // namespace

std::optional<Pose> PointerScene::pose_of(std::uint32_t object) const {
  return pose_in(frame, objects, object);
}

Leeway PointerScene::leeway(std::uint32_t object) const {
  if (presentation == nullptr || status == nullptr) return {};
  return leeway_of(presentation->affordances, status->enabled_agents, object,
                   [this](std::uint32_t other) { return pose_of(other); });
}

bool PointerScene::takeable(std::uint32_t object) const {
  const client::SceneObject* known = object_of(objects, object);
  return known != nullptr && known->movable && leeway(object).taken;
}

UnderFinger under_finger(const PointerScene& scene, const picture::Sight& sight, picture::PixelPlace place) {
  UnderFinger under;
  const auto picked = picture::picked_at(scene.scene, scene.assets, sight, place);
  if (picked && picked->object) under.seen = picture::Touched{*picked->object, picked->p_WT};
  const bool this_one = under.seen && scene.takeable(under.seen->object);
  under.takeable = this_one ? under.seen : takeable_about(scene, sight, place);
  return under;
}

std::vector<picture::PixelPlace> places_to_take(const PointerScene& scene, const picture::Sight& sight) {
  std::vector<picture::PixelPlace> out;
  for (const client::SceneObject& object : scene.objects) {
    if (!scene.takeable(object.index)) continue;
    if (const auto place = place_to_take(scene, sight, object.index)) out.push_back(*place);
  }
  std::ranges::sort(out, {}, &picture::PixelPlace::x);
  return out;
}

}  // namespace mechane::pointer
