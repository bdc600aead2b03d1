// Points on the surface of a mesh: many by area, or few by spacing. Deterministic: same mesh and seed, same points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

struct SurfaceSample {
  Vec3 p = Vec3::Zero();
  std::uint32_t triangle = 0;
};

[[nodiscard]] double surface_area_m2(const Mesh& mesh);

/// `count` points with the same density everywhere (stratified along the running area). Empty for a mesh without area.
[[nodiscard]] std::vector<SurfaceSample> sample_by_area(const Mesh& mesh, std::size_t count, std::uint64_t seed);

/// Points such that no two lie closer than 0.7 spacings and every place of the surface has one within a spacing (nearly: the
/// candidates are random, 20 for each square of side `spacing_m`). Vertices come first, so that corners have their point. With
/// `accept`, only the part of the surface where it holds.
[[nodiscard]] std::vector<SurfaceSample> sample_by_spacing(
    const Mesh& mesh, double spacing_m, std::uint64_t seed,
    const std::function<bool(const SurfaceSample&)>& accept = {});

}  // namespace mechane::geometry
