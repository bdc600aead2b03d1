#include "server/geometry/solid/shells.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "server/geometry/area_normal.hpp"

namespace mechane::geometry {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) {
    parent[v] = parent[parent[v]];
    v = parent[v];
  }
  return v;
}

/// What lies across a triangle's edge.
struct Across {
  std::uint32_t triangle = kNone;  // kNone: nothing, or more than one
  bool same_way = true;
};

/// The neighbours of each triangle, edge k from corner k to the next.
std::vector<std::array<Across, 3>> neighbours_of(const Mesh& mesh) {
  struct Side {
    std::uint64_t edge = 0;
    std::uint32_t triangle = 0, k = 0;
    bool upwards = false;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.triangles[t][k];
      const std::uint32_t to = mesh.triangles[t][(k + 1) % 3];
      sides.push_back({std::uint64_t{std::min(from, to)} << 32 | std::max(from, to), t, k, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& l, const Side& r) { return std::pair(l.edge, l.triangle) < std::pair(r.edge, r.triangle); });
  std::vector<std::array<Across, 3>> across(mesh.triangles.size());
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge)
      ++end;
    if (end == i + 2) {
      const Side& a = sides[i];
      const Side& b = sides[i + 1];
      across[a.triangle][a.k] = {b.triangle, a.upwards != b.upwards};
      across[b.triangle][b.k] = {a.triangle, a.upwards != b.upwards};
    }
    i = end;
  }
  return across;
}

/// Triangles reached from one another by `may_cross`, which is called with (triangle, its neighbour) for each new one.
template <class MayCross>
std::vector<Shell> flood(const std::vector<std::array<Across, 3>>& across, const MayCross& may_cross) {
  std::vector<bool> seen(across.size());
  std::vector<Shell> shells;
  for (std::uint32_t first = 0; first < across.size(); ++first) {
    if (seen[first]) continue;
    Shell shell = {first};
    seen[first] = true;
    for (std::size_t next = 0; next < shell.size(); ++next) {
      for (const Across& other : across[shell[next]]) {
        if (other.triangle == kNone || seen[other.triangle] || !may_cross(shell[next], other)) continue;
        seen[other.triangle] = true;
        shell.push_back(other.triangle);
      }
    }
    std::sort(shell.begin(), shell.end());
    shells.push_back(std::move(shell));
  }
  return shells;
}

}  // namespace

std::vector<Shell> shells_of(const Mesh& welded) {
  std::vector<std::uint32_t> parent(welded.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const auto& t : welded.triangles) {
    for (int k = 1; k < 3; ++k)
      parent[root_of(parent, t[k])] = root_of(parent, t[0]);
  }
  std::vector<std::uint32_t> shell_of(welded.vertices.size(), kNone);
  std::vector<Shell> shells;
  for (std::uint32_t i = 0; i < welded.triangles.size(); ++i) {
    std::uint32_t& shell = shell_of[root_of(parent, welded.triangles[i][0])];
    if (shell == kNone) {
      shell = static_cast<std::uint32_t>(shells.size());
      shells.emplace_back();
    }
    shells[shell].push_back(i);
  }
  return shells;
}

Mesh mesh_of(const Mesh& mesh, const Shell& shell) {
  Mesh alone;
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kNone);
  for (const std::uint32_t i : shell) {
    auto t = mesh.triangles[i];
    for (std::uint32_t& v : t) {
      if (new_index[v] == kNone) {
        new_index[v] = static_cast<std::uint32_t>(alone.vertices.size());
        alone.vertices.push_back(mesh.vertices[v]);
      }
      v = new_index[v];
    }
    alone.triangles.push_back(t);
  }
  return alone;
}

std::size_t make_consistent(Mesh& welded) {
  const auto across = neighbours_of(welded);
  std::vector<bool> against(welded.triangles.size());  // the first triangle of its patch
  std::size_t turned = 0;
  for (const Shell& patch : flood(across, [&](std::uint32_t from, const Across&to) {
         against[to.triangle] = against[from] != !to.same_way;
         return true;
       })) {
    double balance = 0;
    for (const std::uint32_t i : patch)
      balance += (against[i] ? -1 : 1) * area_normal(welded, i).norm();
    for (const std::uint32_t i : patch) {
      if (against[i] != (balance >= 0)) continue;
      std::swap(welded.triangles[i][1], welded.triangles[i][2]);
      ++turned;
    }
  }
  return turned;
}

std::vector<Shell> patches_of(const Mesh& welded) {
  return flood(neighbours_of(welded), [](std::uint32_t, const Across& to) { return to.same_way; });
}

}  // namespace mechane::geometry
