// The surface of one part, or of a whole object, as a sparse grid of signed distances: fine where the distance bends, coarse where it
// runs straight. See ARCHITECTURE.md, 'Collision parts'.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/map_hit.hpp"
#include "server/collision/sheet_fit.hpp"

namespace mechane::collision {

/// Signed distances (negative inside) to the whole object's surface in the part's frame Q, trilinear between nodes, 8 bits a node. The
/// box is divided into blocks. A block has 1, 2 or 4 cells along its edge (its level: 0, 1 or 2) and keeps its nodes together: a
/// two-level form of adaptively sampled distance fields (Frisken et al. 2000), in which blocks of different levels agree on their
/// common face, to half a step. Or it has one cell and two or three sheets, of which the largest or the least distance counts. So an edge
/// or a corner between smooth faces stays sharp, with a fraction of the bytes of fine cells.
class DistanceBrick {
 public:
  static constexpr int kMaxBlocks = 64;                ///< along an edge
  static constexpr int kFinest = 4;                    ///< cells along the edge of a block of the highest level
  static constexpr int kLevels = 3;                    ///< 0, 1, 2
  static constexpr int kSheets = 3;                    ///< instead of a level: one cell, sheets
  static constexpr std::size_t kMaxValues = 4U << 20;  ///< of one brick

  struct Grid {
    std::array<int, 3> blocks{};     ///< at least 1 along each edge
    Vec3f origin_Q = Vec3f::Zero();  ///< the lowest corner
    float block_m = 0;               ///< edge of a block

    [[nodiscard]] std::size_t block_count() const;
    [[nodiscard]] BoxView box() const noexcept;
  };

  /// Where a block's values lie, as kernels read it.
  struct Entry {
    int level = 0;              ///< or kSheets
    bool outer_convex = false;  ///< see Sheets; false for a level
    bool inner_convex = false;
    bool three = false;     ///< sheets, not two
    int base = 0;           ///< in kBaseSteps steps: added to each of the block's values
    std::size_t first = 0;  ///< of the values; a multiple of kAlign

    [[nodiscard]] std::uint32_t packed() const;
    [[nodiscard]] static Entry unpacked(std::uint32_t word);
    /// Cells along an edge.
    [[nodiscard]] int cells() const { return level == kSheets ? 1 : 1 << level; }
    [[nodiscard]] int sheets() const { return level != kSheets ? 1 : three ? 3 : 2; }
    /// Steps of its values: sheets lie wider apart than the nodes of one.
    [[nodiscard]] int unit() const { return level == kSheets ? 2 : 1; }
    /// Values of the block: its nodes, sheet after sheet.
    [[nodiscard]] std::size_t count() const;
  };
  static constexpr int kBaseSteps = 32;
  static constexpr int kMaxBase = 63;
  static constexpr std::size_t kAlign = 4;

  /// `index` holds a packed entry for each block, x fastest; `values` each block's nodes, x fastest: distance = (unit() value +
  /// kBaseSteps base) step_m. `slack_m`: outside the surface it exceeds the true
  /// distance by at most this. Asserts on sizes and signs: use is_valid first.
  DistanceBrick(const Grid& grid, float step_m, float slack_m, std::vector<std::uint32_t> index,
                std::span<const std::int8_t> values);

  [[nodiscard]] static bool is_valid(const Grid& grid);
  [[nodiscard]] static bool is_valid(const Grid& grid, float step_m, float slack_m,
                                     std::span<const std::uint32_t> index, std::size_t values);

  /// The exact distance, metres, at a node of the finest lattice: kFinest nodes to a block along each axis, 0 at origin_Q.
  using NodeDistance = std::function<float(const std::array<int, 3>& node)>;

  /// The sheets of blocks, by their number; each must fit.
  using BlockSheets = std::map<std::size_t, Sheets>;

  /// Quantises. `levels` holds one for each block, x fastest, kSheets for those in `sheets`; `distance` is asked at each other block's
  /// own nodes, some more than once; and at all nodes for the slack, where infinite means unknown.
  [[nodiscard]] static DistanceBrick from_distances(const Grid& grid, std::span<const std::uint8_t> levels,
                                                    const NodeDistance& distance, const BlockSheets& sheets = {});

  /// Whether the values of the sheets lie close enough together for a block of this size.
  [[nodiscard]] static bool fits(const Sheets& sheets, float block_m);

  /// Depth, normal and surface point; no hit outside the grid and outside the surface. Any thread; not for the loop, which asks
  /// 16 points at a time.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;

  /// The interpolated distance at a place, negative inside; for a place outside the grid, that of the nearest place of the grid.
  [[nodiscard]] float distance_m(const Vec3f& p_QP) const;

  /// A place of the finest lattice, in cells from the lowest corner, within the grid.
  [[nodiscard]] Vec3f lattice_place(const Vec3f& p_QP) const;

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] float step_m() const { return step_m_; }
  [[nodiscard]] float slack_m() const { return slack_m_; }
  [[nodiscard]] std::span<const std::uint32_t> index() const { return index_; }
  [[nodiscard]] std::span<const std::int8_t> values() const;
  [[nodiscard]] std::size_t bytes() const { return index_.size() * sizeof(std::uint32_t) + values().size(); }
  [[nodiscard]] BrickView view() const noexcept;
  [[nodiscard]] BoxView box() const noexcept;

 private:
  [[nodiscard]] float told(std::size_t block, const Vec3f& p_B) const;
  [[nodiscard]] float measured_slack(const NodeDistance& distance) const;

  Grid grid_;
  float step_m_ = 0;
  float slack_m_ = 0;
  std::vector<std::uint32_t> index_;
  std::vector<std::int8_t> values_;  // and a few more, for reads of four
};

}  // namespace mechane::collision
