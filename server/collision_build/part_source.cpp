#include "server/collision_build/part_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "server/base/parallel.hpp"
#include "server/geometry/mesh_check.hpp"
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

using Corners = std::array<Vec3, 3>;

Corners corners_of(const geometry::Mesh& mesh, std::size_t triangle) {
  const auto& v = mesh.triangles[triangle];
  return {mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]};
}

/// At how many of four places of the triangle the node borders on air.
int air_places(const Solid& solid, std::size_t node, const Corners& t, const Vec3& n) {
  const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
  int places = solid.is_exposed(node, middle, n) ? 1 : 0;
  for (const Vec3& corner : t)
    places += solid.is_exposed(node, 0.2 * middle + 0.8 * corner, n) ? 1 : 0;
  return places;
}

/// A node's triangles as far as they border on air. Those that do in part are halved, and what lies in other parts is left out.
class AirSide {
 public:
  AirSide(const geometry::Mesh& mesh, std::size_t node, const Solid& solid, double finest_m)
      : node_(node), solid_(solid), finest_m_(finest_m) {
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const Corners t = corners_of(mesh, i);
      n_ = solid.part(node).triangle_normal(i);
      if (solid.is_alone(node, t)) {
        kept_.push_back(t);
      } else {
        static_cast<void>(keep(t));
      }
    }
  }
  [[nodiscard]] std::vector<Corners> kept() { return std::move(kept_); }

 private:
  static constexpr double kSure =
      16;  // of finest_m: a triangle so small is as four of its places are, if they are alike

  /// Says whether all of it is kept; then it is in one piece.
  bool keep(const Corners& t) {
    std::size_t from = 0;
    const auto edge_m = [&](std::size_t i) { return (t[(i + 1) % 3] - t[i]).norm(); };
    for (std::size_t i = 1; i < 3; ++i)
      from = edge_m(i) > edge_m(from) ? i : from;
    const double longest_m = edge_m(from);
    if (longest_m <= kSure * finest_m_) {
      const int places = air_places(solid_, node_, t, n_);
      if (places == 0) return false;
      if (places == 4 || longest_m <= finest_m_) {
        kept_.push_back(t);
        return true;
      }
    }
    const std::size_t to = (from + 1) % 3;
    Corners first = t;
    Corners second = t;
    first[to] = second[from] = 0.5 * (t[from] + t[to]);
    const std::size_t before = kept_.size();
    const bool all_of_first = keep(first);
    const bool all = keep(second) && all_of_first;
    if (all) {
      kept_.resize(before);
      kept_.push_back(t);
    }
    return all;
  }

  std::size_t node_;
  const Solid& solid_;
  double finest_m_;
  Vec3 n_ = Vec3::Zero();
  std::vector<Corners> kept_;
};

}  // namespace

geometry::Mesh air_side(std::span<const geometry::Mesh> nodes, const Solid& solid) {
  geometry::Mesh skin;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto base = static_cast<std::uint32_t>(skin.vertices.size());
    skin.vertices.insert(skin.vertices.end(), nodes[i].vertices.begin(), nodes[i].vertices.end());
    for (std::uint32_t t = 0; t < nodes[i].triangles.size(); ++t) {
      const auto& v = nodes[i].triangles[t];
      const bool in_air = air_places(solid, i, corners_of(nodes[i], t), solid.part(i).triangle_normal(t)) > 0;
      if (in_air) skin.triangles.push_back({v[0] + base, v[1] + base, v[2] + base});
    }
  }
  return skin;
}

geometry::Mesh cut_air_side(std::span<const geometry::Mesh> nodes, const Solid& solid, double finest_m) {
  std::vector<std::vector<Corners>> kept(nodes.size());
  for_each_index(nodes.size(), [&](std::size_t i) { kept[i] = AirSide(nodes[i], i, solid, finest_m).kept(); });
  geometry::Mesh skin;
  for (const std::vector<Corners>& some : kept) {
    for (const Corners& t : some) {
      const auto first = static_cast<std::uint32_t>(skin.vertices.size());
      skin.vertices.insert(skin.vertices.end(), t.begin(), t.end());
      skin.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return geometry::weld(skin);
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

PartSource unite(std::span<const geometry::Mesh> nodes, std::span<const PartSource> sources) {
  PartSource whole;
  whole.name = "whole";
  for (const geometry::Mesh& node : nodes)
    whole.bound_points_O.insert(whole.bound_points_O.end(), node.vertices.begin(), node.vertices.end());
  for (const PartSource& source : sources) {
    whole.places.insert(whole.places.end(), source.places.begin(), source.places.end());
    whole.samples_O.insert(whole.samples_O.end(), source.samples_O.begin(), source.samples_O.end());
    whole.spacing_m = std::max(whole.spacing_m, source.spacing_m);
  }
  return whole;
}

}  // namespace mechane::collision_build
