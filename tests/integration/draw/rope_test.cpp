#include <cmath>

#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

/// Grey floor, looked at from the front; z towards the eye.
struct RopeYard {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  RopeYard() {
    assets.meshes.push_back(picture::box_mesh(Vec3(4, 0.05, 4)));
    picture::MaterialData grey;
    grey.base_colour = Eigen::Vector4f(0.5F, 0.5F, 0.5F, 1);
    assets.materials.push_back(grey);
    picture::Instance floor;
    floor.X_WM.translation() = Vec3f(0, -0.05F, 0);
    scene.instances = {floor};
    scene.sun.to_sun_W = Vec3f(0.3F, 1, 0.4F).normalized();
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-1, -0.1F, -1), Vec3f(1, 1, 1));
    scene.camera.p_WC = Vec3(0, 0.8, 1.6);
    scene.camera.p_WT = Vec3(0, 0.35, 0);
  }
};

/// Hemp is warm; the sky is not, and the floor is grey.
bool is_hemp(const Vec3& colour) {
  return colour.x() > 1.25 * colour.z();
}

TEST_F(DrawnPicture, a_rope_hangs_where_its_points_are_and_throws_a_shadow) {
  RopeYard yard;
  const picture::ImageData bare = draw(yard.assets, yard.scene);
  picture::RenderRope rope;
  rope.radius_m = 0.03F;
  for (int i = 0; i <= 40; ++i) {
    const float x = -0.8F + 0.04F * static_cast<float>(i);
    rope.points_W.emplace_back(x, 0.35F + 0.25F * x * x, 0.0F);
  }
  yard.scene.ropes.push_back(rope);
  const picture::ImageData hung = draw(yard.assets, yard.scene);
  for (const float x : {-0.5F, 0.0F, 0.4F}) {
    const Vec3 p(x, 0.35 + 0.25 * x * x, 0.03);
    EXPECT_TRUE(is_hemp(colour_at(hung, pixel_of(yard.scene, p), 1))) << x;
    EXPECT_FALSE(is_hemp(colour_at(hung, pixel_of(yard.scene, p + Vec3(0, 0.06, 0)), 1))) << x;
    EXPECT_FALSE(is_hemp(colour_at(bare, pixel_of(yard.scene, p), 1))) << x;
    // Along the sun's ray to the floor.
    const Vec3 ray = yard.scene.sun.to_sun_W.cast<double>();
    const Vec3 axis = p - Vec3(0, 0, 0.03);
    const Eigen::Vector2d shadow = pixel_of(yard.scene, axis - ray * axis.y() / ray.y());
    EXPECT_LT(mean(hung, shadow.x(), shadow.y(), 1), mean(bare, shadow.x(), shadow.y(), 1) - 40) << x;
  }
}

TEST_F(DrawnPicture, a_rope_is_as_thick_in_its_sharpest_bend_as_elsewhere) {
  RopeYard yard;
  yard.scene.camera.p_WC = Vec3(0, 0.5, 1.6);
  yard.scene.camera.p_WT = Vec3(0, 0.5, 0);
  picture::RenderRope rope;
  rope.radius_m = 0.04F;
  // A right angle, one of 150 degrees, and one that doubles back.
  rope.points_W = {Vec3f(-0.7F, 0.2F, 0),   Vec3f(-0.7F, 0.7F, 0), Vec3f(-0.1F, 0.7F, 0), Vec3f(-0.1F, 0.7F, 0),
                   Vec3f(-0.53F, 0.45F, 0), Vec3f(0.5F, 0.45F, 0), Vec3f(0.5F, 0.8F, 0),  Vec3f(0.5F, 0.3F, 0)};
  yard.scene.ropes.push_back(rope);
  const picture::ImageData image = draw(yard.assets, yard.scene);
  // The way through the rope along the line that halves each bend, from well inside the bend to well outside.
  const double metre = pixel_of(yard.scene, Vec3(1, 0.5, 0)).x() - pixel_of(yard.scene, Vec3(0, 0.5, 0)).x();
  const auto thickness = [&](const Vec3& from, const Vec3& to) {
    const int steps = 400;
    int inside = 0;
    for (int i = 0; i <= steps; ++i) {
      const Vec3 p = from + (to - from) * i / steps;
      inside += is_hemp(colour_at(image, pixel_of(yard.scene, p))) ? 1 : 0;
    }
    return inside * (to - from).norm() / steps;
  };
  const double pixel_m = 1.5 / metre;
  const double straight = thickness(Vec3(-0.4, 0.58, 0), Vec3(-0.4, 0.82, 0));
  EXPECT_NEAR(straight, 0.08, 2 * pixel_m);
  const Vec3 out(-std::sqrt(0.5), std::sqrt(0.5), 0);
  EXPECT_GT(thickness(Vec3(-0.7, 0.7, 0) - 0.2 * out, Vec3(-0.7, 0.7, 0) + 0.1 * out), straight - pixel_m);
  const Vec3 sharp = Vec3(std::cos(0.26), std::sin(0.26), 0);
  EXPECT_GT(thickness(Vec3(-0.1, 0.7, 0) - 0.16 * sharp, Vec3(-0.1, 0.7, 0) + 0.1 * sharp), straight - pixel_m);
  EXPECT_NEAR(thickness(Vec3(0.4, 0.70, 0), Vec3(0.6, 0.70, 0)), straight, 2 * pixel_m);
}

TEST_F(DrawnPicture, points_that_repeat_or_are_none_leave_the_picture_whole) {
  RopeYard yard;
  const picture::ImageData bare = draw(yard.assets, yard.scene);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  yard.scene.ropes.push_back({std::vector<Vec3f>(200, Vec3f(0, 0.3F, 0)), 0.03F});
  yard.scene.ropes.push_back({{Vec3f(nan, 0, 0), Vec3f(0, nan, 0)}, 0.03F});
  EXPECT_EQ(draw(yard.assets, yard.scene).rgba, bare.rgba);
}

}  // namespace
}  // namespace mechane::draw
