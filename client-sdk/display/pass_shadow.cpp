#include <epoxy/gl.h>

#include "client-sdk/display/passes.hpp"

namespace mechane::display {
namespace {

/// Everything that the map shows, as numbers.
std::vector<float> shadows_of(const RenderScene& scene, const GpuAssets& assets, const Eigen::Matrix4f& PV_light) {
  std::vector<float> out(PV_light.data(), PV_light.data() + PV_light.size());
  for (const Instance& instance : scene.instances) {
    if (!instance.casts_shadow || assets.is_clear(instance.material)) continue;
    out.push_back(static_cast<float>(instance.mesh));
    out.insert(out.end(), instance.X_WM.data(), instance.X_WM.data() + 16);
  }
  for (const RenderRope& rope : scene.ropes) {
    out.push_back(rope.radius_m);
    out.push_back(static_cast<float>(rope.points_W.size()));
    for (const Vec3f& p : rope.points_W)
      out.insert(out.end(), p.begin(), p.end());
  }
  return out;
}

}  // namespace

Expected<ShadowPass> ShadowPass::create(std::uint32_t map_size) {
  Expected<Program> program = Program::link({"depth.vert"}, {"depth.frag"});
  if (!program) return tl::unexpected(program.error());
  Expected<ShadowTarget> map = ShadowTarget::create(map_size);
  if (!map) return tl::unexpected(map.error());
  return ShadowPass(std::move(*program), std::move(*map));
}

Eigen::Matrix4f ShadowPass::draw(const RenderScene& scene, const GpuAssets& assets, const StreamedMesh& ropes) {
  const Eigen::Matrix4f PV_light = light_view(scene.shadow_box_W, scene.sun.to_sun_W);
  std::vector<float> wanted = shadows_of(scene, assets, PV_light);
  if (wanted == drawn_) return PV_light;
  drawn_ = std::move(wanted);
  ++times_drawn_;
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
  std::vector<std::uint32_t> seen;
  for (const Instance& instance : scene.instances) {
    if (!instance.casts_shadow || assets.is_clear(instance.material)) continue;
    const Eigen::Matrix4f PV_ML = PV_light * instance.X_WM.matrix();
    const std::vector<MeshPiece>& pieces = assets.pieces(instance.mesh);
    seen.clear();
    for (std::uint32_t k = 0; k < pieces.size(); ++k) {
      if (!is_outside(PV_ML, pieces[k].box_M)) seen.push_back(k);
    }
    if (seen.empty()) continue;
    program_.set("X_WM", instance.X_WM.matrix());
    assets.draw_pieces(instance.mesh, seen);
  }
  if (!ropes.empty()) {
    const Eigen::Matrix4f X_WM = Eigen::Matrix4f::Identity();
    program_.set("X_WM", X_WM);
    ropes.draw();
  }
  return PV_light;
}

}  // namespace mechane::display
