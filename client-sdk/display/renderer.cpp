#include "client-sdk/display/renderer.hpp"

#include <array>

#include <epoxy/gl.h>

#include "client-sdk/display/rope_mesh.hpp"
#include "server/base/assert.hpp"

namespace mechane::display {
namespace {

Expected<void> fit(std::optional<HdrTarget>& target, PixelSize size, int samples) {
  if (target && target->size == size) return {};
  target.reset();
  Expected<HdrTarget> made = HdrTarget::create(size, samples);
  if (!made) return tl::unexpected(made.error());
  target.emplace(std::move(*made));
  return {};
}

double aspect_of(PixelSize size) {
  return static_cast<double>(size.width) / size.height;
}

}  // namespace

Expected<std::unique_ptr<Renderer>> Renderer::create(const RendererSettings& settings) {
  Expected<ShadowPass> shadow = ShadowPass::create(settings.shadow_map_size);
  if (!shadow) return tl::unexpected(shadow.error());
  Expected<OpaquePass> opaque = OpaquePass::create();
  if (!opaque) return tl::unexpected(opaque.error());
  Expected<SkyPass> sky = SkyPass::create();
  if (!sky) return tl::unexpected(sky.error());
  Expected<WaterPass> water = WaterPass::create();
  if (!water) return tl::unexpected(water.error());
  Expected<ClearPass> clear = ClearPass::create();
  if (!clear) return tl::unexpected(clear.error());
  Expected<ParticlePass> particle = ParticlePass::create();
  if (!particle) return tl::unexpected(particle.error());
  Expected<TonePass> tone = TonePass::create();
  if (!tone) return tl::unexpected(tone.error());
  Expected<OverlayPass> overlay = OverlayPass::create(settings.font_folder);
  if (!overlay) return tl::unexpected(overlay.error());
  return std::unique_ptr<Renderer>(
      new Renderer(settings, Passes{std::move(*shadow), std::move(*opaque), std::move(*sky), std::move(*water),
                                    std::move(*clear), std::move(*particle), std::move(*tone), std::move(*overlay)}));
}

Expected<void> Renderer::fit_targets(PixelSize picture, PixelSize eye, bool inset) {
  if (!picture_ || picture_->size != picture) {
    picture_.reset();
    Expected<PictureTarget> made = PictureTarget::create(picture);
    if (!made) return tl::unexpected(made.error());
    picture_.emplace(std::move(*made));
  }
  if (auto ok = fit(hdr_, eye, settings_.samples); !ok) return ok;
  const PixelRectangle place = inset_rectangle(eye);
  return inset ? fit(inset_, {place.width, place.height}, settings_.samples) : Expected<void>();
}

Expected<void> Renderer::fit_sky(const Sun& sun) {
  if (baked_sun_ && baked_sun_->to_sun_W == sun.to_sun_W) return {};
  Expected<SkyHarmonics> baked = bake_sky(sun);
  if (!baked) return tl::unexpected(baked.error());
  sky_ = *baked;
  baked_sun_ = sun;
  return {};
}

Expected<void> Renderer::draw(const RenderScene& scene, Stereo stereo, PixelSize size) {
  const bool mono = stereo == Stereo::mono;
  const PixelSize eye_size{mono ? size.width : size.width / 2, size.height};
  if (eye_size.width == 0 || eye_size.height == 0) {
    return fail("the picture has no pixels", "display", "give a --size of at least 2x1");
  }
  if (auto ok = fit_targets(size, eye_size, scene.inset.has_value()); !ok) return ok;
  if (auto ok = fit_sky(scene.sun); !ok) return ok;
  MeshData ropes;
  for (const RenderRope& rope : scene.ropes)
    append_rope(rope, ropes);
  ropes_.upload(ropes);
  const Eigen::Matrix4f PV_light = passes_.shadow.draw(scene, assets_, ropes_);
  if (scene.inset) {
    draw_view(scene, eye_view(scene.inset->camera, Eye::middle, aspect_of(inset_->size)), PV_light, *inset_);
  }
  constexpr std::array<Eye, 2> kBoth{Eye::left, Eye::right};
  for (int half = 0; half < (mono ? 1 : 2); ++half) {
    const Eye eye = mono ? Eye::middle : kBoth[static_cast<std::size_t>(half)];
    draw_view(scene, eye_view(scene.camera, eye, aspect_of(eye_size)), PV_light, *hdr_);
    finish_eye(scene, eye_size, half * static_cast<std::int32_t>(eye_size.width));
  }
  return {};
}

void Renderer::draw_view(const RenderScene& scene, const EyeView& view, const Eigen::Matrix4f& PV_light,
                         const HdrTarget& target) {
  const PassInput input{scene, assets_, ropes_, view, sky_, passes_.shadow.map(), PV_light, target};
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(target.size.width), static_cast<GLsizei>(target.size.height));
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  passes_.opaque.draw(input);
  passes_.sky.draw(input);
  passes_.water.draw(input);
  passes_.clear.draw(input);
  passes_.particle.draw(input);
}

void Renderer::finish_eye(const RenderScene& scene, PixelSize eye, std::int32_t x) {
  glBindFramebuffer(GL_FRAMEBUFFER, picture_->framebuffer.get());
  const auto width = static_cast<GLsizei>(eye.width);
  const auto height = static_cast<GLsizei>(eye.height);
  glViewport(x, 0, width, height);
  passes_.tone.draw(*hdr_, settings_.exposure);
  if (scene.inset) {
    const PixelRectangle place = inset_rectangle(eye);
    glViewport(x + static_cast<GLint>(place.x), height - static_cast<GLint>(place.y + place.height),
               static_cast<GLsizei>(place.width), static_cast<GLsizei>(place.height));
    passes_.tone.draw(*inset_, settings_.exposure);
    glViewport(x, 0, width, height);
  }
  passes_.overlay.draw(scene, eye);
}

ImageData Renderer::read_picture() const {
  MECHANE_ASSERT(picture_.has_value());
  return picture_->read();
}

void Renderer::finish() {
  glFinish();
}

void Renderer::copy_to_window(PixelSize window) const {
  MECHANE_ASSERT(picture_.has_value());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_->framebuffer.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, static_cast<GLint>(picture_->size.width), static_cast<GLint>(picture_->size.height), 0, 0,
                    static_cast<GLint>(window.width), static_cast<GLint>(window.height), GL_COLOR_BUFFER_BIT,
                    GL_LINEAR);
}

}  // namespace mechane::display
