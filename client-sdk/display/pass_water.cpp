#include <epoxy/gl.h>

#include "client-sdk/display/passes.hpp"
#include "client-sdk/display/procedural_mesh.hpp"

namespace mechane::display {

void begin_blending() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  // Colours come multiplied by their opacity.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void end_blending() {
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
}

WaterPass::WaterPass(Program surface, Program stream)
    : surface_(std::move(surface)), stream_(std::move(stream)), tube_(StreamedMesh::create()) {}

Expected<WaterPass> WaterPass::create() {
  Expected<Program> surface = Program::link({"mesh.vert"}, {"sky.glsl", "lighting.glsl", "water.frag"});
  if (!surface) return tl::unexpected(surface.error());
  Expected<Program> stream = Program::link({"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "stream.frag"});
  if (!stream) return tl::unexpected(stream.error());
  return WaterPass(std::move(*surface), std::move(*stream));
}

void WaterPass::draw(const PassInput& input) {
  const RenderScene& scene = input.scene;
  if (scene.waters.empty() && scene.streams.empty()) return;
  begin_blending();
  surface_.use();
  set_lighting(surface_, input);
  surface_.set("time_s", static_cast<float>(scene.time_s));
  for (const WaterInstance& water : scene.waters) {
    surface_.set("clearness", water.clearness);
    surface_.set("ripple", water.ripple);
    set_model(surface_, water.X_WM);
    input.assets.draw(water.mesh);
  }
  stream_.use();
  set_lighting(stream_, input);
  stream_.set("time_s", static_cast<float>(scene.time_s));
  set_model(stream_, Eigen::Affine3f::Identity());
  for (const WaterStream& stream : scene.streams)
    draw_stream(stream);
  end_blending();
}

void WaterPass::draw_stream(const WaterStream& stream) {
  if (!(stream.width_m > 0)) return;
  // Lumps some four times as long as the jet is thick.
  stream_.set("lumps_per_s", stream.v_W.norm() / (4.5F * stream.width_m));
  stream_.set("broken_s", stream.jet ? jet_breakup_s(stream) : 1e6F);
  tube_.upload(stream_mesh(stream));
  tube_.draw();
}

}  // namespace mechane::display
