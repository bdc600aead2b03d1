// Signed distance to a whole mesh on a regular grid: the search for cuts asks it millions of times, instead of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::geometry {

/// Nodes next to the surface have the exact distance, the others that to the closest surface point of their neighbours (Danielsson
/// 1980: never less than the exact one, and off by a fraction of a cell). Inside is a winding number above 0 on at least two of the
/// three grid lines through the node. Immutable; any thread.
class DistanceGrid {
 public:
  /// `cells` along the longest edge of the mesh's box, at least 4. The mesh must be finite and have some extent; `query` must be of
  /// the same mesh.
  DistanceGrid(const Mesh& mesh, const MeshQuery& query, int cells);

  /// Distance in metres, negative inside, linear between nodes. Points outside the grid count as on its border.
  [[nodiscard]] double at(const Vec3& p) const;

  /// The same for coordinates in cells from the first node. They must lie in the grid: nothing is checked.
  [[nodiscard]] float at_cells(const Vec3f& c) const {
    const auto x = static_cast<std::uint32_t>(c.x());
    const auto y = static_cast<std::uint32_t>(c.y());
    const auto z = static_cast<std::uint32_t>(c.z());
    const float fx = c.x() - static_cast<float>(x);
    const float fy = c.y() - static_cast<float>(y);
    const float fz = c.z() - static_cast<float>(z);
    const std::size_t dy = static_cast<std::size_t>(size_[0]);
    const std::size_t dz = dy * static_cast<std::size_t>(size_[1]);
    const float* d = distance_m_.data() + z * dz + y * dy + x;
    const float y0z0 = d[0] + fx * (d[1] - d[0]);
    const float y1z0 = d[dy] + fx * (d[dy + 1] - d[dy]);
    const float y0z1 = d[dz] + fx * (d[dz + 1] - d[dz]);
    const float y1z1 = d[dy + dz] + fx * (d[dy + dz + 1] - d[dy + dz]);
    const float z0 = y0z0 + fy * (y1z0 - y0z0);
    const float z1 = y0z1 + fy * (y1z1 - y0z1);
    return z0 + fz * (z1 - z0);
  }
  [[nodiscard]] Vec3f to_cells(const Vec3& p) const {
    Vec3f c = ((p - origin_) / cell_m_).cast<float>();
    for (int i = 0; i < 3; ++i)
      c[i] = std::clamp(c[i], 0.0F, static_cast<float>(size_[static_cast<std::size_t>(i)]) - 1.001F);
    return c;
  }

  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] std::size_t nodes() const { return distance_m_.size(); }
  [[nodiscard]] const std::array<int, 3>& size() const { return size_; }
  [[nodiscard]] Vec3 position(std::size_t node) const;
  [[nodiscard]] double distance_m(std::size_t node) const { return distance_m_[node]; }
  /// How much of the cube about a node is inside, 0 to 1, as if the surface were a plane there.
  [[nodiscard]] double inside_share(std::size_t node) const;
  /// The node closest to p.
  [[nodiscard]] std::size_t nearest(const Vec3& p) const;
  /// Whether closed pieces of the mesh overlap somewhere: then some of its surface lies inside the solid.
  [[nodiscard]] bool overlaps() const { return overlaps_; }

 private:
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::vector<std::uint8_t> mark_near(const Mesh& mesh) const;
  void measure_near(const MeshQuery& query, const std::vector<std::uint8_t>& near, std::vector<Vec3f>& closest);
  void spread(std::vector<Vec3f>& closest);
  void take_over(std::size_t node, std::size_t neighbour, std::vector<Vec3f>& closest);
  void set_signs(const MeshQuery& query);

  Vec3 origin_ = Vec3::Zero();
  double cell_m_ = 1;
  std::array<int, 3> size_{};
  std::vector<float> distance_m_;
  bool overlaps_ = false;
};

}  // namespace mechane::geometry
