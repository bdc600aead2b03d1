// Four boxes side by side, in float, to rule out what a query cannot meet. All errs towards keeping: rounding never rules out too much.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "server/base/math.hpp"

namespace mechane::geometry {

struct BoxQuad {
  std::array<Eigen::Array4f, 3> low, high;  // by axis

  void set(Eigen::Index lane, const Eigen::AlignedBox3d& box) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      low[static_cast<std::size_t>(axis)][lane] = static_cast<float>(box.min()[axis]);
      high[static_cast<std::size_t>(axis)][lane] = static_cast<float>(box.max()[axis]);
    }
  }
};

/// A place, as wide as rounding could move it and boxes whose coordinates are at most `reach`.
class QuadPlace {
 public:
  QuadPlace(const Vec3& p, double reach) {
    const double pad = kPad * (p.cwiseAbs().maxCoeff() + reach);
    low_ = (p.array() - pad).cast<float>();
    high_ = (p.array() + pad).cast<float>();
  }

  [[nodiscard]] Eigen::Array4f to_low(const BoxQuad& quad, std::size_t axis) const {
    return quad.low[axis] - high_[static_cast<Eigen::Index>(axis)];
  }
  [[nodiscard]] Eigen::Array4f to_high(const BoxQuad& quad, std::size_t axis) const {
    return quad.high[axis] - low_[static_cast<Eigen::Index>(axis)];
  }
  /// Squares of distances to the boxes: never too large by more than kSlack of themselves.
  [[nodiscard]] Eigen::Array4f squares(const BoxQuad& quad) const {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += to_low(quad, axis).max(-to_high(quad, axis)).max(0.0F).square();
    return sum;
  }

  static constexpr float kSlack = 1e-6F;

 private:
  static constexpr double kPad = 4e-7;  // of coordinates: three roundings of a float, and some room
  Eigen::Array3f low_, high_;
};

/// A ray from a place; its direction may have any length.
class QuadRay {
 public:
  QuadRay(const Vec3& origin, const Vec3& direction, double reach)
      : origin_(origin, reach), inverse_(direction.unaryExpr(&inverse_of).cast<float>()) {}

  /// Where it enters and leaves each box; it meets those that it does not enter behind where it leaves them.
  void spans(const BoxQuad& quad, Eigen::Array4f& enters, Eigen::Array4f& leaves) const {
    enters = Eigen::Array4f::Zero();
    leaves = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float inverse = inverse_[static_cast<Eigen::Index>(axis)];
      const Eigen::Array4f a = origin_.to_low(quad, axis) * inverse;
      const Eigen::Array4f b = origin_.to_high(quad, axis) * inverse;
      enters = enters.max(a.min(b));
      leaves = leaves.min(a.max(b));
    }
    leaves *= 1 + QuadPlace::kSlack;
  }

 private:
  static double inverse_of(double d) {
    constexpr double kLeast = 1e-25;  // its inverse is far from a float's limits, and the way along it from any mesh
    return 1 / (std::abs(d) < kLeast ? std::copysign(kLeast, d) : d);
  }
  QuadPlace origin_;
  Eigen::Array3f inverse_;
};

}  // namespace mechane::geometry
