// Draws an overlay over the bound framebuffer's viewport, in screen colours.
#pragma once

#include "client-sdk/display/gl_object.hpp"
#include "client-sdk/display/overlay_layout.hpp"
#include "client-sdk/display/shader.hpp"

namespace mechane::display {

class OverlayPass {
 public:
  [[nodiscard]] static Expected<OverlayPass> create(const std::string& font_folder);
  void draw(const RenderScene& scene, PixelSize size);
  /// What was drawn last, and where.
  [[nodiscard]] const OverlayLayout& layout() const { return layout_; }

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

}  // namespace mechane::display
