#include "server/collision/distance_brick.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"
#include "server/collision/evaluate_one.hpp"

namespace mechane::collision {

bool DistanceBrick::is_valid(const Grid& grid, float step_m, std::size_t values) {
  std::size_t wanted = 1;
  for (const int n : grid.nodes) {
    if (n < 2 || n > kMaxNodes) return false;
    wanted *= static_cast<std::size_t>(n);
  }
  if (values != wanted || wanted > kMaxValues) return false;
  if (!grid.origin_Q.allFinite() || grid.origin_Q.cwiseAbs().maxCoeff() > 1e4F) return false;
  return std::isfinite(grid.cell_m) && grid.cell_m >= 1e-6F && grid.cell_m <= 1e4F && std::isfinite(step_m) &&
         step_m > 0 && step_m <= 1.0F;
}

DistanceBrick::DistanceBrick(const Grid& grid, float step_m, std::vector<std::int16_t> values)
    : grid_(grid), step_m_(step_m), values_(std::move(values)) {
  MECHANE_ASSERT(is_valid(grid_, step_m_, values_.size()));
  steepest_ = steepest_outside();
}

DistanceBrick DistanceBrick::from_distances(const Grid& grid, float band_m, std::span<const float> distances_m) {
  const float step = band_m / 32767.0F;
  std::vector<std::int16_t> values(distances_m.size());
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    values[i] = static_cast<std::int16_t>(std::lround(std::clamp(distances_m[i] / step, -32767.0F, 32767.0F)));
  }
  return {grid, step, std::move(values)};
}

/// The largest slope of the interpolated distance in the cells that are not inside as a whole. Each part of the gradient is bilinear in
/// the cell, so its length is convex along every edge and largest in a corner.
float DistanceBrick::steepest_outside() const {
  const auto& n = grid_.nodes;
  const auto value = [&](int x, int y, int z) {
    const int index = (z * n[1] + y) * n[0] + x;
    return static_cast<float>(values_[static_cast<std::size_t>(index)]);
  };
  float square = 0;
  for (int z = 0; z + 1 < n[2]; ++z) {
    for (int y = 0; y + 1 < n[1]; ++y) {
      for (int x = 0; x + 1 < n[0]; ++x) {
        float highest = -1;
        float steepest = 0;
        for (int corner = 0; corner < 8; ++corner) {
          const int cx = x + corner % 2;
          const int cy = y + corner / 2 % 2;
          const int cz = z + corner / 4;
          const Vec3f slope(value(x + 1, cy, cz) - value(x, cy, cz), value(cx, y + 1, cz) - value(cx, y, cz),
                            value(cx, cy, z + 1) - value(cx, cy, z));
          steepest = std::max(steepest, slope.squaredNorm());
          highest = std::max(highest, value(cx, cy, cz));
        }
        if (highest >= 0) square = std::max(square, steepest);
      }
    }
  }
  constexpr float kRounding = 1.001F;
  return std::max(1e-3F, kRounding * std::sqrt(square) * step_m_ / grid_.cell_m);
}

BrickView DistanceBrick::view() const noexcept {
  return {values_.data(),   grid_.nodes, {grid_.origin_Q.x(), grid_.origin_Q.y(), grid_.origin_Q.z()},
          1 / grid_.cell_m, step_m_,     steepest_};
}

BoxView DistanceBrick::box() const noexcept {
  BoxView box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.half[i] = 0.5F * grid_.cell_m * static_cast<float>(grid_.nodes[i] - 1);
    box.center[i] = grid_.origin_Q[static_cast<Eigen::Index>(i)] + box.half[i];
  }
  return box;
}

MapHit DistanceBrick::evaluate(const Vec3f& p_QP) const noexcept {
  return evaluate_one(p_QP, view(), portable().brick_inside, portable().brick_depth);
}

}  // namespace mechane::collision
