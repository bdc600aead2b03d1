#include "client-sdk/draw/passes/sky_light.hpp"

#include <cmath>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/sky_cube.hpp"
#include "client-sdk/draw/render_target.hpp"
#include "client-sdk/draw/shader.hpp"
#include "server/base/assert.hpp"

namespace mechane::draw {
namespace {

/// The real spherical harmonics without their constants, in the shader's order.
std::array<float, 9> polynomials(const Vec3f& d) {
  return {1,
          d.y(),
          d.z(),
          d.x(),
          d.x() * d.y(),
          d.y() * d.z(),
          3 * d.z() * d.z() - 1,
          d.x() * d.z(),
          d.x() * d.x() - d.y() * d.y()};
}

constexpr std::array<float, 9> kConstants{0.282095F, 0.488603F, 0.488603F, 0.488603F, 1.092548F,
                                          1.092548F, 0.315392F, 1.092548F, 0.546274F};
/// The harmonics of the cosine lobe, by band.
constexpr std::array<float, 9> kCosine{kPiF,     2 * kPiF / 3, 2 * kPiF / 3, 2 * kPiF / 3, kPiF / 4,
                                       kPiF / 4, kPiF / 4,     kPiF / 4,     kPiF / 4};

}  // namespace

Vec3f sky_map_direction(std::uint32_t column, std::uint32_t row, picture::PixelSize size) {
  const float longitude = ((static_cast<float>(column) + 0.5F) / static_cast<float>(size.width) - 0.5F) * 2 * kPiF;
  const float polar = (static_cast<float>(row) + 0.5F) / static_cast<float>(size.height) * kPiF;
  return {std::sin(polar) * std::sin(longitude), std::cos(polar), -std::sin(polar) * std::cos(longitude)};
}

SkyHarmonics project_sky(std::span<const Vec3f> map, picture::PixelSize size) {
  MECHANE_ASSERT(map.size() == std::size_t{size.width} * size.height);
  SkyHarmonics sh;
  sh.fill(Vec3f::Zero());
  for (std::uint32_t row = 0; row < size.height; ++row) {
    const float polar = (static_cast<float>(row) + 0.5F) / static_cast<float>(size.height) * kPiF;
    const float solid_angle =
        std::sin(polar) * 2 * kPiF * kPiF / (static_cast<float>(size.width) * static_cast<float>(size.height));
    for (std::uint32_t column = 0; column < size.width; ++column) {
      const Vec3f& radiance = map[std::size_t{row} * size.width + column];
      const std::array<float, 9> y = polynomials(sky_map_direction(column, row, size));
      for (std::size_t i = 0; i < 9; ++i)
        sh[i] += radiance * (y[i] * kConstants[i] * solid_angle);
    }
  }
  for (std::size_t i = 0; i < 9; ++i)
    sh[i] *= kConstants[i] * kCosine[i];
  return sh;
}

Vec3f irradiance(const SkyHarmonics& sh, const Vec3f& n_W) {
  const std::array<float, 9> y = polynomials(n_W);
  Vec3f sum = Vec3f::Zero();
  for (std::size_t i = 0; i < 9; ++i)
    sum += sh[i] * y[i];
  return sum.cwiseMax(0.0F);
}

Expected<std::vector<Vec3f>> draw_sky_map(const picture::Sun& sun, picture::PixelSize size, Clouds clouds) {
  Expected<Program> program =
      Program::link({"fullscreen.vert"}, {"sky.glsl", "noise.glsl", "clouds.glsl", "sky_map.frag"});
  if (!program) return tl::unexpected(program.error());
  Expected<FloatTarget> target = FloatTarget::create(size);
  if (!target) return tl::unexpected(target.error());
  const VertexArrayName no_vertices = make_vertex_array();
  target->bind();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program->use();
  program->set("to_sun", Vec3f(sun.to_sun_W.normalized()));
  program->set("clouds", clouds == Clouds::drawn ? 1 : 0);
  glBindVertexArray(no_vertices.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return target->read();
}

Expected<SkyLight> bake_sky(const picture::Sun& sun) {
  constexpr picture::PixelSize kMap{96, 48};
  const Expected<std::vector<Vec3f>> map = draw_sky_map(sun, kMap, Clouds::drawn);
  if (!map) return tl::unexpected(map.error());
  const Expected<TextureName> sharp = draw_sky_cube(sun);
  if (!sharp) return tl::unexpected(sharp.error());
  Expected<TextureName> cube = prefilter_sky(*sharp);
  if (!cube) return tl::unexpected(cube.error());
  return SkyLight{project_sky(*map, kMap), std::move(*cube)};
}

}  // namespace mechane::draw
