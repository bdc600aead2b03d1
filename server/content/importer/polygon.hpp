// A flat polygon as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"

namespace mechane::content {

/// Twice the polygon's area, along its normal: its corners run counter-clockwise about it.
[[nodiscard]] Vec3 area_vector(std::span<const Vec3> ring);

/// Triangles over the corners of one polygon, in its own sense of turning, by cutting off ears. It may be concave; where it crosses itself,
/// the triangles do so too. A polygon without area gives none.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3> ring);

}  // namespace mechane::content
