#include "server/collision/superquadric_object.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::collision {
namespace {

constexpr int kResolution = 32;
constexpr int kMeshCells = 24;
constexpr std::uint64_t kSeed = 1;

/// Where the ray from the centre leaves the shape, in units of `direction`. F grows along the ray; without deformation the radial form
/// is the answer itself, with one a bisection finds it.
double surface_scale(const geometry::Superquadric& shape, const Vec3& direction) {
  if (!geometry::is_deformed(shape)) return 1 / geometry::radial_form(shape, direction);
  double inside = 0;
  double outside = 1;
  while (outside < 64 && geometry::inside_outside(shape, outside * direction) < 1)
    outside *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (geometry::inside_outside(shape, middle * direction) < 1 ? inside : outside) = middle;
  }
  return inside;
}

/// The extents of a deformed shape reach beyond its semi-axes; the map's box must hold them.
Vec3 half_extents(const geometry::Mesh& mesh) {
  Vec3 half = Vec3::Zero();
  for (const Vec3& v : mesh.vertices)
    half = half.cwiseMax(v.cwiseAbs());
  return half;
}

RadialMap map_of(const geometry::Superquadric& shape, const Vec3& half) {
  // Slightly wider, so that rounding does not put points of the surface outside the box.
  const Vec3f half_Q = (1.0001 * half).cast<float>();
  std::vector<float> sigma;
  sigma.reserve(std::size_t{6} * kResolution * kResolution);
  for (int face = 0; face < 6; ++face) {
    for (int texel = 0; texel < kResolution * kResolution; ++texel) {
      const Vec3 direction =
          RadialMap::texel_direction(kResolution, half_Q, face, texel % kResolution, texel / kResolution);
      sigma.push_back(static_cast<float>(1 / surface_scale(shape, direction)));
    }
  }
  return RadialMap::from_sigma(kResolution, Vec3f::Zero(), half_Q, sigma);
}

}  // namespace

Object make_superquadric_object(const geometry::Superquadric& shape, double sample_spacing_m) {
  MECHANE_ASSERT(geometry::is_valid(shape));
  MECHANE_ASSERT(std::isfinite(sample_spacing_m) && sample_spacing_m > 0);
  const geometry::Mesh mesh = geometry::tessellate(shape, kMeshCells);
  const Vec3 half = geometry::is_deformed(shape) ? half_extents(mesh) : shape.a;

  Object object;
  Part part;
  part.superquadric = shape;
  part.map = map_of(shape, half);
  part.bound_O = bounding_sphere(mesh.vertices);
  // The mesh's chords lie inside the surface: its vertices' sphere may miss a sliver between them.
  part.bound_O.radius *= 1.02;

  std::vector<Vec3> points;
  for (const auto& sample : geometry::sample_by_spacing(mesh, sample_spacing_m, kSeed)) {
    points.push_back(sample.p * surface_scale(shape, sample.p));
  }
  object.parts.push_back(std::move(part));
  append_samples(object, 0, std::move(points));
  close_clusters(object);
  return object;
}

Object mirrored(Object object) {
  const auto turn = [](auto& z) { z = -z; };
  turn(object.bound_O.center.z());
  for (Part& part : object.parts)
    turn(part.bound_O.center.z());
  for (Cluster& cluster : object.clusters) {
    turn(cluster.bound_O.center.z());
    std::ranges::for_each(cluster.samples_O.z, turn);
    std::ranges::for_each(cluster.quads_O.z, turn);
  }
  for (ClusterGroup& group : object.groups) {
    turn(group.bound_O.center.z());
    std::ranges::for_each(group.bounds_O.z, turn);
  }
  return object;
}

}  // namespace mechane::collision
