#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {

Expected<CompositePass> CompositePass::create() {
  Expected<Program> program = Program::link({"fullscreen.vert"}, {"composite.frag"});
  if (!program) return tl::unexpected(program.error());
  return CompositePass(std::move(*program), make_vertex_array());
}

void CompositePass::draw(const PictureTarget& left, const PictureTarget& right, picture::Stereo stereo,
                         bool right_eye_first) const {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  program_.use();
  program_.set("left_eye", 0);
  program_.set("right_eye", 1);
  program_.set("rows", stereo == picture::Stereo::row_interleaved ? 1 : 0);
  program_.set("right_rows", right_eye_first ? 0 : 1);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, left.colour.get());
  glActiveTexture(GL_TEXTURE0 + 1);
  glBindTexture(GL_TEXTURE_2D, right.colour.get());
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace mechane::draw
