// The culling that every scalar method gets: the hand's sphere, the segments' spheres, the clusters' spheres, each against the object's
// sphere and its box. The kernels of brick.cpp do the same eight at a time.
#pragma once

#include <cmath>

#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {

/// Whether a sphere of that radius around p_O reaches the object's sphere and box.
[[nodiscard]] inline bool reaches(const SceneObject& object, const Vec3f& p_O, float radius) noexcept {
  const Vec3f from = p_O - object.bound_O.center.cast<float>();
  const float sum = radius + static_cast<float>(object.bound_O.radius);
  return from.squaredNorm() <= sum * sum && object.box_O.squaredExteriorDistance(p_O) <= radius * radius;
}

/// Calls visit(cluster, p_O of the cluster's centre, its radius) for each cluster that may touch the object.
template <class Visit>
void visit_near_clusters(const HandStep& hand, const SceneObject& object, Visit&& visit) {
  if (!reaches(object, object.R_OW * hand.center + object.p_OW, hand.radius)) return;
  for (std::size_t s = 0; s < kSegments; ++s) {
    const Vec3f p_W(hand.segment_x[s], hand.segment_y[s], hand.segment_z[s]);
    if (!reaches(object, object.R_OW * p_W + object.p_OW, hand.segment_r[s])) continue;
    for (std::size_t c = s * kSegmentClusters; c < (s + 1) * kSegmentClusters; ++c) {
      const Vec3f c_W(hand.cluster_x[c], hand.cluster_y[c], hand.cluster_z[c]);
      const Vec3f c_O = object.R_OW * c_W + object.p_OW;
      if (reaches(object, c_O, hand.cluster_r[c])) visit(c, c_O, hand.cluster_r[c]);
    }
  }
}

/// The point in the object's frame.
[[nodiscard]] inline Vec3f point_O(const HandStep& hand, const SceneObject& object, std::size_t point) noexcept {
  return object.R_OW * Vec3f(hand.x[point], hand.y[point], hand.z[point]) + object.p_OW;
}

}  // namespace mechane::benchmark
