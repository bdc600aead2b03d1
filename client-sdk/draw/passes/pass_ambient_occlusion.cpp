#include <algorithm>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {

Expected<AmbientOcclusionPass> AmbientOcclusionPass::create() {
  Expected<Program> occlusion = Program::link({"fullscreen.vert"}, {"ambient_occlusion.frag"});
  if (!occlusion) return tl::unexpected(occlusion.error());
  Expected<Program> blur = Program::link({"fullscreen.vert"}, {"ambient_occlusion_blur.frag"});
  if (!blur) return tl::unexpected(blur.error());
  return AmbientOcclusionPass(std::move(*occlusion), std::move(*blur), make_vertex_array());
}

Expected<void> AmbientOcclusionPass::draw(const HdrTarget& from, const picture::EyeView& view) {
  const picture::PixelSize half{std::max((from.size.width + 1) / 2, 1U), std::max((from.size.height + 1) / 2, 1U)};
  for (std::optional<FloatTarget>* target : {&raw_, &even_}) {
    if (*target && (*target)->size == half) continue;
    Expected<FloatTarget> made = FloatTarget::create(half);
    if (!made) return tl::unexpected(made.error());
    target->emplace(std::move(*made));
  }
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(no_vertices_.get());
  raw_->bind();
  occlusion_.use();
  const Eigen::Matrix4f& P = view.P;
  occlusion_.set("depth", 0);
  occlusion_.set("depth_to_m", Eigen::Vector2f(P(2, 2), P(2, 3)));
  occlusion_.set("rays", Eigen::Vector4f(1 / P(0, 0), 1 / P(1, 1), P(0, 2) / P(0, 0), P(1, 2) / P(1, 1)));
  occlusion_.set("pixels_per_m", 0.5F * static_cast<float>(from.size.height) * P(1, 1));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, from.depth_copy.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  even_->bind();
  blur_.use();
  blur_.set("openness", 0);
  glBindTexture(GL_TEXTURE_2D, raw_->colour.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  return {};
}

}  // namespace mechane::draw
