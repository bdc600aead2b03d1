// The light of the procedural sky, made once for a sun: the irradiance as nine spherical harmonics (Ramamoorthi &
// Hanrahan 2001), the mirrored sky as a cube map.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "server/base/error.hpp"

namespace mechane::draw {

/// Coefficients of the irradiance, including the basis constants, in the order of lighting.glsl.
using SkyHarmonics = std::array<Vec3f, 9>;

/// From a map by longitude (columns, -z in the middle, +x to the right) and polar angle (rows, from the zenith down).
[[nodiscard]] SkyHarmonics project_sky(std::span<const Vec3f> map, picture::PixelSize size);

/// Direction of a pixel's centre in such a map, unit, in W.
[[nodiscard]] Vec3f sky_map_direction(std::uint32_t column, std::uint32_t row, picture::PixelSize size);

/// The irradiance on a surface with unit normal n_W, as lighting.glsl computes it.
[[nodiscard]] Vec3f irradiance(const SkyHarmonics& sh, const Vec3f& n_W);

enum class Clouds : std::uint8_t { drawn, none };

/// The sky of sky.glsl as such a map, with the clouds of the picture's background. Needs a current context.
[[nodiscard]] Expected<std::vector<Vec3f>> draw_sky_map(const picture::Sun& sun, picture::PixelSize size,
                                                        Clouds clouds);

struct SkyLight {
  SkyHarmonics harmonics{};
  TextureName cube;  ///< without clouds, see sky_cube.hpp
};

/// Needs a current context.
[[nodiscard]] Expected<SkyLight> bake_sky(const picture::Sun& sun);

}  // namespace mechane::draw
