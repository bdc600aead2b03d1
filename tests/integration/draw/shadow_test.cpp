#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

/// A wide white floor; a ball where a hand would be, a wall far behind it, seen along its length. The sun stands on the right, at 45 degrees.
struct NearAndFar {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  NearAndFar() {
    assets.meshes.push_back(picture::box_mesh(Vec3(60, 0.05, 60)));
    assets.meshes.push_back(picture::sphere_mesh(0.05, 24, 32));
    assets.meshes.push_back(picture::box_mesh(Vec3(0.6, 2, 6)));
    picture::MaterialData white;
    white.base_colour = Eigen::Vector4f(0.5F, 0.5F, 0.5F, 1);
    white.roughness = 1;
    assets.materials.push_back(white);
    add_instance(scene, 0, 0, Vec3f(0, -0.05F, 0));
    add_instance(scene, 1, 0, Vec3f(0, 0.10F, 0));
    add_instance(scene, 2, 0, Vec3f(3, 2, -30));
    scene.sun.to_sun_W = Vec3f(1, 1, 0).normalized();
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-60, -0.1F, -60), Vec3f(60, 5, 60));
    scene.focus_box_W = Eigen::AlignedBox3f(Vec3f(-0.5F, 0, -0.5F), Vec3f(0.5F, 0.5F, 0.5F));
    scene.camera.p_WC = Vec3(0, 1.0, 1.6);
    scene.camera.p_WT = Vec3(0, 0.6, 0);
  }
};

class ShadowPicture : public DrawnPicture {
 protected:
  /// How many pixels a row takes from nearly full light to nearly full shadow, going left from p_W.
  static int edge_pixels(const picture::ImageData& image, const picture::RenderScene& scene, const Vec3& lit_W,
                         const Vec3& dark_W) {
    const Eigen::Vector2d from = pixel_of(scene, lit_W);
    const Eigen::Vector2d to = pixel_of(scene, dark_W);
    const double light = mean(image, from.x(), from.y(), 1);
    const double dark = mean(image, to.x(), to.y(), 1);
    EXPECT_LT(dark, light - 40) << "there is a shadow";
    int between = 0;
    const int steps = static_cast<int>((to - from).norm());
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector2d at = from + (to - from) * i / steps;
      const double share = (brightness(image, at.x(), at.y()) - dark) / (light - dark);
      between += share > 0.15 && share < 0.85 ? 1 : 0;
    }
    return between;
  }
};

TEST_F(ShadowPicture, what_is_near_and_what_is_far_throws_one) {
  const NearAndFar with;
  const picture::ImageData image = draw(with.assets, with.scene);
  picture::RenderScene none = with.scene;
  for (picture::Instance& instance : none.instances)
    instance.casts_shadow = false;
  const picture::ImageData bright = draw(with.assets, none);
  // The ball's middle falls to x = -0.1; the wall's shadow begins at its foot and is four metres wide.
  for (const Vec3& p : {Vec3(-0.1, 0, 0), Vec3(1.0, 0, -30), Vec3(-0.2, 0, -30)}) {
    const Eigen::Vector2d at = pixel_of(with.scene, p);
    EXPECT_LT(mean(image, at.x(), at.y(), 1), mean(bright, at.x(), at.y(), 1) - 40) << p.transpose();
  }
  for (const Vec3& p : {Vec3(-0.3, 0, 0), Vec3(-0.1, 0, 0.2), Vec3(-3.0, 0, -30)}) {
    const Eigen::Vector2d at = pixel_of(with.scene, p);
    EXPECT_NEAR(mean(image, at.x(), at.y(), 1), mean(bright, at.x(), at.y(), 1), 4) << p.transpose();
  }
}

TEST_F(ShadowPicture, on_light_ground_it_is_cool_and_not_blue) {
  NearAndFar floor;
  // Limestone, and the wall's shadow on it.
  floor.assets.materials[0].base_colour = Eigen::Vector4f(0.60F, 0.57F, 0.50F, 1);
  const picture::ImageData image = draw(floor.assets, floor.scene);
  const Vec3 shadow = colour_at(image, pixel_of(floor.scene, Vec3(1.0, 0, -30)), 1);
  const Vec3 lit = colour_at(image, pixel_of(floor.scene, Vec3(-3.0, 0, -30)), 1);
  EXPECT_LT(shadow.y(), lit.y() - 40) << "there is a shadow";
  EXPECT_LT(shadow.z() / shadow.x(), 1.55) << "as displayed: " << shadow.transpose();
  EXPECT_GT(shadow.z() / shadow.x(), lit.z() / lit.x()) << "only the sky lights it";
}

TEST_F(ShadowPicture, edges_are_softer_the_higher_up_they_come_from) {
  NearAndFar board;
  board.assets.meshes.push_back(picture::box_mesh(Vec3(0.4, 0.01, 0.4)));
  board.scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -0.1F, -2), Vec3f(6, 5, 2));
  std::vector<int> widths;
  for (const float height : {0.1F, 2.5F}) {
    board.scene.instances.resize(1);
    // Wherever it hangs, its shadow's right edge lies at x = 0.2 and its middle at x = -0.2.
    add_instance(board.scene, 3, 0, Vec3f(-0.2F + height, height, -0.2F));
    const picture::ImageData image = draw(board.assets, board.scene);
    widths.push_back(edge_pixels(image, board.scene, Vec3(0.36, 0, 0.05), Vec3(0.04, 0, 0.05)));
  }
  EXPECT_LE(widths[0], 3) << "at the table it is sharp";
  EXPECT_GE(widths[1], widths[0] + 3);
}

TEST_F(ShadowPicture, only_maps_in_which_something_moved_are_drawn_anew) {
  NearAndFar moving;
  (void)draw(moving.assets, moving.scene);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 3U);
  moving.scene.instances[1].X_WM.translation().x() += 0.02F;
  (void)draw(moving.assets, moving.scene);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 4U) << "the ball's shadow is in the sharpest alone";
  moving.scene.camera.p_WC.x() += 0.3;
  (void)draw(moving.assets, moving.scene, picture::Stereo::side_by_side);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 4U) << "eyes throw none";
}

TEST_F(ShadowPicture, a_camera_that_moves_takes_no_shadow_along) {
  NearAndFar scene;
  // Where the ball's shadow ends on the floor, going left from its middle: the same place from wherever one looks.
  const auto edge_x = [&](const picture::ImageData& image) {
    for (double x = -0.1; x > -0.3; x -= 0.001) {
      const Eigen::Vector2d at = pixel_of(scene.scene, Vec3(x, 0, 0));
      if (brightness(image, at.x(), at.y()) > 135) return x;
    }
    return 1.0;
  };
  std::vector<double> edges;
  for (const double shift : {0.0, 0.003, 0.007, 0.011}) {
    scene.scene.camera.p_WC = Vec3(shift, 1.0, 1.6);
    scene.scene.camera.p_WT = Vec3(shift, 0.6, 0);
    edges.push_back(edge_x(draw(scene.assets, scene.scene)));
  }
  for (const double edge : edges) {
    EXPECT_LT(edge, -0.12) << "found, beyond the middle";
    EXPECT_NEAR(edge, edges[0], 0.005) << "within a pixel, which is 4 mm there";
  }
}

}  // namespace
}  // namespace mechane::draw
