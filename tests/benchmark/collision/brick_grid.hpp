// A dense grid of signed distances to one object, 16 bits a node, and the ways to read it: one point at a time, or eight with AVX2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/collision/near_list.hpp"
#include "tests/benchmark/collision/exact_grid.hpp"
#include "tests/benchmark/collision/method.hpp"

namespace mechane::benchmark {

struct BrickGrid {
  std::array<int, 3> nodes{};
  float cell_m = 0;
  float step_m = 0;  ///< of one unit of the 16-bit values
  Vec3f origin_O = Vec3f::Zero();
  std::vector<std::int16_t> values;  ///< x fastest; one more at the end, for reads of pairs
  Eigen::Matrix3f A_GW;              ///< a point of W in cells: A_GW p + b_GW
  Vec3f b_GW = Vec3f::Zero();
  Eigen::Matrix3f R_WO;

  [[nodiscard]] std::size_t bytes() const {
    return values.size() * sizeof(std::int16_t) + sizeof(*this) - sizeof(values);
  }
};

[[nodiscard]] BrickGrid make_brick_grid(const SceneObject& object, const SolidQuery& query, int cells);

/// Trilinear, metres, and its gradient in cells; positive outside the box.
struct BrickSample {
  float distance_m = 1;
  Vec3f gradient = Vec3f::Zero();
};
[[nodiscard]] BrickSample sample_brick(const BrickGrid& grid, const Vec3f& p_G) noexcept;

/// Whether a sphere around p_G may touch what is inside. The radius is in metres.
[[nodiscard]] bool brick_reaches(const BrickGrid& grid, const Vec3f& p_G, float radius_m) noexcept;

/// A grid of distances is not an exact distance between its nodes: by so much, in cells, a cluster's sphere is taken to be larger.
inline constexpr float kBrickSlack = 0.25F;

/// What our query remembers (collision::NearList), for a grid: so that the two differ in their maps alone.
class BrickList {
 public:
  [[nodiscard]] bool still_holds(const HandStep& hand) const noexcept;
  void remember(const HandStep& hand) noexcept;

  std::size_t count = 0;
  std::array<std::uint32_t, kQuads> quads;

 private:
  bool is_made_ = false;
  collision::GroupPlaces places_{};
};

/// The whole hand against one object.
void query_brick_scalar(const BrickGrid& grid, std::size_t object, const HandStep& hand, Hits& out) noexcept;
/// Only where brick_has_avx2().
void query_brick_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand, Hits& out) noexcept;
void query_brick_lists_avx2(const BrickGrid& grid, std::size_t object, const HandStep& hand, BrickList& list,
                            Hits& out) noexcept;
[[nodiscard]] bool brick_has_avx2() noexcept;

}  // namespace mechane::benchmark
