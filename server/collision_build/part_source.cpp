#include "server/collision_build/part_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/geometry/surface_samples.hpp"

namespace mechane::collision_build {
namespace {

constexpr std::size_t kPlaces = 2400;     // of a part's surface, for the choice of its map
constexpr std::size_t kLeastPoints = 12;  // a superquadric takes as many

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

/// The piece whose half-spaces hold the point, or that it is the least outside of: so a sample on a cut belongs to one piece.
std::size_t piece_of(const geometry::Decomposition& cut, const Vec3& p) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    double worst = 0;
    for (const geometry::HalfSpace& side : cut.pieces[i].cell)
      worst = std::max(worst, side.n.dot(p) - side.d);
    if (worst >= least) continue;
    least = worst;
    best = i;
  }
  return best;
}

void describe_piece(const geometry::Piece& piece, std::size_t node, const Solid& solid, PartSource& source) {
  const geometry::MeshQuery& surface = solid.part(node);
  source.cell = piece.cell;
  const std::size_t step = std::max<std::size_t>(1, piece.surface_points.size() / kPlaces);
  for (std::size_t i = 0; i < piece.surface_points.size(); i += step) {
    const Vec3& p = piece.surface_points[i];
    const Vec3 n = surface.triangle_normal(surface.closest(p).triangle);
    if (solid.is_exposed(node, p, n)) source.places.push_back({p, n});
  }
  source.bound_points_O = piece.surface_points;
  source.bound_points_O.insert(source.bound_points_O.end(), piece.cut_points.begin(), piece.cut_points.end());
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

std::vector<PartSource> sources_of_node(const std::string& name, const geometry::Mesh& mesh, std::size_t node,
                                        const geometry::Decomposition& cut, const Solid& solid,
                                        const BuildConfig& config) {
  const std::size_t pieces = std::max<std::size_t>(1, cut.pieces.size());
  std::vector<PartSource> sources(pieces);
  double spacing = 0;
  const auto samples = exposed_samples(mesh, node, solid, config, pieces * config.max_samples_per_part, spacing);
  if (pieces == 1) {
    sources[0].name = name;
    sources[0].places = exposed_places(mesh, node, solid, config.seed);
    sources[0].bound_points_O = mesh.vertices;
    sources[0].samples_O = samples;
  } else {
    for (std::size_t i = 0; i < pieces; ++i) {
      sources[i].name = name + "." + std::to_string(i + 1);
      describe_piece(cut.pieces[i], node, solid, sources[i]);
    }
    for (const Vec3& p : samples)
      sources[piece_of(cut, p)].samples_O.push_back(p);
  }
  std::erase_if(sources,
                [](const PartSource& s) { return !s.is_whole_node() && s.bound_points_O.size() < kLeastPoints; });
  for (PartSource& source : sources) {
    source.node = node;
    source.spacing_m = spacing;
  }
  return sources;
}

}  // namespace mechane::collision_build
