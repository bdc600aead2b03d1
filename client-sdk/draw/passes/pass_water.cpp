#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"
#include "client-sdk/draw/passes/water_mirror.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::draw {
namespace {

constexpr int kDepthOfSolidUnit = 5;
constexpr int kMirrorUnit = 1;

}  // namespace

void begin_blending() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  // Colours are premultiplied by their opacity.
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void end_blending() {
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
}

WaterPass::WaterPass(Program surface, Program stream)
    : surface_(std::move(surface)), stream_(std::move(stream)), tube_(StreamedMesh::create()) {}

Expected<WaterPass> WaterPass::create(Shading shading) {
  Expected<Program> surface =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "water.frag"});
  if (!surface) return tl::unexpected(surface.error());
  Expected<Program> stream =
      Program::link(shading, {"mesh.vert"}, {"sky.glsl", "lighting.glsl", "noise.glsl", "stream.frag"});
  if (!stream) return tl::unexpected(stream.error());
  return WaterPass(std::move(*surface), std::move(*stream));
}

void WaterPass::draw(const PassInput& input) {
  const picture::RenderScene& scene = input.scene;
  if (scene.waters.empty() && scene.streams.empty()) return;
  begin_blending();
  draw_surfaces(input);
  stream_.use();
  set_lighting(stream_, input);
  stream_.set("time_s", static_cast<float>(scene.time_s));
  set_model(stream_, Eigen::Affine3f::Identity());
  for (const picture::WaterStream& stream : scene.streams)
    draw_stream(stream);
  end_blending();
}

void WaterPass::draw_surfaces(const PassInput& input) const {
  surface_.use();
  set_lighting(surface_, input);
  surface_.set("time_s", static_cast<float>(input.scene.time_s));
  surface_.set("depth", kDepthOfSolidUnit);
  surface_.set("depth_to_m", Eigen::Vector2f(input.view.P(2, 2), input.view.P(2, 3)));
  glActiveTexture(GL_TEXTURE0 + kDepthOfSolidUnit);
  glBindTexture(GL_TEXTURE_2D, input.depth_of_solid.get());
  surface_.set("mirror", kMirrorUnit);
  glActiveTexture(GL_TEXTURE0 + kMirrorUnit);
  glBindTexture(GL_TEXTURE_2D, input.mirror ? input.mirror->picture->get() : 0);
  for (const picture::WaterInstance& water : input.scene.waters) {
    const std::optional<float> level = level_m(water, input.assets);
    surface_.set("mirrors", input.mirror && level && is_same_level(*level, input.mirror->height_m) ? 1 : 0);
    surface_.set("clearness", water.clearness);
    surface_.set("ripple", water.ripple);
    surface_.set("flow", Eigen::Vector2f(water.flow_W.x(), water.flow_W.z()));
    surface_.set("width_m", water.width_m);
    set_model(surface_, water.X_WM);
    input.assets.draw(water.mesh);
  }
}

void WaterPass::draw_stream(const picture::WaterStream& stream) {
  if (!(stream.width_m > 0)) return;
  // Lumps are about four times as long as the jet is thick.
  stream_.set("lumps_per_s", stream.v_W.norm() / (4.5F * stream.width_m));
  stream_.set("broken_s", stream.jet ? picture::jet_breakup_s(stream) : 1e6F);
  tube_.upload(picture::stream_mesh(stream));
  tube_.draw();
}

}  // namespace mechane::draw
