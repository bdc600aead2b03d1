// Renders a scene offscreen and measures the picture.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/renderer.hpp"
#include "client-sdk/picture/image_file.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::draw {

/// One more thing in a scene, upright.
inline void add_instance(picture::RenderScene& scene, std::uint32_t mesh, std::uint32_t material, const Vec3f& p_W) {
  picture::Instance instance;
  instance.mesh = mesh;
  instance.material = material;
  instance.X_WM.translation() = p_W;
  scene.instances.push_back(instance);
}

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

  picture::ImageData draw(const picture::SceneAssets& assets, const picture::RenderScene& scene,
                          picture::Stereo stereo = picture::Stereo::mono) {
    renderer_->upload(assets);
    const Expected<void> drawn = renderer_->draw(scene, stereo, kSize);
    EXPECT_TRUE(drawn.has_value()) << drawn.error().to_string();
    picture::ImageData picture = renderer_->read_picture();
    keep(picture);
    return picture;
  }

  /// For eyes: writes the picture into the folder MECHANE_TEST_PICTURES, where that is set.
  void keep(const picture::ImageData& picture) {
    const char* folder = std::getenv("MECHANE_TEST_PICTURES");
    if (folder == nullptr) return;
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const Expected<void> written =
        picture::write_png(picture, std::string(folder) + "/" + test->name() + "-" + std::to_string(++kept_) + ".png");
    EXPECT_TRUE(written.has_value()) << written.error().to_string();
  }

  /// 0..255, of the pixel's green.
  static double brightness(const picture::ImageData& image, double x, double y) {
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    return image.rgba[4 * (row * image.width + column) + 1];
  }

  /// Mean over a square of side 2 r + 1.
  static double mean(const picture::ImageData& image, double x, double y, int r) {
    double sum = 0;
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx)
        sum += brightness(image, x + dx, y + dy);
    }
    return sum / ((2 * r + 1) * (2 * r + 1));
  }

  /// Pixel of a point in W, as the middle eye sees it.
  static Eigen::Vector2d pixel_of(const picture::RenderScene& scene, const Vec3& p_W) {
    const picture::EyeView view =
        picture::eye_view(scene.camera, picture::Eye::middle, static_cast<double>(kSize.width) / kSize.height);
    const Eigen::Vector4f clip = view.P * view.V_CW * p_W.cast<float>().homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * kSize.width, (0.5 - clip.y() / clip.w() * 0.5) * kSize.height};
  }

  /// Red, green, blue, 0..255; the mean over a square of side 2 r + 1.
  static Vec3 colour_at(const picture::ImageData& image, const Eigen::Vector2d& at, int r = 0) {
    Vec3 sum = Vec3::Zero();
    for (int dy = -r; dy <= r; ++dy) {
      for (int dx = -r; dx <= r; ++dx) {
        const auto pixel =
            4 * (static_cast<std::size_t>(at.y() + dy) * image.width + static_cast<std::size_t>(at.x() + dx));
        sum += Vec3(image.rgba[pixel], image.rgba[pixel + 1], image.rgba[pixel + 2]);
      }
    }
    return sum / ((2 * r + 1) * (2 * r + 1));
  }

  static constexpr picture::PixelSize kSize{640, 360};
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<Renderer> renderer_;

 private:
  int kept_ = 0;
};

}  // namespace mechane::draw
