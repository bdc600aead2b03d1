#include "server/collision/part_source.hpp"

#include <algorithm>
#include <cmath>

#include "server/geometry/surface_samples.hpp"

namespace mechane::collision {
namespace {

constexpr std::size_t kPlaces = 2400;

bool exposed(const Solid& solid, std::size_t node, const geometry::SurfaceSample& sample) {
  return solid.is_exposed(node, sample.p, solid.part(node).triangle_normal(sample.triangle));
}

std::vector<SurfacePlace> exposed_places(const geometry::Mesh& mesh, std::size_t node, const Solid& solid,
                                         std::uint64_t seed) {
  std::vector<SurfacePlace> places;
  for (const auto& sample : geometry::sample_by_area(mesh, kPlaces, seed)) {
    if (exposed(solid, node, sample)) places.push_back({sample.p, solid.part(node).triangle_normal(sample.triangle)});
  }
  return places;
}

/// Samples of the node's surface where it borders on air, at the wanted spacing or, above the cap, at a wider one.
std::vector<Vec3> exposed_samples(const geometry::Mesh& mesh, std::size_t node, const Solid& solid,
                                  const BuildConfig& config, std::size_t cap, double& spacing) {
  const auto accept = [&](const geometry::SurfaceSample& sample) { return exposed(solid, node, sample); };
  // A rough count first, so that a huge part is not sampled finely for nothing.
  const double cells = geometry::surface_area_m2(mesh) / static_cast<double>(2 * cap);
  spacing = std::max(config.sample_spacing_m, std::sqrt(cells));
  std::vector<geometry::SurfaceSample> samples;
  for (int round = 0; round < 8; ++round) {
    samples = geometry::sample_by_spacing(mesh, spacing, config.seed, accept);
    if (samples.size() <= cap) break;
    spacing *= 1.05 * std::sqrt(static_cast<double>(samples.size()) / static_cast<double>(cap));
  }
  if (samples.size() > cap) samples.resize(cap);
  std::vector<Vec3> points;
  points.reserve(samples.size());
  for (const auto& sample : samples)
    points.push_back(sample.p);
  return points;
}

}  // namespace

geometry::Mesh air_side(std::span<const geometry::Mesh> nodes, const Solid& solid) {
  geometry::Mesh skin;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(skin.vertices.size());
    skin.vertices.insert(skin.vertices.end(), nodes[i].vertices.begin(), nodes[i].vertices.end());
    for (std::uint32_t t = 0; t < nodes[i].triangles.size(); ++t) {
      const auto& v = nodes[i].triangles[t];
      const Vec3 n = solid.part(i).triangle_normal(t);
      const Vec3 middle = (nodes[i].vertices[v[0]] + nodes[i].vertices[v[1]] + nodes[i].vertices[v[2]]) / 3;
      bool in_air = solid.is_exposed(i, middle, n);
      for (int k = 0; k < 3 && !in_air; ++k) {
        in_air = solid.is_exposed(i, 0.2 * middle + 0.8 * nodes[i].vertices[v[k]], n);
      }
      if (in_air) skin.triangles.push_back({v[0] + base, v[1] + base, v[2] + base});
    }
  }
  return skin;
}

PartSource source_of_node(const std::string& name, const geometry::Mesh& mesh, std::size_t node, const Solid& solid,
                          const BuildConfig& config) {
  PartSource source;
  source.name = name;
  source.node = node;
  source.places = exposed_places(mesh, node, solid, config.seed);
  source.bound_points_O = mesh.vertices;
  source.samples_O = exposed_samples(mesh, node, solid, config, config.max_samples_per_part, source.spacing_m);
  return source;
}

}  // namespace mechane::collision
