#include "server/geometry/solid/membrane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "server/base/parallel.hpp"
#include "server/geometry/mesh_check.hpp"

namespace mechane::geometry {
namespace {

using Lattice = std::array<std::int32_t, 3>;

// Shares of a cell: lattice lines must not run along faces with round coordinates.
const Vec3 kBesideRound(0.3183, 0.2718, 0.4142);
constexpr std::size_t kMostCells = 4'000'000;
constexpr std::size_t kQuestionsTogether = 64;  // questions of one piece of work

struct LatticeHash {
  std::size_t operator()(const Lattice& at) const {
    std::uint64_t h = 0;
    for (const std::int32_t i : at)
      h = (h ^ static_cast<std::uint32_t>(i)) * 0x9E3779B97F4A7C15U;
    return h ^ h >> 29;
  }
};

/// An edge of the lattice, from a node along an axis.
struct Edge {
  Lattice from{};
  std::size_t axis = 0;
};

/// Where an edge passes from outside to inside or back.
struct Crossing {
  double share = 0;       // of the edge, from its first node
  bool in_air = false;    // and not through a triangle
  bool outwards = false;  // along the edge
};

Lattice moved(Lattice at, std::size_t axis, std::int32_t by) {
  at[axis] += by;
  return at;
}

/// Follows the surface cell by cell.
class Follower {
 public:
  Follower(const MeshQuery& query, const Vec3& origin, double cell_m)
      : query_(query), origin_(origin - cell_m * kBesideRound), cell_m_(cell_m) {}

  /// The cell about p and those around it.
  void start_at(const Vec3& p) {
    const Lattice at = cell_of(p);
    for (std::int32_t n = 0; n < 27; ++n)
      visit({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
  }

  /// A point of an open edge: a skin in its cell hangs there.
  void hang_at(const Vec3& p) {
    Hang& hang = hangs_[cell_of(p)];
    hang.sum += p;
    ++hang.count;
    start_at(p);
  }

  /// Goes wherever the surface goes.
  void follow() {
    while (!fresh_.empty() && cells_.size() < kMostCells) {
      const std::vector<Lattice> now = std::move(fresh_);
      fresh_.clear();
      measure_corners(now);
      const std::vector<Edge> edges = new_edges(now);
      std::vector<std::optional<Crossing>> found(edges.size());
      in_parallel(edges.size(), [&](std::size_t i) { found[i] = cross(edges[i]); });
      for (std::size_t i = 0; i < edges.size(); ++i) {
        crossings_[edges[i].axis].at(edges[i].from) = found[i];
        if (!found[i] || !found[i]->in_air) continue;
        skin_.push_back(edges[i]);
        for (const Lattice& cell : around(edges[i]))
          visit(cell);
      }
    }
  }

  [[nodiscard]] Mesh skin() const {
    Mesh mesh;
    std::unordered_map<Lattice, std::uint32_t, LatticeHash> vertex_of;
    for (const Edge& edge : skin_) {
      std::array<std::uint32_t, 4> v{};
      const std::array<Lattice, 4> cells = around(edge);
      for (std::size_t i = 0; i < 4; ++i) {
        const auto [it, is_new] = vertex_of.try_emplace(cells[i], static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(vertex_in(cells[i]));
        v[i] = it->second;
      }
      if (!crossings_[edge.axis].at(edge.from)->outwards) std::swap(v[1], v[3]);
      mesh.triangles.push_back({v[0], v[1], v[2]});
      mesh.triangles.push_back({v[0], v[2], v[3]});
    }
    return mesh;
  }

 private:
  struct Hang {
    Vec3 sum = Vec3::Zero();
    int count = 0;
  };

  template <class Body>
  static void in_parallel(std::size_t count, const Body& body) {
    for_each_index((count + kQuestionsTogether - 1) / kQuestionsTogether, [&](std::size_t chunk) {
      for (std::size_t i = kQuestionsTogether * chunk; i < std::min(count, kQuestionsTogether * (chunk + 1)); ++i)
        body(i);
    });
  }

  [[nodiscard]] Lattice cell_of(const Vec3& p) const {
    const Vec3 at = (p - origin_) / cell_m_;
    return {static_cast<std::int32_t>(std::floor(at.x())), static_cast<std::int32_t>(std::floor(at.y())),
            static_cast<std::int32_t>(std::floor(at.z()))};
  }
  [[nodiscard]] Vec3 place(const Lattice& node) const { return origin_ + cell_m_ * Vec3(node[0], node[1], node[2]); }

  void visit(const Lattice& cell) {
    if (cells_.insert(cell).second) fresh_.push_back(cell);
  }

  /// The cells that share an edge, counter-clockwise seen against its axis.
  [[nodiscard]] static std::array<Lattice, 4> around(const Edge& edge) {
    const std::size_t u = (edge.axis + 1) % 3;
    const std::size_t v = (edge.axis + 2) % 3;
    const Lattice low = moved(moved(edge.from, u, -1), v, -1);
    return {low, moved(low, u, 1), edge.from, moved(low, v, 1)};
  }

  /// The twelve edges of a cell.
  template <class Visit>
  static void for_each_edge(const Lattice& cell, const Visit& visit) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::int32_t i = 0; i < 4; ++i)
        visit(Edge{moved(moved(cell, (axis + 1) % 3, i % 2), (axis + 2) % 3, i / 2), axis});
    }
  }

  void measure_corners(const std::vector<Lattice>& cells) {
    std::vector<Lattice> nodes;
    for (const Lattice& cell : cells) {
      for (std::int32_t i = 0; i < 8; ++i) {
        const Lattice node = {cell[0] + i % 2, cell[1] + i / 2 % 2, cell[2] + i / 4};
        if (winding_.try_emplace(node, 0).second) nodes.push_back(node);
      }
    }
    std::vector<double> values(nodes.size());
    in_parallel(nodes.size(), [&](std::size_t i) { values[i] = query_.winding_number(place(nodes[i])); });
    for (std::size_t i = 0; i < nodes.size(); ++i)
      winding_[nodes[i]] = values[i];
  }

  /// Those edges of the cells that nobody has looked at.
  std::vector<Edge> new_edges(const std::vector<Lattice>& cells) {
    std::vector<Edge> edges;
    for (const Lattice& cell : cells) {
      for_each_edge(cell, [&](const Edge& edge) {
        if (crossings_[edge.axis].try_emplace(edge.from, std::nullopt).second) edges.push_back(edge);
      });
    }
    return edges;
  }

  /// Along an edge the number changes by 1 at each triangle, and evenly between.
  [[nodiscard]] std::optional<Crossing> cross(const Edge& edge) const {
    const double first = winding_.at(edge.from);
    const double last = winding_.at(moved(edge.from, edge.axis, 1));
    if ((first > 0.5) == (last > 0.5)) return std::nullopt;
    std::vector<RayHit> hits;
    query_.cast(place(edge.from), cell_m_ * Vec3::Unit(static_cast<Eigen::Index>(edge.axis)), hits);
    std::erase_if(hits, [](const RayHit& hit) { return hit.t > 1; });
    double slope = last - first;
    for (const RayHit& hit : hits)
      slope -= hit.entering ? 1 : -1;
    double jumps = 0;
    const bool outwards = first > 0.5;
    const auto is_inside = [&](double t) { return first + jumps + slope * t > 0.5; };
    double from = 0;
    for (const RayHit& hit : hits) {
      if (is_inside(hit.t) != outwards) return in_air(from, hit.t, first + jumps, slope, outwards);
      jumps += hit.entering ? 1 : -1;
      if (is_inside(hit.t) != outwards) return Crossing{hit.t, false, outwards};
      from = hit.t;
    }
    return in_air(from, 1, first + jumps, slope, outwards);
  }

  [[nodiscard]] static Crossing in_air(double from, double to, double base, double slope, bool outwards) {
    const double share = slope != 0 ? (0.5 - base) / slope : from;
    return {std::clamp(share, from, to), true, outwards};
  }

  [[nodiscard]] Vec3 vertex_in(const Lattice& cell) const {
    if (const auto hang = hangs_.find(cell); hang != hangs_.end()) return hang->second.sum / hang->second.count;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for_each_edge(cell, [&](const Edge& edge) {
      const auto found = crossings_[edge.axis].find(edge.from);
      if (found == crossings_[edge.axis].end() || !found->second) return;
      sum += place(edge.from) + found->second->share * cell_m_ * Vec3::Unit(static_cast<Eigen::Index>(edge.axis));
      ++count;
    });
    return count > 0 ? Vec3(sum / count) : Vec3(place(cell) + Vec3::Constant(0.5 * cell_m_));
  }

  template <class Value>
  using Map = std::unordered_map<Lattice, Value, LatticeHash>;

  const MeshQuery& query_;
  Vec3 origin_;
  double cell_m_;
  std::unordered_set<Lattice, LatticeHash> cells_;
  std::vector<Lattice> fresh_;
  Map<double> winding_;
  Map<Hang> hangs_;
  std::array<Map<std::optional<Crossing>>, 3> crossings_;  // of the edges looked at, by axis
  std::vector<Edge> skin_;
};

}  // namespace

Mesh membranes(const Mesh& mesh, const MeshQuery& query, std::span<const Vec3> seeds, double cell_m) {
  Follower follower(query, mesh.bounds().min(), cell_m);
  for (const auto& [a, b] : rims(mesh)) {
    const Vec3& from = mesh.vertices[a];
    const Vec3 way = mesh.vertices[b] - from;
    const auto steps = static_cast<int>(std::ceil(2 * way.norm() / cell_m));
    for (int i = 0; i <= steps; ++i)
      follower.hang_at(from + i / std::max(1.0, static_cast<double>(steps)) * way);
  }
  for (const Vec3& seed : seeds)
    follower.start_at(seed);
  follower.follow();
  return follower.skin();
}

}  // namespace mechane::geometry
