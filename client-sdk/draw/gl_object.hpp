// Names of OpenGL objects that delete themselves. A current context is needed where they are made, used and destroyed;
// all on the thread that owns the context.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace mechane::draw {

/// Owns one OpenGL name; 0 is none. Moves, does not copy.
template <void (*Delete)(std::uint32_t) noexcept>
class GlName {
 public:
  GlName() = default;
  explicit GlName(std::uint32_t name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  ~GlName() { reset(); }

  [[nodiscard]] std::uint32_t get() const { return name_; }
  [[nodiscard]] explicit operator bool() const { return name_ != 0; }

 private:
  void reset() noexcept {
    if (name_ != 0) Delete(name_);
    name_ = 0;
  }
  std::uint32_t name_ = 0;
};

void delete_texture(std::uint32_t name) noexcept;
void delete_buffer(std::uint32_t name) noexcept;
void delete_vertex_array(std::uint32_t name) noexcept;
void delete_framebuffer(std::uint32_t name) noexcept;
void delete_renderbuffer(std::uint32_t name) noexcept;
void delete_sampler(std::uint32_t name) noexcept;
void delete_program(std::uint32_t name) noexcept;
void delete_query(std::uint32_t name) noexcept;

using TextureName = GlName<delete_texture>;
using BufferName = GlName<delete_buffer>;
using VertexArrayName = GlName<delete_vertex_array>;
using FramebufferName = GlName<delete_framebuffer>;
using RenderbufferName = GlName<delete_renderbuffer>;
using SamplerName = GlName<delete_sampler>;
using ProgramName = GlName<delete_program>;
using QueryName = GlName<delete_query>;

[[nodiscard]] TextureName make_texture();
[[nodiscard]] BufferName make_buffer();
[[nodiscard]] VertexArrayName make_vertex_array();
[[nodiscard]] FramebufferName make_framebuffer();
[[nodiscard]] RenderbufferName make_renderbuffer();
[[nodiscard]] SamplerName make_sampler();
[[nodiscard]] QueryName make_query();

/// Describes the vertices of the bound buffer: attribute i has sizes[i] floats, one attribute after another.
void describe_floats(std::span<const int> sizes, std::size_t vertex_bytes);

}  // namespace mechane::draw
