// Surface samples as an Object wants them: in compact clusters of up to 16, each with its sphere.
#pragma once

#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

/// A sphere around all points, close to the smallest (Ritter 1990, then enlarged by the rounding errors). Radius 0 for no points.
[[nodiscard]] geometry::Sphere bounding_sphere(std::span<const Vec3> points);

/// Around each four of 16 points; grown for the rounding of the centres to float32.
[[nodiscard]] QuadSpheres quad_spheres(const PointBlock& points);

/// Appends the samples of one part, in clusters. The parts come in order.
void append_samples(Object& object, std::uint16_t part, std::vector<Vec3> points_O);

/// Makes the groups, and the object's own sphere. To be called after the last sample, and after a change of any.
void close_clusters(Object& object);

/// How many surface samples the object has.
[[nodiscard]] std::size_t sample_count(const Object& object);

/// Calls body(cluster, lane) for each sample, in their order.
template <class Body>
void for_each_sample(const Object& object, const Body& body) {
  for (const Cluster& cluster : object.clusters) {
    for (std::size_t lane = 0; lane < cluster.count; ++lane)
      body(cluster, lane);
  }
}

}  // namespace mechane::collision
