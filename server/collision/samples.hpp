// Surface samples as an Object wants them: in compact clusters of up to 16, each with its sphere.
#pragma once

#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

inline constexpr std::size_t kClusterSize = 16;

/// A sphere around all points, close to the smallest (Ritter 1990, then grown over what rounding left out). Radius 0 for no points.
[[nodiscard]] geometry::Sphere bounding_sphere(std::span<const Vec3> points);

/// Appends the samples of one part, in clusters; `object.first_cluster` gets the part's first cluster. Close it with close_clusters.
void append_samples(Object& object, std::uint16_t part, std::vector<Vec3> points_O);

/// After the last part: the closing entry of first_cluster, and the object's own sphere.
void close_clusters(Object& object);

}  // namespace mechane::collision
