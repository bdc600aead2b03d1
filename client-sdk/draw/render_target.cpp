#include "client-sdk/draw/render_target.hpp"

#include <algorithm>
#include <array>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace mechane::draw {
namespace {

Expected<void> check_complete(const char* what, picture::PixelSize size) {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  return fail(status == GL_FRAMEBUFFER_UNSUPPORTED ? ErrorCode::not_supported : ErrorCode::too_large,
              fmt::format("the graphics driver cannot make a {} of {}x{} pixels (status 0x{:x})", what, size.width,
                          size.height, status),
              "display", "choose a smaller --size, or update the graphics driver");
}

void clamp_to_edge(GLenum kind) {
  glTexParameteri(kind, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(kind, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// Makes `texture` a depth picture and the framebuffer's depth attachment. Leaves both bound.
void attach_depth_texture(const FramebufferName& framebuffer, const TextureName& texture, picture::PixelSize size) {
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, static_cast<GLsizei>(size.width),
               static_cast<GLsizei>(size.height), 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  clamp_to_edge(GL_TEXTURE_2D);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.get(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

/// Makes `texture` a colour picture and the framebuffer's colour attachment. Leaves both bound.
void attach_colour_texture(const FramebufferName& framebuffer, const TextureName& texture, picture::PixelSize size,
                           GLint format, GLenum type, GLint filter, GLenum place = GL_COLOR_ATTACHMENT0) {
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, format, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), 0,
               GL_RGBA, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  clamp_to_edge(GL_TEXTURE_2D);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D, texture.get(), 0);
}

void blit(const FramebufferName& from, const FramebufferName& to, picture::PixelSize size, GLbitfield what) {
  const auto width = static_cast<GLint>(size.width);
  const auto height = static_cast<GLint>(size.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.get());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, what, GL_NEAREST);
}

}  // namespace

Expected<HdrTarget> HdrTarget::create(picture::PixelSize size, int samples) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  HdrTarget target{make_framebuffer(),
                   make_texture(),
                   make_renderbuffer(),
                   size,
                   std::clamp(samples, 1, std::max(most, 1)),
                   make_framebuffer(),
                   make_texture(),
                   samples};
  const auto width = static_cast<GLsizei>(size.width);
  const auto height = static_cast<GLsizei>(size.height);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, target.colour.get());
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, target.samples, GL_RGBA16F, width, height, GL_TRUE);
  glBindRenderbuffer(GL_RENDERBUFFER, target.depth.get());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, target.samples, GL_DEPTH_COMPONENT24, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, target.colour.get(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth.get());
  if (auto ok = check_complete("multisampled picture", size); !ok) return tl::unexpected(ok.error());
  attach_depth_texture(target.depth_copy_framebuffer, target.depth_copy, size);
  if (auto ok = check_complete("copy of the depth", size); !ok) return tl::unexpected(ok.error());
  return target;
}

void HdrTarget::resolve_depth() const {
  blit(framebuffer, depth_copy_framebuffer, size, GL_DEPTH_BUFFER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
}

Expected<MirrorTarget> MirrorTarget::create(picture::PixelSize size) {
  MirrorTarget target{make_framebuffer(), make_texture(), make_renderbuffer(), size};
  const auto width = static_cast<GLsizei>(size.width);
  const auto height = static_cast<GLsizei>(size.height);
  glBindTexture(GL_TEXTURE_2D, target.colour.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  clamp_to_edge(GL_TEXTURE_2D);
  glBindRenderbuffer(GL_RENDERBUFFER, target.depth.get());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.colour.get(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, target.depth.get());
  if (auto ok = check_complete("picture of what water mirrors", size); !ok) return tl::unexpected(ok.error());
  return target;
}

void MirrorTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

Expected<ShadowTarget> ShadowTarget::create(std::uint32_t size, std::uint32_t layers) {
  ShadowTarget target{make_framebuffer(), make_texture(), make_sampler(), size};
  glBindTexture(GL_TEXTURE_2D_ARRAY, target.depth.get());
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT24, static_cast<GLsizei>(size), static_cast<GLsizei>(size),
               static_cast<GLsizei>(layers), 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  clamp_to_edge(GL_TEXTURE_2D_ARRAY);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glSamplerParameteri(target.plain_depth.get(), filter, GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glSamplerParameteri(target.plain_depth.get(), wrap, GL_CLAMP_TO_EDGE);
  target.bind_layer(0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  if (auto ok = check_complete("shadow map", {size, size}); !ok) return tl::unexpected(ok.error());
  return target;
}

void ShadowTarget::bind_layer(std::uint32_t layer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth.get(), 0, static_cast<GLint>(layer));
}

Expected<PictureTarget> PictureTarget::create(picture::PixelSize size) {
  PictureTarget target{make_framebuffer(), make_texture(), size};
  attach_colour_texture(target.framebuffer, target.colour, size, GL_RGBA8, GL_UNSIGNED_BYTE, GL_NEAREST);
  if (auto ok = check_complete("picture", size); !ok) return tl::unexpected(ok.error());
  return target;
}

picture::ImageData PictureTarget::read() const {
  picture::ImageData image{size.width, size.height, {}, true};
  const std::size_t row = std::size_t{4} * size.width;
  std::vector<std::uint8_t> upside_down(row * size.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), GL_RGBA, GL_UNSIGNED_BYTE,
               upside_down.data());
  image.rgba.resize(upside_down.size());
  for (std::uint32_t y = 0; y < size.height; ++y) {
    std::copy_n(upside_down.begin() + static_cast<std::ptrdiff_t>(row * (size.height - 1 - y)), row,
                image.rgba.begin() + static_cast<std::ptrdiff_t>(row * y));
  }
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
    image.rgba[i] = 255;
  return image;
}

Expected<ScreenTarget> ScreenTarget::create(picture::PixelSize size, Use use) {
  ScreenTarget target{
      make_framebuffer(), make_texture(), make_texture(), size, make_framebuffer(), make_texture(), {}, {}};
  attach_depth_texture(target.framebuffer, target.depth, size);
  attach_colour_texture(target.framebuffer, target.colour, size, GL_RGBA8, GL_UNSIGNED_BYTE, GL_LINEAR);
  constexpr std::array<GLenum, 3> kPlaces{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  if (use == Use::kept) {
    target.all_light = make_texture();
    target.sun_light = make_texture();
    attach_colour_texture(target.framebuffer, target.all_light, size, GL_RGBA16F, GL_FLOAT, GL_NEAREST, kPlaces[1]);
    attach_colour_texture(target.framebuffer, target.sun_light, size, GL_RGBA16F, GL_FLOAT, GL_NEAREST, kPlaces[2]);
  }
  glDrawBuffers(use == Use::kept ? 3 : 1, kPlaces.data());
  glReadBuffer(kPlaces[0]);
  if (auto ok = check_complete("picture with depth", size); !ok) return tl::unexpected(ok.error());
  if (use == Use::drawn) {
    attach_depth_texture(target.depth_copy_framebuffer, target.depth_copy, size);
    if (auto ok = check_complete("copy of the depth", size); !ok) return tl::unexpected(ok.error());
  }
  return target;
}

void ScreenTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
}

void ScreenTarget::copy_depth() const {
  blit(framebuffer, depth_copy_framebuffer, size, GL_DEPTH_BUFFER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
}

void ScreenTarget::copy_from(const ScreenTarget& other) const {
  blit(other.framebuffer, framebuffer, size, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
}

void PictureArea::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glViewport(x, y, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
}

Expected<FloatTarget> FloatTarget::create(picture::PixelSize size) {
  FloatTarget target{make_framebuffer(), make_texture(), size};
  attach_colour_texture(target.framebuffer, target.colour, size, GL_RGBA16F, GL_FLOAT, GL_LINEAR);
  if (auto ok = check_complete("half-float picture", size); !ok) return tl::unexpected(ok.error());
  return target;
}

void FloatTarget::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
}

std::vector<Vec3f> FloatTarget::read() const {
  std::vector<Vec3f> pixels(std::size_t{size.width} * size.height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height), GL_RGB, GL_FLOAT,
               pixels.data());
  return pixels;
}

}  // namespace mechane::draw
