#include "client-sdk/scene/surface_net.hpp"

#include <array>
#include <cmath>

namespace mechane::scene {
namespace {

using Cell = std::array<std::size_t, 3>;
constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};

/// Distances at the corners of a grid of cells.
struct DistanceGrid {
  Vec3f low;
  float cell_m;
  Cell count;  ///< corners along each axis
  std::vector<float> values;

  [[nodiscard]] std::size_t at(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * count[1] + y) * count[0] + x;
  }
  [[nodiscard]] Vec3f place(std::size_t x, std::size_t y, std::size_t z) const {
    return low + cell_m * Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  }
};

DistanceGrid sampled(const std::function<float(const Vec3f&)>& distance, const Eigen::AlignedBox3f& box, float cell_m) {
  DistanceGrid grid{box.min(), cell_m, {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.count[axis] = 2 + static_cast<std::size_t>(std::ceil(box.sizes()(static_cast<Eigen::Index>(axis)) / cell_m));
  grid.values.reserve(grid.count[0] * grid.count[1] * grid.count[2]);
  for (std::size_t z = 0; z < grid.count[2]; ++z) {
    for (std::size_t y = 0; y < grid.count[1]; ++y) {
      for (std::size_t x = 0; x < grid.count[0]; ++x)
        grid.values.push_back(distance(grid.place(x, y, z)));
    }
  }
  return grid;
}

/// Mean of the points where the surface crosses the cell's edges; none if it does not.
std::optional<Vec3f> crossing(const DistanceGrid& grid, const Cell& c) {
  Vec3f sum = Vec3f::Zero();
  int crossings = 0;
  const auto corner = [&](unsigned i) {
    return std::array<std::size_t, 3>{c[0] + (i & 1U), c[1] + (i >> 1U & 1U), c[2] + (i >> 2U & 1U)};
  };
  for (unsigned a = 0; a < 8; ++a) {
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((a >> axis & 1U) != 0) continue;
      const auto p = corner(a);
      const auto q = corner(a | 1U << axis);
      const float dp = grid.values[grid.at(p[0], p[1], p[2])];
      const float dq = grid.values[grid.at(q[0], q[1], q[2])];
      if ((dp < 0) == (dq < 0)) continue;
      const Vec3f from = grid.place(p[0], p[1], p[2]);
      sum += from + dp / (dp - dq) * (grid.place(q[0], q[1], q[2]) - from);
      ++crossings;
    }
  }
  if (crossings == 0) return std::nullopt;
  return Vec3f(sum / static_cast<float>(crossings));
}

Vec3f gradient(const std::function<float(const Vec3f&)>& distance, const Vec3f& p, float step_m) {
  Vec3f g;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3f d = step_m * Vec3f::Unit(axis);
    g(axis) = distance(p + d) - distance(p - d);
  }
  return g.norm() > 0 ? Vec3f(g.normalized()) : Vec3f(Vec3f::UnitY());
}

/// Adds a quad for each grid edge that the surface crosses, between the four cells around it.
void add_quads(const DistanceGrid& grid, const std::vector<std::uint32_t>& vertex_of, picture::MeshData& mesh) {
  const std::array<std::size_t, 3> step{1, grid.count[0], grid.count[0] * grid.count[1]};
  for (std::size_t z = 1; z + 1 < grid.count[2]; ++z) {
    for (std::size_t y = 1; y + 1 < grid.count[1]; ++y) {
      for (std::size_t x = 1; x + 1 < grid.count[0]; ++x) {
        const std::size_t here = grid.at(x, y, z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool inside = grid.values[here] < 0;
          if (inside == (grid.values[here + step[axis]] < 0)) continue;
          const std::size_t u = step[(axis + 1) % 3];
          const std::size_t v = step[(axis + 2) % 3];
          const std::uint32_t a = vertex_of[here - u - v];
          const std::uint32_t b = vertex_of[here - v];
          const std::uint32_t c = vertex_of[here];
          const std::uint32_t d = vertex_of[here - u];
          if (inside) {
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
          } else {
            mesh.indices.insert(mesh.indices.end(), {a, c, b, a, d, c});
          }
        }
      }
    }
  }
}

}  // namespace

picture::MeshData surface_net(const std::function<float(const Vec3f&)>& distance, const Eigen::AlignedBox3f& box,
                              float cell_m) {
  const DistanceGrid grid = sampled(distance, box, cell_m);
  picture::MeshData mesh;
  std::vector<std::uint32_t> vertex_of(grid.values.size(), kNoVertex);
  for (std::size_t z = 0; z + 1 < grid.count[2]; ++z) {
    for (std::size_t y = 0; y + 1 < grid.count[1]; ++y) {
      for (std::size_t x = 0; x + 1 < grid.count[0]; ++x) {
        const std::optional<Vec3f> p = crossing(grid, {x, y, z});
        if (!p) continue;
        vertex_of[grid.at(x, y, z)] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(*p);
        mesh.normals.push_back(gradient(distance, *p, 0.3F * cell_m));
      }
    }
  }
  add_quads(grid, vertex_of, mesh);
  return mesh;
}

}  // namespace mechane::scene
