// The surface of a whole object in blocks, a few bytes each: a plane that the distance never goes below, and a function that fits it. See
// deploy/decisions/037-fields.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/distance_brick.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/map_hit.hpp"
#include "server/collision/sheet_fit.hpp"

namespace mechane::collision {

/// Signed distances (negative inside) to a surface in the part's frame Q. The box is divided into blocks. A block has a plane, which says
/// from how far on a sphere needs no closer look, and a word: nothing (no point of it is inside), a leaf, or eight children (x fastest),
/// which have words of their own. A leaf may span several blocks: a cube of 2^span along each edge, one of those into which the grid is
/// divided from its lowest corner on. Each of them has its word. All lengths here are in edges of a block.
class DistanceField {
 public:
  using Grid = DistanceBrick::Grid;
  /// Sixteen bytes. The first of a leaf: eight corners, x fastest; a bubble for each axis; flags; scale and base, each the upper half of a
  /// float32. The second, where there are sheets: the corners of the second and the third.
  using Slot = std::array<std::uint8_t, 16>;
  static constexpr int kChildren = 8;
  static constexpr int kMaxSpan = 3;
  static constexpr std::size_t kMaxSlots = 4U << 20;

  /// value_step v + slope_step slope . (place in the block - its middle): never more than the distance of a place outside, and at most 0
  /// inside.
  struct Plane {
    int value = 0;                  ///< in kFieldValueStep, of kMaxValue at most
    std::array<int, 3> slope = {};  ///< in kFieldSlopeStep, of kMaxSlope at most
    [[nodiscard]] std::uint32_t packed() const;
    [[nodiscard]] static Plane unpacked(std::uint32_t word);
    [[nodiscard]] double at(const Vec3& p_B) const;
  };
  static constexpr int kMaxValue = 1023;
  static constexpr int kMaxSlope = 63;

  /// What a leaf says at a place, 0 to 1 along each of its edges: trilinear between corners, and a bubble q f (1 - f) along each axis. Or
  /// two or three sheets without bubbles.
  struct Leaf {
    Slot first{};
    Slot second{};
    bool has_sheets = false;

    /// Rounds: corners to a 127th of the largest difference from their mean.
    [[nodiscard]] static Leaf smooth(const std::array<double, 8>& corners, const Vec3& bubbles);
    [[nodiscard]] static Leaf of_sheets(const Sheets& sheets);  // in edges of a block, not metres
    [[nodiscard]] double at(const Vec3& p_L) const;
  };

  /// What is stored.
  struct Data {
    Grid grid;
    float slack_m = 0;                    ///< a place that is told to be inside lies outside by at most this
    std::vector<std::uint64_t> entries;   ///< of each block, x fastest: its plane, and its word << 32
    std::vector<std::uint32_t> children;  ///< words, eight together
    std::vector<Slot> slots;              ///< the first is not used
  };

  /// Asserts on sizes and words: use is_valid first.
  explicit DistanceField(Data data);
  [[nodiscard]] static bool is_valid(const Data& data);

  [[nodiscard]] static std::uint32_t leaf_word(std::size_t slot, int span = 0) {
    return static_cast<std::uint32_t>(slot << 1) | static_cast<std::uint32_t>(span) << kFieldSpanAt;
  }
  [[nodiscard]] static std::uint32_t split_word(std::size_t child) {
    return static_cast<std::uint32_t>(child << 1 | 1);
  }

  /// Depth, normal and surface point; no hit outside the box and outside the surface. Any thread; not for the loop, which asks 16 points
  /// at a time.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;

  [[nodiscard]] const Grid& grid() const { return data_.grid; }
  [[nodiscard]] const Data& data() const { return data_; }
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] FieldView view() const noexcept;
  [[nodiscard]] BoxView box() const noexcept;

 private:
  Data data_;
};

}  // namespace mechane::collision
