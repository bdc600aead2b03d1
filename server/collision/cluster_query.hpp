// From two objects down to the samples that lie inside: spheres of objects and parts, spheres of clusters, then 16 samples at a time.
// Inside this room only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "server/collision/kernels.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

// Parts near the other object that are tested together. More than these are taken in batches, and a sample that lies in parts of two
// batches then counts twice.
inline constexpr std::size_t kPartBatch = 64;

/// A part of the target, with the way from the samples' frame S to the part's own.
struct NearPart {
  BlockTransform X_QS;
  BoxView box_Q;
  const Part* part;
  std::uint16_t index;
  bool is_radial;
  RadialView radial;
  BrickView brick;
};

/// A sample inside the target.
struct InsideSample {
  std::uint32_t cluster = 0;
  std::uint32_t lane = 0;
  const NearPart* part = nullptr;
  Vec3f p_Q, n_Q;
  float depth_m = 0;
};

[[nodiscard]] inline bool overlap(const geometry::Sphere& a, const Vec3& center_b, double radius_b) noexcept {
  const double reach = a.radius + radius_b;
  return (a.center - center_b).squaredNorm() <= reach * reach;
}

/// Whether a sphere reaches the box: the tight cull for parts that are long and thin.
[[nodiscard]] inline bool reaches_box(const BoxView& box, const Vec3f& center_Q, float radius) noexcept {
  float square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const float outside =
        std::max(std::abs(center_Q[static_cast<Eigen::Index>(i)] - box.center[i]) - box.half[i], 0.0F);
    square += outside * outside;
  }
  return square <= radius * radius;
}

/// Tests the samples of `source` against `target` and gives each one that is inside to `sink(const InsideSample&)`, once.
template <class Sink>
class ClusterQuery {
 public:
  ClusterQuery(const Object& source, const Pose& X_TS, const Object& target, const Kernels& kernels, Sink sink)
      : source_(source), X_TS_(X_TS), target_(target), kernels_(kernels), sink_(sink) {}

  void run() noexcept {
    const Vec3 target_center_S = X_TS_.inverse() * target_.bound_O.center;
    for (std::size_t next = 0; next < target_.parts.size();) {
      count_ = collect(next);
      if (count_ == 0) continue;
      for (std::size_t s = 0; s < source_.parts.size(); ++s) {
        const Part& part = source_.parts[s];
        if (!overlap(part.bound_O, target_center_S, target_.bound_O.radius)) continue;
        const Vec3f target_center_Q = (part.X_OQ.inverse() * target_center_S).template cast<float>();
        if (part.map.empty() || reaches_box(part.map.box(), target_center_Q, static_cast<float>(target_.bound_O.radius)))
          test_part(s);
      }
    }
  }

 private:
  using Bits = std::uint64_t;
  static_assert(kPartBatch == 64);

  /// Fills `near_` with the parts of the target, from `next` on, that the source's sphere reaches.
  std::size_t collect(std::size_t& next) noexcept {
    std::size_t count = 0;
    const Vec3 center_T = X_TS_ * source_.bound_O.center;
    for (; next < target_.parts.size() && count < near_.size(); ++next) {
      const Part& part = target_.parts[next];
      if (part.map.empty() || !overlap(part.bound_O, center_T, source_.bound_O.radius)) continue;
      const Pose X_QS = part.X_OQ.inverse() * X_TS_;
      NearPart& near = near_[count];
      near.box_Q = part.map.box();
      const Vec3f center_Q = (X_QS * source_.bound_O.center).template cast<float>();
      if (!reaches_box(near.box_Q, center_Q, static_cast<float>(source_.bound_O.radius))) continue;
      describe(part, X_QS, near);
      near.index = static_cast<std::uint16_t>(next);
      ++count;
    }
    return count;
  }

  static void describe(const Part& part, const Pose& X_QS, NearPart& near) noexcept {
    const Mat3 R = X_QS.R.toRotationMatrix();
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        near.X_QS.R_BA[3 * row + column] =
            static_cast<float>(R(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
      }
      near.X_QS.p_BA[row] = static_cast<float>(X_QS.p[static_cast<Eigen::Index>(row)]);
    }
    near.part = &part;
    const RadialMap* radial = part.map.radial();
    near.is_radial = radial != nullptr;
    if (near.is_radial) {
      near.radial = radial->view();
    } else {
      near.brick = part.map.brick()->view();
    }
  }

  void test_part(std::size_t s) noexcept {
    for (std::uint32_t g = source_.first_group[s]; g < source_.first_group[s + 1]; ++g) {
      const ClusterGroup& group = source_.groups[g];
      std::array<Bits, kLanes> near_of{};
      LaneMask any = 0;
      for (std::size_t c = 0; c < count_; ++c) {
        LaneMask lanes = kernels_.spheres_near_box(group.bounds_O, near_[c].X_QS, near_[c].box_Q);
        lanes &= (LaneMask{1} << group.count) - 1;
        any |= lanes;
        for (; lanes != 0; lanes &= lanes - 1)
          near_of[static_cast<std::size_t>(std::countr_zero(lanes))] |= Bits{1} << c;
      }
      for (; any != 0; any &= any - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(any));
        test_cluster(group.first_cluster + lane, near_of[lane]);
      }
    }
  }

  /// A sample inside several parts counts once, in the part in which it lies most centrally: parts overlap at their seams, and a map
  /// is at its best around its middle. Where that part knows no surface, the next one is asked.
  void test_cluster(std::uint32_t index, Bits near) noexcept {
    const Cluster& cluster = source_.clusters[index];
    const LaneMask used = (LaneMask{1} << cluster.count) - 1;
    LaneMask pending = 0;
    Bits hit = 0;
    for (; near != 0; near &= near - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(near));
      const NearPart& part = near_[c];
      inside_of_[c] =
          used & (part.is_radial
                      ? kernels_.radial_inside(part.radial, part.X_QS, cluster.samples_O, inside_[c])
                      : kernels_.brick_inside(part.brick, part.X_QS, cluster.samples_O, inside_[c]));
      if (inside_of_[c] != 0) hit |= Bits{1} << c;
      pending |= inside_of_[c];
    }
    while (pending != 0)
      pending = settle(index, hit, pending);
  }

  /// Lets each pending sample ask its most central part; returns those that have to ask another.
  LaneMask settle(std::uint32_t index, Bits hit, LaneMask pending) noexcept {
    std::array<LaneMask, kPartBatch> asks{};
    if (std::has_single_bit(hit)) {
      asks[static_cast<std::size_t>(std::countr_zero(hit))] = pending;
    } else {
      for (LaneMask lanes = pending; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
        asks[most_central(hit, lane)] |= LaneMask{1} << lane;
      }
    }
    LaneMask again = 0;
    for (Bits parts = hit; parts != 0; parts &= parts - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(parts));
      if (asks[c] == 0) continue;
      DepthBlock depth;
      if (near_[c].is_radial) {
        kernels_.radial_depth(near_[c].radial, inside_[c].p_Q, asks[c], depth);
      } else {
        kernels_.brick_depth(near_[c].brick, inside_[c].p_Q, asks[c], depth);
      }
      again |= give(index, c, asks[c], depth);
    }
    for (LaneMask lanes = again; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      if (most_central(hit, lane) == kPartBatch) again &= ~(LaneMask{1} << lane);
    }
    return again;
  }

  [[nodiscard]] std::size_t most_central(Bits hit, std::size_t lane) const noexcept {
    std::size_t best = kPartBatch;
    float least = std::numeric_limits<float>::infinity();
    for (; hit != 0; hit &= hit - 1) {
      const auto c = static_cast<std::size_t>(std::countr_zero(hit));
      if ((inside_of_[c] >> lane & 1U) == 0 || inside_[c].m[lane] >= least) continue;
      least = inside_[c].m[lane];
      best = c;
    }
    return best;
  }

  /// Hands over the lanes that have a depth; the others leave this part, and are returned.
  LaneMask give(std::uint32_t index, std::size_t c, LaneMask lanes, const DepthBlock& depth) noexcept {
    LaneMask without = 0;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      if (!(depth.depth_m[lane] > 0)) {
        without |= LaneMask{1} << lane;
        continue;
      }
      const PointBlock& p = inside_[c].p_Q;
      sink_(InsideSample{index,
                         static_cast<std::uint32_t>(lane),
                         &near_[c],
                         {p.x[lane], p.y[lane], p.z[lane]},
                         {depth.n_Q.x[lane], depth.n_Q.y[lane], depth.n_Q.z[lane]},
                         depth.depth_m[lane]});
    }
    inside_of_[c] &= ~without;
    return without;
  }

  const Object& source_;
  const Pose& X_TS_;
  const Object& target_;
  const Kernels& kernels_;
  Sink sink_;
  std::size_t count_ = 0;
  // By near part. Only what the tests above have written is read.
  std::array<NearPart, kPartBatch> near_;
  std::array<LaneMask, kPartBatch> inside_of_;
  std::array<InsideBlock, kPartBatch> inside_;
};

}  // namespace mechane::collision
