// From points in clusters down to those that lie inside an object: spheres of groups, spheres of clusters, then 16 points at a time.
// Inside this room only.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "server/collision/kernels.hpp"
#include "server/collision/object.hpp"
#include "server/collision/placed_part.hpp"

namespace mechane::collision {

// Parts that are tested together. More are taken in batches, and a point in parts of two batches counts twice.
inline constexpr std::size_t kPartBatch = 64;

/// A point inside the target.
struct InsidePoint {
  std::uint32_t cluster = 0;
  std::uint32_t lane = 0;
  const PlacedPart* part = nullptr;
  Vec3f p_Q, n_Q;
  float depth_m = 0;
};

/// Tests points against up to kPartBatch parts, and gives each one that is inside to `sink(const InsidePoint&)`, once. `Points` has
/// points(cluster) -> PointsView and count(cluster), the used lanes. Feed it groups of clusters, then finish().
template <class Points, class Sink>
class ClusterQuery {
 public:
  ClusterQuery(const Points& points, std::span<const PlacedPart> parts, const Kernels& kernels, Sink sink)
      : points_(points), parts_(parts), kernels_(kernels), sink_(sink) {
    for (std::size_t c = 0; c < parts_.size(); ++c)
      waiting_[c].count = 0;
  }

  /// `near`: the parts to ask, a bit each. The clusters begin at first_cluster, with their spheres.
  void test_group(const SpheresView& spheres, std::size_t count, std::uint32_t first_cluster,
                  std::uint64_t near) noexcept {
    std::array<std::uint64_t, kLanes> near_of{};
    LaneMask any = 0;
    for (; near != 0; near &= near - 1) {
      const int c = std::countr_zero(near);
      LaneMask lanes = parts_[static_cast<std::size_t>(c)].near(kernels_, spheres, count);
      any |= lanes;
      for (; lanes != 0; lanes &= lanes - 1)
        near_of[static_cast<std::size_t>(std::countr_zero(lanes))] |= std::uint64_t{1} << c;
    }
    for (; any != 0; any &= any - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(any));
      test_cluster(first_cluster + lane, near_of[lane]);
    }
  }

  /// Tests the points that are left over, which do not fill a vector.
  void finish() noexcept {
    for (std::size_t c = 0; c < parts_.size(); ++c)
      settle(c);
  }

 private:
  /// Points inside a part whose depth is not asked yet: asking 16 at a time takes no longer than asking one.
  struct Waiting {
    PointBlock p_Q;
    std::array<std::uint32_t, kLanes> cluster;
    std::array<std::uint8_t, kLanes> lane;
    std::array<std::uint64_t, kLanes> near;  // the other parts that could be asked
    std::size_t count;
  };

  /// A point inside several parts counts once, in the part in which it lies most centrally: parts overlap at their seams, and a map is
  /// at its best around its middle.
  void test_cluster(std::uint32_t cluster, std::uint64_t near) noexcept {
    const LaneMask used = (LaneMask{1} << points_.count(cluster)) - 1;
    const PointsView points = points_.points(cluster);
    if (std::has_single_bit(near)) {
      const auto c = static_cast<std::size_t>(std::countr_zero(near));
      InsideBlock inside;
      for (LaneMask lanes = used & parts_[c].inside(kernels_, points, inside); lanes != 0; lanes &= lanes - 1)
        wait(c, cluster, static_cast<std::size_t>(std::countr_zero(lanes)), inside, near);
      return;
    }
    LaneMask pending = 0;
    std::uint64_t hit = 0;
    for (std::uint64_t rest = near; rest != 0; rest &= rest - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(rest));
      inside_of_[c] = used & parts_[c].inside(kernels_, points, inside_[c]);
      if (inside_of_[c] != 0) hit |= std::uint64_t{1} << c;
      pending |= inside_of_[c];
    }
    for (; pending != 0; pending &= pending - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(pending));
      const std::size_t c = most_central(hit, lane);
      wait(c, cluster, lane, inside_[c], near);
    }
  }

  [[nodiscard]] std::size_t most_central(std::uint64_t hit, std::size_t lane) const noexcept {
    std::size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (; hit != 0; hit &= hit - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(hit));
      if ((inside_of_[c] >> lane & 1U) == 0 || inside_[c].m[lane] >= least) continue;
      least = inside_[c].m[lane];
      best = c;
    }
    return best;
  }

  void wait(std::size_t c, std::uint32_t cluster, std::size_t lane, const InsideBlock& inside,
            std::uint64_t near) noexcept {
    Waiting& waiting = waiting_[c];
    const std::size_t at = waiting.count++;
    waiting.p_Q.x[at] = inside.p_Q.x[lane];
    waiting.p_Q.y[at] = inside.p_Q.y[lane];
    waiting.p_Q.z[at] = inside.p_Q.z[lane];
    waiting.cluster[at] = cluster;
    waiting.lane[at] = static_cast<std::uint8_t>(lane);
    waiting.near[at] = near;
    if (waiting.count == kLanes) settle(c);
  }

  void settle(std::size_t c) noexcept {
    Waiting& waiting = waiting_[c];
    const std::size_t count = waiting.count;
    if (count == 0) return;
    for (std::size_t lane = count; lane < kLanes; ++lane) {  // the unused lanes must be numbers
      waiting.p_Q.x[lane] = waiting.p_Q.x[0];
      waiting.p_Q.y[lane] = waiting.p_Q.y[0];
      waiting.p_Q.z[lane] = waiting.p_Q.z[0];
    }
    DepthBlock depth;
    parts_[c].depth(kernels_, waiting.p_Q, (LaneMask{1} << count) - 1, depth);
    waiting.count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (depth.depth_m[i] > 0) {
        give(c, waiting.cluster[i], waiting.lane[i], waiting.p_Q, depth, i);
      } else {
        ask_others(c, waiting.cluster[i], waiting.lane[i], waiting.near[i]);
      }
    }
  }

  void give(std::size_t c, std::uint32_t cluster, std::uint32_t lane, const PointBlock& p_Q, const DepthBlock& depth,
            std::size_t at) noexcept {
    sink_(InsidePoint{cluster,
                      lane,
                      &parts_[c],
                      {p_Q.x[at], p_Q.y[at], p_Q.z[at]},
                      {depth.n_Q.x[at], depth.n_Q.y[at], depth.n_Q.z[at]},
                      depth.depth_m[at]});
  }

  /// For a point where the most central part knows no surface, deep in the solid of several parts. Rare, so one point at a time.
  void ask_others(std::size_t asked, std::uint32_t cluster, std::uint32_t lane, std::uint64_t near) noexcept {
    const PointsView points = points_.points(cluster);
    std::size_t best = asked;
    float least = std::numeric_limits<float>::infinity();
    InsideBlock best_inside;
    DepthBlock best_depth;
    for (near &= ~(std::uint64_t{1} << asked); near != 0; near &= near - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(near));
      InsideBlock inside;
      DepthBlock depth;
      if ((parts_[c].inside(kernels_, points, inside) >> lane & 1U) == 0 || inside.m[lane] >= least) continue;
      parts_[c].depth(kernels_, inside.p_Q, LaneMask{1} << lane, depth);
      if (!(depth.depth_m[lane] > 0)) continue;
      least = inside.m[lane];
      best = c;
      best_inside = inside;
      best_depth = depth;
    }
    if (best != asked) give(best, cluster, lane, best_inside.p_Q, best_depth, lane);
  }

  const Points& points_;
  std::span<const PlacedPart> parts_;
  const Kernels& kernels_;
  Sink sink_;
  // By part. Only lanes that the tests above have written are read.
  std::array<LaneMask, kPartBatch> inside_of_;
  std::array<InsideBlock, kPartBatch> inside_;
  std::array<Waiting, kPartBatch> waiting_;
};

}  // namespace mechane::collision
