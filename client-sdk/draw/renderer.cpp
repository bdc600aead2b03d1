#include "client-sdk/draw/renderer.hpp"

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/rope_mesh.hpp"
#include "server/base/assert.hpp"

namespace mechane::draw {
namespace {

constexpr int kMediumSamples = 2;

Expected<void> fit(std::optional<HdrTarget>& target, picture::PixelSize size, int samples) {
  if (target && target->size == size && target->asked_samples == samples) return {};
  target.reset();
  Expected<HdrTarget> made = HdrTarget::create(size, samples);
  if (!made) return tl::unexpected(made.error());
  target.emplace(std::move(*made));
  return {};
}

Expected<void> fit(std::optional<PictureTarget>& target, picture::PixelSize size) {
  if (target && target->size == size) return {};
  target.reset();
  Expected<PictureTarget> made = PictureTarget::create(size);
  if (!made) return tl::unexpected(made.error());
  target.emplace(std::move(*made));
  return {};
}

/// Whether each eye is first drawn to a picture of its own.
bool is_put_together(picture::Stereo stereo) {
  return stereo == picture::Stereo::anaglyph || stereo == picture::Stereo::row_interleaved ||
         stereo == picture::Stereo::quad_buffer;
}

void copy_to_buffer(const PictureTarget& from, picture::PixelSize window, GLenum buffer) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer.get());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glDrawBuffer(buffer);
  glBlitFramebuffer(0, 0, static_cast<GLint>(from.size.width), static_cast<GLint>(from.size.height), 0, 0,
                    static_cast<GLint>(window.width), static_cast<GLint>(window.height), GL_COLOR_BUFFER_BIT,
                    GL_LINEAR);
}

/// The close-up's place in an eye's picture of `size` pixels that is seen in the proportions of `seen`.
PixelRectangle inset_in(picture::PixelSize pixels, picture::PixelSize seen) {
  const PixelRectangle place = inset_rectangle(seen);
  const auto across = [&](std::uint32_t x) { return x * pixels.width / seen.width; };
  const auto down = [&](std::uint32_t y) { return y * pixels.height / seen.height; };
  return {across(place.x), down(place.y), across(place.width), down(place.height)};
}

picture::EyeView inset_view(const picture::Inset& inset, picture::PixelSize seen) {
  const PixelRectangle place = inset_rectangle(seen);
  return picture::eye_view(inset.camera, picture::Eye::middle, picture::aspect_of({place.width, place.height}));
}

}  // namespace

Expected<std::unique_ptr<Renderer>> Renderer::create(const RendererSettings& settings) {
  Expected<CompositePass> composite = CompositePass::create();
  if (!composite) return tl::unexpected(composite.error());
  Expected<OverlayPass> overlay = OverlayPass::create(settings.font_folder);
  if (!overlay) return tl::unexpected(overlay.error());
  std::unique_ptr<Renderer> out(new Renderer(settings, std::move(*composite), std::move(*overlay)));
  if (auto ok = out->fit_passes(); !ok) return tl::unexpected(ok.error());
  return out;
}

Expected<Renderer::FullPasses> Renderer::make_full(std::uint32_t shadow_map_size) {
  Expected<ShadowPass> shadow = ShadowPass::create(shadow_map_size);
  if (!shadow) return tl::unexpected(shadow.error());
  Expected<OpaquePass> opaque = OpaquePass::create(Shading::linear);
  if (!opaque) return tl::unexpected(opaque.error());
  Expected<SkyPass> sky = SkyPass::create(Shading::linear);
  if (!sky) return tl::unexpected(sky.error());
  Expected<MirrorPass> mirror = MirrorPass::create();
  if (!mirror) return tl::unexpected(mirror.error());
  Expected<WaterPass> water = WaterPass::create(Shading::linear);
  if (!water) return tl::unexpected(water.error());
  Expected<ClearPass> clear = ClearPass::create(Shading::linear);
  if (!clear) return tl::unexpected(clear.error());
  Expected<ParticlePass> particle = ParticlePass::create(Shading::linear);
  if (!particle) return tl::unexpected(particle.error());
  Expected<BloomPass> bloom = BloomPass::create();
  if (!bloom) return tl::unexpected(bloom.error());
  Expected<AmbientOcclusionPass> occlusion = AmbientOcclusionPass::create();
  if (!occlusion) return tl::unexpected(occlusion.error());
  Expected<TonePass> tone = TonePass::create();
  if (!tone) return tl::unexpected(tone.error());
  return FullPasses{std::move(*shadow),    std::move(*opaque), std::move(*sky),      std::move(*mirror),
                    std::move(*water),     std::move(*clear),  std::move(*particle), std::move(*bloom),
                    std::move(*occlusion), std::move(*tone)};
}

/// Shaders are compiled for the qualities that are used.
Expected<void> Renderer::fit_passes() {
  if (is_low() && !low_) {
    Expected<LowRenderer> made = LowRenderer::create();
    if (!made) return tl::unexpected(made.error());
    low_.emplace(std::move(*made));
  } else if (!is_low() && !full_) {
    Expected<FullPasses> made = make_full(settings_.shadow_map_size);
    if (!made) return tl::unexpected(made.error());
    full_.emplace(std::move(*made));
  }
  return {};
}

Expected<void> Renderer::fit_targets(picture::Stereo stereo, picture::PixelSize picture, bool inset) {
  const picture::PixelSize eye = picture::eye_size(stereo, picture);
  if (auto ok = fit(picture_, picture); !ok) return ok;
  for (std::optional<PictureTarget>& target : eyes_) {
    if (!is_put_together(stereo)) {
      target.reset();
    } else if (auto ok = fit(target, eye); !ok) {
      return ok;
    }
  }
  if (is_low()) return {};  // it has targets of its own
  const int samples = quality_ == Quality::high ? settings_.samples : kMediumSamples;
  if (auto ok = fit(hdr_, eye, samples); !ok) return ok;
  const PixelRectangle place = inset_in(eye, picture::seen_size(stereo, picture));
  return inset ? fit(inset_, {place.width, place.height}, samples) : Expected<void>();
}

Expected<void> Renderer::fit_sky(const picture::Sun& sun) {
  if (baked_sun_ && baked_sun_->to_sun_W == sun.to_sun_W) return {};
  Expected<SkyLight> baked = bake_sky(sun);
  if (!baked) return tl::unexpected(baked.error());
  sky_ = std::move(*baked);
  baked_sun_ = sun;
  return {};
}

Expected<void> Renderer::draw(const picture::RenderScene& scene, picture::Stereo stereo, picture::PixelSize size) {
  const picture::PixelSize eye_pixels = picture::eye_size(stereo, size);
  if (eye_pixels.width == 0 || eye_pixels.height == 0) {
    return fail(ErrorCode::invalid_value, "the picture has no pixels", "display", "give a --size of at least 2x2");
  }
  if (auto ok = fit_passes(); !ok) return ok;
  if (auto ok = fit_targets(stereo, size, scene.inset.has_value()); !ok) return ok;
  if (auto ok = fit_sky(scene.sun); !ok) return ok;
  mark(nullptr);
  upload_moving(scene);
  lay_out(scene, stereo, size);
  if (auto ok = is_low() ? draw_low(scene, stereo) : draw_full(scene, stereo); !ok) return ok;
  if (stereo == picture::Stereo::anaglyph || stereo == picture::Stereo::row_interleaved) {
    glBindFramebuffer(GL_FRAMEBUFFER, picture_->framebuffer.get());
    glViewport(0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height));
    composite_.draw(*eyes_[0], *eyes_[1], stereo, settings_.right_eye_first != odd_row_);
    mark("composite");
  }
  last_ = stereo;
  return {};
}

Expected<void> Renderer::draw_full(const picture::RenderScene& scene, picture::Stereo stereo) {
  const picture::PixelSize seen = picture::seen_size(stereo, picture_->size);
  const ShadowSetup shadows = full_->shadow.draw(scene, assets_, ropes_, soft_bodies_);
  mark("shadow");
  if (scene.inset) {
    if (auto ok = draw_view(scene, inset_view(*scene.inset, seen), shadows, *inset_); !ok) return ok;
  }
  const std::vector<picture::Eye> eyes = picture::eyes_of(stereo);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const picture::EyeView view = picture::eye_view(scene.camera, eyes[i], picture::aspect_of(seen));
    if (auto ok = draw_view(scene, view, shadows, *hdr_); !ok) return ok;
    if (auto ok = finish_eye(scene, view, target_of(stereo, i)); !ok) return ok;
    mark("tone and words");
  }
  return {};
}

Expected<void> Renderer::draw_low(const picture::RenderScene& scene, picture::Stereo stereo) {
  constexpr std::size_t kInset = LowRenderer::kViews - 1;
  const bool keeps = quality_ == Quality::cached;
  const picture::PixelSize seen = picture::seen_size(stereo, picture_->size);
  const LowScene low{scene, assets_, ropes_, soft_bodies_, sky_, settings_.exposure};
  low_->begin(low);
  mark("shadow");
  if (scene.inset) {
    const PixelRectangle place = inset_in(picture::eye_size(stereo, picture_->size), seen);
    const picture::EyeView view = inset_view(*scene.inset, seen);
    if (auto ok = low_->draw_at_half_rate(low, kInset, view, {place.width, place.height}, keeps); !ok) return ok;
  }
  const std::vector<picture::Eye> eyes = picture::eyes_of(stereo);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const picture::EyeView view = picture::eye_view(scene.camera, eyes[i], picture::aspect_of(seen));
    const EyeTarget into = target_of(stereo, i);
    if (auto ok = low_->draw_view(low, i, view, into.pixels, keeps); !ok) return ok;
    mark("scene");
    low_->show(i, area_of(into));
    if (scene.inset) low_->show(kInset, inset_area_of(into));
    area_of(into).bind();
    overlay_.draw();
    mark("edges and words");
  }
  return {};
}

PictureArea Renderer::area_of(const EyeTarget& into) {
  return {into.target.framebuffer, into.x, into.y, into.pixels};
}

/// The close-up's place.
PictureArea Renderer::inset_area_of(const EyeTarget& into) {
  const PixelRectangle place = inset_in(into.pixels, into.seen);
  const auto from_below = static_cast<std::int32_t>(into.pixels.height - (place.y + place.height));
  return {into.target.framebuffer,
          into.x + static_cast<std::int32_t>(place.x),
          into.y + from_below,
          {place.width, place.height}};
}

/// Uploads meshes that have another shape in each picture.
void Renderer::upload_moving(const picture::RenderScene& scene) {
  picture::MeshData ropes;
  for (const picture::RenderRope& rope : scene.ropes)
    append_rope(rope, ropes);
  ropes_.upload(ropes);
  while (soft_bodies_.size() < scene.soft_bodies.size())
    soft_bodies_.push_back(StreamedMesh::create());
  for (std::size_t i = 0; i < scene.soft_bodies.size(); ++i)
    soft_bodies_[i].upload(scene.soft_bodies[i].mesh_W);
}

void Renderer::mark(const char* pass) {
  if (!settings_.profile) return;
  glFinish();
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  if (pass == nullptr) {
    pass_times_.clear();
  } else {
    pass_times_.push_back({pass, std::chrono::duration<double, std::milli>(wall - wall_mark_).count(),
                           1e3 * static_cast<double>(cpu - cpu_mark_) / CLOCKS_PER_SEC});
  }
  wall_mark_ = wall;
  cpu_mark_ = cpu;
}

Renderer::EyeTarget Renderer::target_of(picture::Stereo stereo, std::size_t eye) const {
  const picture::PixelSize size = picture::eye_size(stereo, picture_->size);
  const auto index = static_cast<std::int32_t>(eye);
  EyeTarget out{is_put_together(stereo) ? *eyes_[eye] : *picture_, size, picture::seen_size(stereo, picture_->size)};
  if (picture::is_side_by_side(stereo)) out.x = index * static_cast<std::int32_t>(size.width);
  // OpenGL counts rows from the bottom.
  if (picture::is_top_bottom(stereo))
    out.y = static_cast<std::int32_t>(picture_->size.height) - (1 + index) * static_cast<std::int32_t>(size.height);
  return out;
}

Expected<void> Renderer::draw_view(const picture::RenderScene& scene, const picture::EyeView& view,
                                   const ShadowSetup& shadows, const HdrTarget& target) {
  PassInput input{scene,   assets_,     ropes_,           soft_bodies_, view, sky_, full_->shadow.maps(),
                  shadows, target.size, target.depth_copy};
  if (quality_ == Quality::high) {
    const Expected<std::optional<MirrorImage>> mirror = full_->mirror.draw(input, full_->opaque, full_->sky);
    if (!mirror) return tl::unexpected(mirror.error());
    input.mirror = *mirror;
    mark("mirror");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(target.size.width), static_cast<GLsizei>(target.size.height));
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  full_->opaque.draw(input);
  mark("opaque");
  full_->sky.draw(input);
  mark("sky");
  target.resolve_depth();
  full_->water.draw(input);
  mark("water");
  full_->clear.draw(input);
  mark("clear");
  full_->particle.draw(input);
  mark("particles");
  return {};
}

Expected<void> Renderer::finish_eye(const picture::RenderScene& scene, const picture::EyeView& view,
                                    const EyeTarget& into) {
  if (auto ok = full_->bloom.draw(*hdr_, settings_.exposure); !ok) return ok;
  const bool darkens = quality_ == Quality::high;
  if (darkens) {
    if (auto ok = full_->ambient_occlusion.draw(*hdr_, view); !ok) return ok;
  }
  mark("glow and ambient occlusion");
  area_of(into).bind();
  full_->tone.draw(*hdr_, settings_.exposure,
                   {&full_->bloom.glow(), darkens ? &full_->ambient_occlusion.openness() : nullptr, settings_.glow,
                    settings_.ambient_occlusion});
  if (scene.inset) {
    inset_area_of(into).bind();
    full_->tone.draw(*inset_, settings_.exposure, {});
    area_of(into).bind();
  }
  overlay_.draw();
  return {};
}

picture::ImageData Renderer::read_picture(picture::Eye eye) const {
  MECHANE_ASSERT(picture_.has_value());
  if (last_ == picture::Stereo::quad_buffer) return eyes_[eye == picture::Eye::right ? 1 : 0]->read();
  return picture_->read();
}

void Renderer::finish() {
  glFinish();
}

void Renderer::copy_to_window(picture::PixelSize window) const {
  MECHANE_ASSERT(picture_.has_value());
  if (last_ != picture::Stereo::quad_buffer) {
    copy_to_buffer(*picture_, window, GL_BACK);
    return;
  }
  copy_to_buffer(*eyes_[0], window, GL_BACK_LEFT);
  copy_to_buffer(*eyes_[1], window, GL_BACK_RIGHT);
}

}  // namespace mechane::draw
