#include <algorithm>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"
#include "client-sdk/draw/passes/water_mirror.hpp"

namespace mechane::draw {

Expected<MirrorPass> MirrorPass::create() {
  Expected<Program> program = Program::link({"depth.vert"}, {"depth.frag"});
  if (!program) return tl::unexpected(program.error());
  return MirrorPass(std::move(*program));
}

/// Marks the water surface in the stencil, as the eye sees it.
void MirrorPass::mark_water(const PassInput& input, float height_m) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  program_.use();
  const Eigen::Matrix4f PV = input.view.P * input.view.V_CW;
  program_.set("PV", PV);
  for (const picture::WaterInstance& water : input.scene.waters) {
    const std::optional<float> level = level_m(water, input.assets);
    if (!level || !is_same_level(*level, height_m)) continue;
    set_model(program_, water.X_WM);
    input.assets.draw(water.mesh);
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glStencilFunc(GL_EQUAL, 1, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

/// The target for this size. There are two, because the close-up has a size of its own and alternates with the eyes'
/// pictures.
Expected<const MirrorTarget*> MirrorPass::fit(picture::PixelSize size) {
  const auto kept = std::ranges::find(targets_, size, &MirrorTarget::size);
  if (kept != targets_.end()) return &*kept;
  Expected<MirrorTarget> made = MirrorTarget::create(size);
  if (!made) return tl::unexpected(made.error());
  if (targets_.size() == kSizes) targets_.erase(targets_.begin());
  targets_.push_back(std::move(*made));
  return &targets_.back();
}

Expected<std::optional<MirrorImage>> MirrorPass::draw(const PassInput& input, const OpaquePass& opaque,
                                                      const SkyPass& sky) {
  const std::optional<float> height_m = mirror_level_m(input.scene, input.assets, input.view);
  if (!height_m) return std::optional<MirrorImage>();
  const picture::PixelSize half{std::max((input.size.width + 1) / 2, 1U), std::max((input.size.height + 1) / 2, 1U)};
  const Expected<const MirrorTarget*> fitted = fit(half);
  if (!fitted) return tl::unexpected(fitted.error());
  const MirrorTarget& target = **fitted;
  target.begin();
  mark_water(input, *height_m);
  const picture::EyeView view = mirrored(input.view, *height_m);
  PassInput under{input.scene, input.assets, input.ropes,        input.soft_bodies, view,
                  input.sky,   input.shadow, input.shadow_setup, input.size,        input.depth_of_solid};
  under.clip_W = {0, 1, 0, -*height_m};
  glFrontFace(GL_CW);
  glEnable(GL_CLIP_DISTANCE0);
  opaque.draw(under);
  glDisable(GL_CLIP_DISTANCE0);
  glFrontFace(GL_CCW);
  sky.draw(under);
  glDisable(GL_STENCIL_TEST);
  return std::optional<MirrorImage>(MirrorImage{&target.colour, *height_m});
}

}  // namespace mechane::draw
