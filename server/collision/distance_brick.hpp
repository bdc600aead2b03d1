// The surface of one part as a small grid of signed distances: for parts that no centre sees whole. See ARCHITECTURE.md, 'Collision
// parts'.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/map_hit.hpp"

namespace mechane::collision {

/// Signed distances (negative inside) to the whole object's surface on the nodes of a grid in the part's frame Q, 16 bits each,
/// trilinear between them.
class DistanceBrick {
 public:
  static constexpr int kMaxNodes = 256;                ///< along an edge
  static constexpr std::size_t kMaxValues = 4U << 20;  ///< of one brick

  struct Grid {
    std::array<int, 3> nodes{};      ///< at least 2 along each edge
    Vec3f origin_Q = Vec3f::Zero();  ///< the first node
    float cell_m = 0;
  };

  /// `values` holds a value for each node, x fastest; distance = value * step_m. Asserts on sizes and signs: use is_valid first.
  DistanceBrick(const Grid& grid, float step_m, std::vector<std::int16_t> values);

  [[nodiscard]] static bool is_valid(const Grid& grid, float step_m, std::size_t values);

  /// Quantises exact distances; what is beyond `band_m` is cut off at it.
  [[nodiscard]] static DistanceBrick from_distances(const Grid& grid, float band_m, std::span<const float> distances_m);

  /// Depth, normal and surface point; no hit outside the grid and outside the surface. Any thread; not for the loop, which asks
  /// 16 points at a time.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] float step_m() const { return step_m_; }
  [[nodiscard]] std::span<const std::int16_t> values() const { return values_; }
  [[nodiscard]] BrickView view() const noexcept;
  [[nodiscard]] BoxView box() const noexcept;

 private:
  [[nodiscard]] float steepest_outside() const;

  Grid grid_;
  float step_m_ = 0;
  float steepest_ = 1;
  std::vector<std::int16_t> values_;
};

}  // namespace mechane::collision
