#include "client-sdk/draw/gl_object.hpp"

#include <epoxy/gl.h>

namespace mechane::draw {

void delete_texture(std::uint32_t name) noexcept {
  glDeleteTextures(1, &name);
}
void delete_buffer(std::uint32_t name) noexcept {
  glDeleteBuffers(1, &name);
}
void delete_vertex_array(std::uint32_t name) noexcept {
  glDeleteVertexArrays(1, &name);
}
void delete_framebuffer(std::uint32_t name) noexcept {
  glDeleteFramebuffers(1, &name);
}
void delete_renderbuffer(std::uint32_t name) noexcept {
  glDeleteRenderbuffers(1, &name);
}
void delete_sampler(std::uint32_t name) noexcept {
  glDeleteSamplers(1, &name);
}
void delete_program(std::uint32_t name) noexcept {
  glDeleteProgram(name);
}

TextureName make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return TextureName(name);
}

BufferName make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return BufferName(name);
}

VertexArrayName make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArrayName(name);
}

FramebufferName make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return FramebufferName(name);
}

RenderbufferName make_renderbuffer() {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  return RenderbufferName(name);
}

SamplerName make_sampler() {
  GLuint name = 0;
  glGenSamplers(1, &name);
  return SamplerName(name);
}

void describe_floats(std::span<const int> sizes, std::size_t vertex_bytes) {
  std::size_t offset = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto attribute = static_cast<GLuint>(i);
    glEnableVertexAttribArray(attribute);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): where a buffer is bound, OpenGL takes an offset for a pointer
    const auto* where = reinterpret_cast<const void*>(offset);
    glVertexAttribPointer(attribute, sizes[i], GL_FLOAT, GL_FALSE, static_cast<GLsizei>(vertex_bytes), where);
    offset += static_cast<std::size_t>(sizes[i]) * sizeof(float);
  }
}

}  // namespace mechane::draw
