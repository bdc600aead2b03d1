#include "client-sdk/draw/passes/sky_cube.hpp"

#include <cmath>

#include <epoxy/gl.h>

#include "client-sdk/draw/shader.hpp"
#include "server/base/assert.hpp"

namespace mechane::draw {
namespace {

constexpr GLenum kFaces[] = {GL_TEXTURE_CUBE_MAP_POSITIVE_X, GL_TEXTURE_CUBE_MAP_NEGATIVE_X,
                             GL_TEXTURE_CUBE_MAP_POSITIVE_Y, GL_TEXTURE_CUBE_MAP_NEGATIVE_Y,
                             GL_TEXTURE_CUBE_MAP_POSITIVE_Z, GL_TEXTURE_CUBE_MAP_NEGATIVE_Z};
/// Samples per texel for each level: rougher levels have fewer texels and wider lobes.
int samples_of(int level) {
  return level == 0 ? 1 : 64 << level;
}

/// An empty cube map with this many levels. Leaves it bound.
TextureName make_cube(int levels) {
  TextureName cube = make_texture();
  glBindTexture(GL_TEXTURE_CUBE_MAP, cube.get());
  for (const GLenum face : kFaces) {
    for (int level = 0; level < levels; ++level) {
      const auto size = static_cast<GLsizei>(kSkyFace >> level);
      glTexImage2D(face, level, GL_RGBA16F, size, size, 0, GL_RGBA, GL_FLOAT, nullptr);
    }
  }
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, levels - 1);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_CUBE_MAP, wrap, GL_CLAMP_TO_EDGE);
  // Interpolates across the edges of faces, for all cube maps of this context.
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  return cube;
}

/// Fills a level with the current program.
Expected<void> draw_faces(const TextureName& cube, int level, const Program& program) {
  const FramebufferName framebuffer = make_framebuffer();
  const VertexArrayName no_vertices = make_vertex_array();
  const auto size = static_cast<GLsizei>(kSkyFace >> level);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glViewport(0, 0, size, size);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(no_vertices.get());
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, kFaces[face], cube.get(), level);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      return fail(ErrorCode::not_supported, "the graphics driver has no half-float cube map", "display",
                  "update the graphics driver");
    program.set("face", face);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  return {};
}

}  // namespace

Expected<TextureName> draw_sky_cube(const picture::Sun& sun) {
  const Expected<Program> program = Program::link({"fullscreen.vert"}, {"sky.glsl", "cube.glsl", "sky_face.frag"});
  if (!program) return tl::unexpected(program.error());
  TextureName cube = make_cube(static_cast<int>(std::lround(std::log2(kSkyFace))) + 1);
  program->use();
  program->set("to_sun", Vec3f(sun.to_sun_W.normalized()));
  if (auto ok = draw_faces(cube, 0, *program); !ok) return tl::unexpected(ok.error());
  glBindTexture(GL_TEXTURE_CUBE_MAP, cube.get());
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
  return cube;
}

Expected<TextureName> prefilter_sky(const TextureName& sharp) {
  const Expected<Program> program = Program::link({"fullscreen.vert"}, {"cube.glsl", "sky_prefilter.frag"});
  if (!program) return tl::unexpected(program.error());
  TextureName cube = make_cube(kSkyLevels);
  program->use();
  program->set("sharp", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_CUBE_MAP, sharp.get());
  for (int level = 0; level < kSkyLevels; ++level) {
    program->set("roughness", static_cast<float>(level) / (kSkyLevels - 1));
    program->set("samples", samples_of(level));
    if (auto ok = draw_faces(cube, level, *program); !ok) return tl::unexpected(ok.error());
  }
  return cube;
}

std::vector<Vec3f> read_cube(const TextureName& cube, int level) {
  MECHANE_ASSERT(level >= 0 && (kSkyFace >> level) > 0);
  const std::size_t face_texels = std::size_t{kSkyFace >> level} * (kSkyFace >> level);
  std::vector<Vec3f> texels(6 * face_texels);
  glBindTexture(GL_TEXTURE_CUBE_MAP, cube.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (std::size_t face = 0; face < 6; ++face)
    glGetTexImage(kFaces[face], level, GL_RGB, GL_FLOAT, texels.data() + face * face_texels);
  return texels;
}

Vec3f cube_direction(std::uint32_t face, std::uint32_t column, std::uint32_t row, std::uint32_t size) {
  MECHANE_ASSERT(face < 6);
  const float s = (static_cast<float>(column) + 0.5F) / static_cast<float>(size) * 2 - 1;
  const float t = (static_cast<float>(row) + 0.5F) / static_cast<float>(size) * 2 - 1;
  const Vec3f directions[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
  return directions[face].normalized();
}

}  // namespace mechane::draw
