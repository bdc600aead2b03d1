#include <epoxy/gl.h>

#include "client-sdk/display/passes.hpp"
#include "client-sdk/display/procedural_mesh.hpp"

namespace mechane::display {

Expected<OpaquePass> OpaquePass::create() {
  Expected<Program> surface =
      Program::link({"mesh.vert"}, {"sky.glsl", "lighting.glsl", "material.glsl", "surface.frag"});
  if (!surface) return tl::unexpected(surface.error());
  Expected<Program> rope = Program::link({"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "rope.frag"});
  if (!rope) return tl::unexpected(rope.error());
  Expected<Program> ground = Program::link({"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "ground.frag"});
  if (!ground) return tl::unexpected(ground.error());
  GpuAssets plain;
  SceneAssets assets;
  assets.meshes.push_back(disc_mesh(380, 64));
  plain.upload(assets);
  return OpaquePass(std::move(*surface), std::move(*rope), std::move(*ground), std::move(plain));
}

void OpaquePass::draw(const PassInput& input) const {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  surface_.use();
  set_lighting(surface_, input);
  set_material_units(surface_);
  for (const Instance& instance : input.scene.instances) {
    if (input.assets.is_clear(instance.material)) continue;
    set_model(surface_, instance.X_WM);
    input.assets.use_material(instance.material, surface_);
    input.assets.draw(instance.mesh);
  }
  if (!input.ropes.empty()) {
    glEnable(GL_CULL_FACE);
    rope_.use();
    set_lighting(rope_, input);
    set_model(rope_, Eigen::Affine3f::Identity());
    input.ropes.draw();
  }
  glDisable(GL_CULL_FACE);
  if (!input.scene.ground_height_m) return;
  ground_.use();
  set_lighting(ground_, input);
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  X_WM.translation() = Vec3f(input.view.p_WE.x(), *input.scene.ground_height_m, input.view.p_WE.z());
  set_model(ground_, X_WM);
  plain_.draw(0);
}

}  // namespace mechane::display
