#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {

Expected<TonePass> TonePass::create() {
  Expected<Program> program = Program::link({"fullscreen.vert"}, {"tone.glsl", "tone.frag"});
  if (!program) return tl::unexpected(program.error());
  return TonePass(std::move(*program), make_vertex_array());
}

void TonePass::draw(const HdrTarget& from, float exposure, const Extras& extras) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("samples", 0);
  program_.set("sample_count", from.samples);
  program_.set("exposure", exposure);
  program_.set("bloom", 1);
  program_.set("openness", 2);
  program_.set("bloom_share", extras.glow != nullptr ? extras.glow_share : 0.0F);
  program_.set("occlusion_share", extras.openness != nullptr ? extras.occlusion_share : 0.0F);
  int unit = 1;
  for (const TextureName* texture : {extras.glow, extras.openness}) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit++));
    if (texture != nullptr) glBindTexture(GL_TEXTURE_2D, texture->get());
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, from.colour.get());
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace mechane::draw
