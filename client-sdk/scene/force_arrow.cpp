#include "client-sdk/scene/force_arrow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace mechane::scene {
namespace {

constexpr double kHead = 0.030;     // share of the distance, like the radii below
constexpr double kAside_m = 0.045;  // more than a hand is thick
constexpr int kAround = 20;

struct ArrowRing {
  float x = 0, radius = 0;
};

/// Turned about x; each pair of rings has an edge of its own.
picture::MeshData turned(std::span<const ArrowRing> rings) {
  picture::MeshData mesh;
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    const ArrowRing& a = rings[i];
    const ArrowRing& b = rings[i + 1];
    const Eigen::Vector2f out = Eigen::Vector2f(a.radius - b.radius, b.x - a.x).normalized();  // along x, and outwards
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int s = 0; s <= kAround; ++s) {
      const float angle = kTwoPiF * static_cast<float>(s) / kAround;
      const Vec3f aside(0, std::cos(angle), std::sin(angle));
      for (const ArrowRing& ring : {a, b}) {
        mesh.positions.emplace_back(ring.x * Vec3f::UnitX() + ring.radius * aside);
        mesh.normals.emplace_back(out.x() * Vec3f::UnitX() + out.y() * aside);
      }
    }
    for (std::uint32_t s = 0; s < kAround; ++s) {
      const std::uint32_t at = first + 2 * s;
      mesh.indices.insert(mesh.indices.end(), {at, at + 1, at + 3, at, at + 3, at + 2});
    }
  }
  return mesh;
}

}  // namespace

ForceArrow::ForceArrow(AssetLibrary& library) {
  constexpr std::array<ArrowRing, 3> kShaft{{{0, 0}, {0, 0.004F}, {1, 0.004F}}};
  constexpr std::array<ArrowRing, 3> kPoint{{{0, 0}, {0, 0.011F}, {static_cast<float>(kHead), 0}}};
  shaft_ = library.add_mesh(turned(kShaft));
  head_ = library.add_mesh(turned(kPoint));
  picture::MaterialData material;
  material.base_colour = Eigen::Vector4f(0.85F, 0.33F, 0.05F, 1);
  material.emissive = Vec3f(0.35F, 0.12F, 0.01F);
  material.roughness = 0.6F;
  material_ = library.add_material(material);
}

void ForceArrow::draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const {
  const double force_n = hand.force_W.norm();
  if (hand.stale || !(force_n >= kLeast_n)) return;
  const Vec3 direction_W = hand.force_W / force_n;
  const Vec3 to_camera_W = camera.p_WC - hand.X_WS[0].p;
  const double distance_m = std::max(to_camera_W.norm(), 0.1);
  const double length_m = distance_m * std::min(kLengthPerNewton * force_n, kLongest);
  const Vec3 p_W = hand.X_WS[0].p + (kAside_m / distance_m) * to_camera_W;
  const auto scale = static_cast<float>(distance_m);
  Eigen::Affine3f X = Eigen::Affine3f::Identity();
  const Eigen::Matrix3f R = Quat::FromTwoVectors(Vec3::UnitX(), direction_W).toRotationMatrix().cast<float>();
  X.linear() = scale * R;
  X.translation() = (p_W + length_m * direction_W).cast<float>();
  out.instances.push_back({head_, material_, X, false});
  X.linear() = R * Eigen::DiagonalMatrix<float, 3>(static_cast<float>(length_m), scale, scale);
  X.translation() = p_W.cast<float>();
  out.instances.push_back({shaft_, material_, X, false});
}

}  // namespace mechane::scene
