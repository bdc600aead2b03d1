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
void delete_query(std::uint32_t name) noexcept {
  glDeleteQueries(1, &name);
}

namespace {

/// One new name from a glGen...() function.
template <class Name, class Generate>
Name generated(Generate generate) {
  GLuint name = 0;
  generate(1, &name);
  return Name(name);
}

}  // namespace

TextureName make_texture() {
  return generated<TextureName>(glGenTextures);
}
BufferName make_buffer() {
  return generated<BufferName>(glGenBuffers);
}
VertexArrayName make_vertex_array() {
  return generated<VertexArrayName>(glGenVertexArrays);
}
FramebufferName make_framebuffer() {
  return generated<FramebufferName>(glGenFramebuffers);
}
RenderbufferName make_renderbuffer() {
  return generated<RenderbufferName>(glGenRenderbuffers);
}
SamplerName make_sampler() {
  return generated<SamplerName>(glGenSamplers);
}
QueryName make_query() {
  return generated<QueryName>(glGenQueries);
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
