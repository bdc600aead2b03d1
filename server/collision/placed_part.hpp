// A part, ready for a query: its map, and the transform from the points' frame to the part's own.
#pragma once

#include <cstdint>

#include "server/base/math.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

/// Points into the object that it was made from. Without defaults: queries keep 64 of them on the stack.
struct PlacedPart {
  BlockTransform X_QS;  ///< from the points' frame S
  RadialView radial;
  BrickView brick;
  FieldView field;
  BlockTransform X_BS;  ///< to a field's blocks
  const Part* part;
  std::uint16_t index;  ///< of the part in its object
  enum class Kind : std::uint8_t { radial, brick, field } kind;

  /// The part's map must not be empty.
  void place(const Part& source, std::uint16_t source_index, const Pose& X_QS_exact) noexcept;

  [[nodiscard]] LaneMask near(const Kernels& k, const SpheresView& spheres, std::size_t count) const noexcept {
    if (kind == Kind::field) return k.field_near(field, X_BS, spheres, count);
    return kind == Kind::radial ? k.radial_near(radial, X_QS, spheres, count)
                                : k.brick_near(brick, X_QS, spheres, count);
  }
  [[nodiscard]] LaneMask inside(const Kernels& k, const PointsView& points, InsideBlock& out) const noexcept {
    if (kind == Kind::field) return k.field_inside(field, X_QS, points, out);
    return kind == Kind::radial ? k.radial_inside(radial, X_QS, points, out) : k.brick_inside(brick, X_QS, points, out);
  }
  void depth(const Kernels& k, const PointBlock& p_Q, LaneMask wanted, DepthBlock& out) const noexcept {
    if (kind == Kind::field) {
      k.field_depth(field, p_Q, wanted, out);
    } else if (kind == Kind::radial) {
      k.radial_depth(radial, p_Q, wanted, out);
    } else {
      k.brick_depth(brick, p_Q, wanted, out);
    }
  }
};

}  // namespace mechane::collision
