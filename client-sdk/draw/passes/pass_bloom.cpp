#include <algorithm>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {
namespace {

constexpr std::size_t kGlowLevels = 4;

}  // namespace

Expected<BloomPass> BloomPass::create() {
  Expected<Program> bright = Program::link({"fullscreen.vert"}, {"bright.frag"});
  if (!bright) return tl::unexpected(bright.error());
  Expected<Program> blur = Program::link({"fullscreen.vert"}, {"blur.frag"});
  if (!blur) return tl::unexpected(blur.error());
  return BloomPass(std::move(*bright), std::move(*blur), make_vertex_array());
}

Expected<void> BloomPass::fit(picture::PixelSize size) {
  picture::PixelSize level{std::max((size.width + 3) / 4, 1U), std::max((size.height + 3) / 4, 1U)};
  if (!levels_.empty() && levels_.front().size == level) return {};
  levels_.clear();
  for (std::size_t i = 0; i < kGlowLevels; ++i) {
    Expected<FloatTarget> made = FloatTarget::create(level);
    if (!made) return tl::unexpected(made.error());
    levels_.push_back(std::move(*made));
    level = {std::max(level.width / 2, 1U), std::max(level.height / 2, 1U)};
  }
  return {};
}

Expected<void> BloomPass::draw(const HdrTarget& from, float exposure) {
  if (auto ok = fit(from.size); !ok) return ok;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glBindVertexArray(no_vertices_.get());
  levels_.front().bind();
  bright_.use();
  bright_.set("samples", 0);
  bright_.set("sample_count", from.samples);
  bright_.set("exposure", exposure);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, from.colour.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  blur_.use();
  blur_.set("from", 0);
  for (std::size_t i = 1; i < kGlowLevels; ++i)
    blur(levels_[i - 1], levels_[i]);
  // Back up: each level is added to the finer one, so that the glow is narrow and bright in the middle, wide and faint
  // around. The finest level's own content is dropped, because its pixels would be visible.
  glBlendFunc(GL_ONE, GL_ONE);
  for (std::size_t i = kGlowLevels - 1; i > 0; --i) {
    if (i > 1) {
      glEnable(GL_BLEND);
    } else {
      glDisable(GL_BLEND);
    }
    blur(levels_[i], levels_[i - 1]);
  }
  return {};
}

void BloomPass::blur(const FloatTarget& from, const FloatTarget& to) const {
  to.bind();
  blur_.set("reach", 1.0F);
  glBindTexture(GL_TEXTURE_2D, from.colour.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace mechane::draw
