// Draws an overlay over the bound framebuffer's viewport, in screen colours.
#pragma once

#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/draw/shader.hpp"
#include "client-sdk/draw/text/overlay_layout.hpp"
#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

class OverlayPass {
 public:
  [[nodiscard]] static Expected<OverlayPass> create(const std::string& font_folder);
  /// Lays out all of the scene's words in an eye's picture of this size.
  const OverlayLayout& lay_out(const picture::RenderScene& scene, picture::PixelSize size);
  [[nodiscard]] const OverlayLayout& layout() const { return layout_; }
  /// The last layout.
  void draw();

 private:
  OverlayPass(Program program, std::unique_ptr<Typesetter> typesetter);
  void upload_atlas();

  Program program_;
  std::unique_ptr<Typesetter> typesetter_;
  TextureName atlas_;
  std::uint64_t atlas_revision_ = 0;
  VertexArrayName array_;
  BufferName vertices_;
  OverlayLayout layout_;
};

}  // namespace mechane::draw
