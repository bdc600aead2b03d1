#include "tests/integration/draw/drawn_picture.hpp"
#include "tests/integration/draw/lamp.hpp"

namespace mechane::draw {
namespace {

double brightest(const picture::ImageData& image, const Eigen::Vector2d& at) {
  double most = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const auto pixel =
          4 * (static_cast<std::size_t>(at.y() + dy) * image.width + static_cast<std::size_t>(at.x() + dx));
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, static_cast<double>(image.rgba[pixel + c]));
    }
  }
  return most;
}

TEST_F(DrawnPicture, what_glares_has_a_glow_and_what_does_not_has_none) {
  const Vec3 p(0.2, -0.1, -2);
  Lamp lamp(p);
  ASSERT_EQ(lamp.assets.materials.size(), 1U);
  // Some 25 pixels beside the middle, outside of the lamp itself.
  const Eigen::Vector2d middle = pixel_of(lamp.scene, p);
  const Eigen::Vector2d beside = middle + Eigen::Vector2d(25, 0);
  const Eigen::Vector2d far = middle + Eigen::Vector2d(-180, 0);
  lamp.assets.materials[0].emissive = Vec3f::Constant(0.9F);
  const picture::ImageData calm = draw(lamp.assets, lamp.scene);
  EXPECT_GT(brightest(calm, middle), 120);
  EXPECT_LT(brightest(calm, beside), 3);
  renderer_->forget_assets();
  lamp.assets.materials[0].emissive = Vec3f::Constant(30);
  const picture::ImageData glaring = draw(lamp.assets, lamp.scene);
  EXPECT_GT(brightest(glaring, beside), 12);
  EXPECT_LT(brightest(glaring, far), 6) << "a glow, not a veil";
  // As far to the left as to the right, above as below.
  const double right = brightest(glaring, beside);
  for (const Eigen::Vector2d& other : {Eigen::Vector2d(-25, 0), Eigen::Vector2d(0, 25), Eigen::Vector2d(0, -25)})
    EXPECT_NEAR(brightest(glaring, middle + other), right, 0.35 * right);
}

/// A wall on a floor, both white, seen from the front, the sun behind the wall.
TEST_F(DrawnPicture, where_a_wall_meets_the_floor_it_is_darker_than_in_the_open) {
  picture::SceneAssets assets;
  assets.meshes.push_back(picture::box_mesh(Vec3(4, 0.05, 4)));
  assets.meshes.push_back(picture::box_mesh(Vec3(4, 1, 0.05)));
  picture::MaterialData white;
  white.base_colour = Eigen::Vector4f(0.6F, 0.6F, 0.6F, 1);
  white.roughness = 1;
  assets.materials.push_back(white);
  picture::RenderScene scene;
  add_instance(scene, 0, 0, Vec3f(0, -0.05F, 0));
  scene.sun.irradiance = Vec3f::Zero();
  scene.camera.p_WC = Vec3(0, 1.2, 3);
  scene.camera.p_WT = Vec3(0, 0.3, 0);
  scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-4, -0.1F, -4), Vec3f(4, 2, 4));
  const auto floor_at = [&](const picture::ImageData& image, double z) {
    const Eigen::Vector2d at = pixel_of(scene, Vec3(0.4, 0, z));
    return mean(image, at.x(), at.y(), 2);
  };
  const picture::ImageData open = draw(assets, scene);
  EXPECT_NEAR(floor_at(open, 0.06), floor_at(open, 1.2), 6) << "an even floor is evenly lit";
  add_instance(scene, 1, 0, Vec3f(0, 1, -0.05F));
  const picture::ImageData with_wall = draw(assets, scene);
  EXPECT_LT(floor_at(with_wall, 0.06), floor_at(open, 0.06) - 12);
  EXPECT_NEAR(floor_at(with_wall, 1.2), floor_at(open, 1.2), 3) << "only near by";
  EXPECT_LT(floor_at(with_wall, 0.06), floor_at(with_wall, 0.25));
}

}  // namespace
}  // namespace mechane::draw
