// Hollows that a material's image tells of: what light they keep out, and what they do not.
#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

class OcclusionImage : public DrawnPicture {
 protected:
  /// A ball half metal, half not so, of which an image says that so much of the sky arrives: 0..255. None: no image.
  picture::ImageData ball(std::optional<std::uint8_t> red, float strength, bool sun, bool sky) {
    picture::SceneAssets assets;
    assets.meshes.push_back(picture::sphere_mesh(0.5, 48, 64));
    picture::MaterialData stone;
    stone.base_colour = Eigen::Vector4f(0.6F, 0.6F, 0.6F, 1);
    stone.metallic = 0.5F;
    stone.roughness = 0.4F;
    stone.occlusion_strength = strength;
    if (red) {
      assets.images.push_back({1, 1, {*red, 7, 7, 7}, false});
      stone.occlusion_image = 0;
    }
    assets.materials.push_back(stone);
    picture::RenderScene scene;
    add_instance(scene, 0, 0, Vec3f::Zero());
    scene.camera.p_WC = Vec3(0, 0, 2.5);
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f::Constant(-1), Vec3f::Constant(1));
    scene.sun.to_sun_W = Vec3f(1, 1, 1).normalized();
    if (!sun) scene.sun.irradiance = Vec3f::Zero();
    scene.sky = sky;
    renderer_->forget_assets();
    return draw(assets, scene);
  }
  static double middle(const picture::ImageData& image) {
    return mean(image, kSize.width / 2.0, kSize.height / 2.0, 40);
  }
};

TEST_F(OcclusionImage, keeps_out_the_sky_and_never_the_sun) {
  const double open = middle(ball({}, 1, false, true));
  EXPECT_GT(open, 60);
  EXPECT_LT(middle(ball(std::uint8_t{0}, 1, false, true)), 2) << "neither seen on it nor mirrored";
  const picture::ImageData sunlit = ball({}, 1, true, false);
  EXPECT_GT(middle(sunlit), 60);
  EXPECT_EQ(ball(std::uint8_t{0}, 1, true, false).rgba, sunlit.rgba);
}

TEST_F(OcclusionImage, counts_by_its_red_and_its_strength) {
  const picture::ImageData open = ball({}, 1, true, true);
  EXPECT_EQ(ball(std::uint8_t{255}, 1, true, true).rgba, open.rgba) << "other channels are another image's";
  EXPECT_EQ(ball(std::uint8_t{0}, 0, true, true).rgba, open.rgba);
  // Half as a number, not as a colour.
  const double half = middle(ball(std::uint8_t{128}, 1, false, true));
  EXPECT_NEAR(half, middle(ball(std::uint8_t{0}, 127 / 255.0F, false, true)), 0.5);
  EXPECT_LT(half, 0.9 * middle(ball({}, 1, false, true)));
}

}  // namespace
}  // namespace mechane::draw
