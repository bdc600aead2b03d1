#include <epoxy/gl.h>

#include "client-sdk/display/passes.hpp"

namespace mechane::display {

Expected<TonePass> TonePass::create() {
  Expected<Program> program = Program::link({"fullscreen.vert"}, {"tone.frag"});
  if (!program) return tl::unexpected(program.error());
  return TonePass(std::move(*program), make_vertex_array());
}

void TonePass::draw(const HdrTarget& from, float exposure) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("samples", 0);
  program_.set("sample_count", from.samples);
  program_.set("exposure", exposure);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, from.colour.get());
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace mechane::display
