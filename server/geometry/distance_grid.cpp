#include "server/geometry/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/base/parallel.hpp"

namespace mechane::geometry {
namespace {

constexpr double kBand =
    1.8;  // cells; above the cell's diagonal, so that every corner of a cell with surface in it is exact
constexpr int kMargin = 2;  // cells about the mesh
// Shares of a cell by which the grid is shifted, so that its lines do not run along the faces of a mesh with round coordinates.
const Vec3 kOffGrid(0.3183, 0.2718, 0.4142);

}  // namespace

DistanceGrid::DistanceGrid(const Mesh& mesh, const MeshQuery& query, int cells) {
  const Eigen::AlignedBox3d box = mesh.bounds();
  cell_m_ = box.sizes().maxCoeff() / cells;
  origin_ = box.min() - cell_m_ * (Vec3::Constant(kMargin) + kOffGrid);
  for (int i = 0; i < 3; ++i)
    size_[static_cast<std::size_t>(i)] = static_cast<int>(std::ceil(box.sizes()[i] / cell_m_)) + 2 * kMargin + 2;
  const std::size_t count = index(0, 0, size_[2]);
  distance_m_.assign(count, std::numeric_limits<float>::infinity());
  std::vector<Vec3f> closest(count, Vec3f::Zero());
  measure_near(query, mark_near(mesh), closest);
  spread(closest);
  set_signs(query);
}

Vec3 DistanceGrid::position(std::size_t node) const {
  const auto sx = static_cast<std::size_t>(size_[0]);
  const auto sy = static_cast<std::size_t>(size_[1]);
  const std::size_t layer = node / (sx * sy);
  const Vec3 at(static_cast<double>(node % sx), static_cast<double>(node / sx % sy), static_cast<double>(layer));
  return origin_ + cell_m_ * at;
}

std::vector<std::uint8_t> DistanceGrid::mark_near(const Mesh& mesh) const {
  std::vector<std::uint8_t> near(distance_m_.size(), 0);
  const double band = kBand * cell_m_;
  for (const auto& t : mesh.triangles) {
    Eigen::AlignedBox3d box(mesh.vertices[t[0]]);
    box.extend(mesh.vertices[t[1]]).extend(mesh.vertices[t[2]]);
    const Vec3 across =
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).normalized();
    std::array<int, 3> from{};
    std::array<int, 3> to{};
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      from[k] = std::max(0, static_cast<int>(std::ceil((box.min()[i] - band - origin_[i]) / cell_m_)));
      to[k] = std::min(size_[k] - 1, static_cast<int>(std::floor((box.max()[i] + band - origin_[i]) / cell_m_)));
    }
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        const Vec3 row = origin_ + cell_m_ * Vec3(0, y, z) - mesh.vertices[t[0]];
        const double height = across.dot(row);
        for (int x = from[0]; x <= to[0]; ++x) {
          if (std::abs(height + across.x() * cell_m_ * x) <= band) near[index(x, y, z)] = 1;
        }
      }
    }
  }
  return near;
}

void DistanceGrid::measure_near(const MeshQuery& query, const std::vector<std::uint8_t>& near,
                                std::vector<Vec3f>& closest) {
  const std::size_t slice = index(0, 0, 1);
  for_each_index(static_cast<std::size_t>(size_[2]), [&](std::size_t z) {
    SurfacePoint found;
    for (std::size_t node = z * slice; node < (z + 1) * slice; ++node) {
      if (near[node] == 0) continue;
      found = query.closest(position(node), found);
      distance_m_[node] = static_cast<float>(found.distance_m);
      closest[node] = found.p.cast<float>();
    }
  });
}

void DistanceGrid::take_over(std::size_t node, std::size_t neighbour, std::vector<Vec3f>& closest) {
  if (!std::isfinite(distance_m_[neighbour]) || distance_m_[node] < distance_m_[neighbour] - 2 * cell_m_) return;
  const float there = (closest[neighbour] - position(node).cast<float>()).norm();
  if (there >= distance_m_[node]) return;
  distance_m_[node] = there;
  closest[node] = closest[neighbour];
}

void DistanceGrid::spread(std::vector<Vec3f>& closest) {
  // Eight sweeps, one from each corner; each node looks back at its three neighbours.
  for (int sweep = 0; sweep < 8; ++sweep) {
    std::array<int, 3> step{};
    std::array<int, 3> first{};
    for (std::size_t i = 0; i < 3; ++i) {
      step[i] = (sweep >> i & 1) != 0 ? -1 : 1;
      first[i] = step[i] > 0 ? 0 : size_[i] - 1;
    }
    for (int z = first[2]; z >= 0 && z < size_[2]; z += step[2]) {
      for (int y = first[1]; y >= 0 && y < size_[1]; y += step[1]) {
        for (int x = first[0]; x >= 0 && x < size_[0]; x += step[0]) {
          const std::size_t node = index(x, y, z);
          if (x != first[0]) take_over(node, index(x - step[0], y, z), closest);
          if (y != first[1]) take_over(node, index(x, y - step[1], z), closest);
          if (z != first[2]) take_over(node, index(x, y, z - step[2]), closest);
        }
      }
    }
  }
}

void DistanceGrid::set_signs(const MeshQuery& query) {
  // Votes: each of the lines along x, y and z through a node counts the closed pieces that it is in. Each axis has an array of its own.
  std::array<std::vector<std::int8_t>, 3> winding;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    winding[axis].resize(distance_m_.size());
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for_each_index(static_cast<std::size_t>(size_[v]), [&](std::size_t j) {
      std::vector<RayHit> hits;
      for (int i = 0; i < size_[u]; ++i) {
        std::array<int, 3> at{};
        at[u] = i;
        at[v] = static_cast<int>(j);
        query.cast(position(index(at[0], at[1], at[2])), Vec3::Unit(static_cast<Eigen::Index>(axis)), hits);
        int inside = 0;
        std::size_t next = 0;
        for (int k = 0; k < size_[axis]; ++k) {
          for (; next < hits.size() && hits[next].t <= k * cell_m_; ++next)
            inside += hits[next].entering ? 1 : -1;
          at[axis] = k;
          winding[axis][index(at[0], at[1], at[2])] = static_cast<std::int8_t>(std::clamp(inside, -100, 100));
        }
      }
    });
  }
  for (std::size_t node = 0; node < distance_m_.size(); ++node) {
    const std::int8_t x = winding[0][node];
    const std::int8_t y = winding[1][node];
    const std::int8_t middle = std::clamp(winding[2][node], std::min(x, y), std::max(x, y));
    if (middle > 0) distance_m_[node] = -distance_m_[node];
    overlaps_ = overlaps_ || middle > 1;
  }
}

double DistanceGrid::at(const Vec3& p) const {
  return at_cells(to_cells(p));
}

double DistanceGrid::inside_share(std::size_t node) const {
  return std::clamp(0.5 - distance_m_[node] / cell_m_, 0.0, 1.0);
}

std::size_t DistanceGrid::nearest(const Vec3& p) const {
  std::array<int, 3> i{};
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    i[a] = std::clamp(static_cast<int>(std::lround((p[k] - origin_[k]) / cell_m_)), 0, size_[a] - 1);
  }
  return index(i[0], i[1], i[2]);
}

}  // namespace mechane::geometry
