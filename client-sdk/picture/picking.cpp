#include "client-sdk/picture/picking.hpp"

#include <cmath>
#include <limits>

namespace mechane::picture {
namespace {

struct Ray {
  Vec3f p = Vec3f::Zero();
  Vec3f d = Vec3f::UnitZ();
};

/// How far along the ray it meets the triangle, from either side (Moller and Trumbore 1997); infinite: not at all.
float distance_to(const Ray& ray, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  constexpr float kMissed = std::numeric_limits<float>::infinity();
  const Vec3f u = b - a;
  const Vec3f v = c - a;
  const Vec3f n = ray.d.cross(v);
  const float det = u.dot(n);
  if (std::abs(det) < 1e-12F) return kMissed;
  const Vec3f from_a = ray.p - a;
  const float s = from_a.dot(n) / det;
  const Vec3f m = from_a.cross(u);
  const float t = ray.d.dot(m) / det;
  const float distance = v.dot(m) / det;
  return s >= 0 && t >= 0 && s + t <= 1 && distance > 0 ? distance : kMissed;
}

/// X_WM may scale: the ray's direction is not normalised in M, so distances are those in W.
float distance_to(const Ray& ray_W, const Instance& instance, const MeshData& mesh) {
  const Eigen::Affine3f X_MW = instance.X_WM.inverse();
  const Ray ray{X_MW * ray_W.p, X_MW.linear() * ray_W.d};
  float nearest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    nearest = std::min(nearest, distance_to(ray, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                                            mesh.positions[mesh.indices[i + 2]]));
  }
  return nearest;
}

}  // namespace

std::optional<Picked> picked_at(const RenderScene& scene, const SceneAssets& assets, const Sight& sight,
                                PixelPlace place) {
  const SightRay through = ray_through(sight, place);
  const Ray ray{through.p_W.cast<float>(), through.d_W.cast<float>()};
  float nearest = std::numeric_limits<float>::infinity();
  std::optional<std::uint32_t> object;
  for (const Instance& instance : scene.instances) {
    if (!instance.near) continue;
    const float distance = distance_to(ray, instance, assets.meshes[instance.mesh]);
    if (distance >= nearest) continue;
    nearest = distance;
    object = instance.object;
  }
  if (!std::isfinite(nearest)) return {};
  return Picked{object, through.p_W + static_cast<double>(nearest) * through.d_W};
}

std::optional<std::uint32_t> object_at(const RenderScene& scene, const SceneAssets& assets, PixelPlace place,
                                       Stereo stereo, PixelSize pictured) {
  const auto seen = seen_place(scene.camera, stereo, pictured, place);
  const auto picked = seen ? picked_at(scene, assets, seen->sight, seen->place) : std::nullopt;
  return picked ? picked->object : std::nullopt;
}

}  // namespace mechane::picture
