// The mirror image of the sky for each roughness: a small cube map whose levels are blurred for one roughness each.
// Made once for a sun.
#pragma once

#include <cstdint>
#include <vector>

#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "server/base/error.hpp"

namespace mechane::draw {

inline constexpr std::uint32_t kSkyFace = 64;  ///< texels along an edge of level 0
/// Level k is for roughness k / (kSkyLevels - 1); the same number is in lighting.glsl.
inline constexpr int kSkyLevels = 5;

/// The sky of sky.glsl, and the earth below its horizon, with all mip levels. Like all functions here, needs a current
/// context.
[[nodiscard]] Expected<TextureName> draw_sky_cube(const picture::Sun& sun);

/// From a cube map of size kSkyFace with all mip levels to one with a level for each roughness.
[[nodiscard]] Expected<TextureName> prefilter_sky(const TextureName& sharp);

/// The texels of a level: six faces in OpenGL's order, each row by row.
[[nodiscard]] std::vector<Vec3f> read_cube(const TextureName& cube, int level);

/// Direction of a texel's centre in such a face, unit, in W.
[[nodiscard]] Vec3f cube_direction(std::uint32_t face, std::uint32_t column, std::uint32_t row, std::uint32_t size);

}  // namespace mechane::draw
