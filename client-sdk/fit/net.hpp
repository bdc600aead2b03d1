// The superquadrics of an object for drawing: as surfaces of triangles, and as nets of lines on them.
#pragma once

#include <cstdint>
#include <vector>

#include "client-sdk/fit/raster.hpp"
#include "server/collision/object.hpp"

namespace mechane::fit {

struct Shells {
  geometry::Mesh mesh;  ///< in the object's frame
  std::vector<std::uint32_t> part_of_triangle;
};

[[nodiscard]] Shells make_shells(const collision::Object& object);

/// For each pixel, the part whose line is visible there (not hidden by glass or object), or DepthBuffer::kNothing.
[[nodiscard]] std::vector<std::uint32_t> draw_net(const collision::Object& object, const View& view,
                                                  const DepthBuffer& glass, const DepthBuffer& solid);

/// The point of the superquadric's surface, in Q, in the direction `d` of a cube [-1, 1]^3 that is scaled by the
/// semi-axes.
[[nodiscard]] Vec3 surface_at(const geometry::Superquadric& shape, const Vec3& d);

}  // namespace mechane::fit
