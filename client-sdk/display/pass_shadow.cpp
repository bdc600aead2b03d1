#include <epoxy/gl.h>

#include "client-sdk/display/passes.hpp"

namespace mechane::display {

Expected<ShadowPass> ShadowPass::create(std::uint32_t map_size) {
  Expected<Program> program = Program::link({"depth.vert"}, {"depth.frag"});
  if (!program) return tl::unexpected(program.error());
  Expected<ShadowTarget> map = ShadowTarget::create(map_size);
  if (!map) return tl::unexpected(map.error());
  return ShadowPass(std::move(*program), std::move(*map));
}

Eigen::Matrix4f ShadowPass::draw(const RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes) const {
  const Eigen::Matrix4f PV_light = light_view(scene.shadow_box_W, scene.sun.to_sun_W);
  glBindFramebuffer(GL_FRAMEBUFFER, map_.framebuffer.get());
  glViewport(0, 0, static_cast<GLsizei>(map_.size), static_cast<GLsizei>(map_.size));
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  // Thin boards cast from both sides.
  glDisable(GL_CULL_FACE);
  glClear(GL_DEPTH_BUFFER_BIT);
  program_.use();
  program_.set("PV", PV_light);
  for (const Instance& instance : scene.instances) {
    if (!instance.casts_shadow || assets.is_clear(instance.material)) continue;
    program_.set("X_WM", instance.X_WM.matrix());
    assets.draw(instance.mesh);
  }
  if (!ropes.empty()) {
    const Eigen::Matrix4f X_WM = Eigen::Matrix4f::Identity();
    program_.set("X_WM", X_WM);
    ropes.draw();
  }
  return PV_light;
}

}  // namespace mechane::display
