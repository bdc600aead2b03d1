#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {

Expected<SkyPass> SkyPass::create(Shading shading) {
  Expected<Program> program =
      Program::link(shading, {"fullscreen.vert"}, {"sky.glsl", "noise.glsl", "clouds.glsl", "sky.frag"});
  if (!program) return tl::unexpected(program.error());
  return SkyPass(std::move(*program), make_vertex_array());
}

void SkyPass::draw(const PassInput& input) const {
  if (!input.scene.sky) return;
  glEnable(GL_DEPTH_TEST);
  // The triangle lies at the far plane, like the cleared depth.
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  if (input.low) set_low_light(program_, *input.low);
  program_.set("to_sun", Vec3f(input.scene.sun.to_sun_W.normalized()));
  Eigen::Matrix4f R_CW = Eigen::Matrix4f::Identity();
  R_CW.topLeftCorner<3, 3>() = input.view.V_CW.topLeftCorner<3, 3>();
  const Eigen::Matrix4f R_WP = (input.view.P * R_CW).inverse();
  program_.set("R_WP", R_WP);
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace mechane::draw
