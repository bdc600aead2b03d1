// What a display may be asked to draw, and survives.
#include <algorithm>

#include <gmock/gmock.h>

#include "tests/integration/display/drawn_picture.hpp"

namespace mechane::display {
namespace {

/// White boxes in rows before the eye, each of some pixels.
RenderScene many_boxes(int columns, int rows) {
  RenderScene scene;
  scene.camera.p_WC = Vec3(0, 0, 3);
  scene.camera.p_WT = Vec3(0, 0, 0);
  scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -1, -0.2F), Vec3f(2, 1, 0.2F));
  for (int i = 0; i < columns * rows; ++i) {
    const auto at = [](int k, int of) { return 2 * (static_cast<float>(k) + 0.5F) / static_cast<float>(of) - 1; };
    add_instance(scene, 0, 0, Vec3f(1.6F * at(i % columns, columns), 0.9F * at(i / columns, rows), 0));
  }
  return scene;
}

SceneAssets one_box(double half_m) {
  SceneAssets assets;
  assets.meshes.push_back(box_mesh(Vec3::Constant(half_m)));
  MaterialData glowing;
  glowing.emissive = Vec3f(1, 1, 1);
  assets.materials.push_back(glowing);
  return assets;
}

TEST_F(DrawnPicture, a_size_that_the_driver_does_not_have_is_refused_and_the_next_is_drawn) {
  const SceneAssets assets = one_box(0.5);
  const RenderScene scene = many_boxes(1, 1);
  renderer_->upload(assets);
  for (const Stereo stereo : {Stereo::mono, Stereo::anaglyph}) {
    const Expected<void> drawn = renderer_->draw(scene, stereo, {1'000'000, 16});
    ASSERT_FALSE(drawn.has_value());
    EXPECT_THAT(drawn.error().remedy, testing::HasSubstr("smaller --size"));
    const ImageData picture = draw(assets, scene, stereo);
    EXPECT_GT(mean(picture, kSize.width / 2.0, kSize.height / 2.0, 3), 200);
  }
}

TEST_F(DrawnPicture, ten_thousand_objects_are_all_drawn) {
  const ImageData picture = draw(one_box(0.008), many_boxes(125, 80));
  // Each box is an island of light of more than two pixels: its middle pixel is all light.
  const RenderScene scene = many_boxes(125, 80);
  int lit = 0;
  for (const Instance& box : scene.instances) {
    const Eigen::Vector2d at = pixel_of(scene, box.X_WM.translation().cast<double>());
    lit += brightness(picture, at.x(), at.y()) > 200 ? 1 : 0;
  }
  EXPECT_EQ(lit, 10'000);
}

}  // namespace
}  // namespace mechane::display
