// Renders a scene offscreen and measures the picture.
#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "client-sdk/display/gl_context.hpp"
#include "client-sdk/display/procedural_mesh.hpp"
#include "client-sdk/display/renderer.hpp"

namespace mechane::display {

class DrawnPicture : public testing::Test {
 protected:
  void SetUp() override {
    auto context = make_offscreen_context(kSize);
    ASSERT_TRUE(context.has_value()) << context.error().to_string();
    context_ = std::move(*context);
    RendererSettings settings;
    settings.shadow_map_size = 1024;
    auto renderer = Renderer::create(settings);
    ASSERT_TRUE(renderer.has_value()) << renderer.error().to_string();
    renderer_ = std::move(*renderer);
  }
  // The renderer's objects go before their context.
  void TearDown() override {
    renderer_.reset();
    context_.reset();
  }

  ImageData draw(const SceneAssets& assets, const RenderScene& scene, Stereo stereo = Stereo::mono) {
    renderer_->upload(assets);
    const Expected<void> drawn = renderer_->draw(scene, stereo, kSize);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().to_string();
    return renderer_->read_picture();
  }

  /// 0..255, of the pixel's green.
  static double brightness(const ImageData& image, double x, double y) {
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    return image.rgba[4 * (row * image.width + column) + 1];
  }

  /// Mean over a square of side 2 r + 1.
  static double mean(const ImageData& image, double x, double y, int r) {
    double sum = 0;
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx)
        sum += brightness(image, x + dx, y + dy);
    }
    return sum / ((2 * r + 1) * (2 * r + 1));
  }

  static constexpr PixelSize kSize{640, 360};
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace mechane::display
