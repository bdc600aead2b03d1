#include "client-sdk/draw/renderer.hpp"

#include "tests/integration/draw/drawn_picture.hpp"
#include "tests/integration/draw/lamp.hpp"

namespace mechane::draw {
namespace {

TEST_F(DrawnPicture, both_eyes_see_a_lamp_where_geometry_says) {
  // Before the screen (crossed), behind it, and in it.
  for (const Vec3& p : {Vec3(0.05, 0.10, -0.8), Vec3(-0.15, -0.20, -3.0), Vec3(0.10, 0.05, -1.5)}) {
    const Lamp lamp(p);
    renderer_->forget_assets();
    const picture::ImageData image = draw(lamp.assets, lamp.scene, picture::Stereo::side_by_side);
    constexpr std::uint32_t kHalf = kSize.width / 2;
    const Blob left = blob(image, {0, 0, kHalf, kSize.height});
    const Blob right = blob(image, {kHalf, 0, kHalf, kSize.height});
    ASSERT_GT(left.weight, 0);
    ASSERT_GT(right.weight, 0);
    const double fov = lamp.scene.camera.field_of_view_rad;
    EXPECT_LT((left.middle - seen_at(p, -0.05, 1.5, fov, kHalf, kSize.height)).norm(), 1.0) << p.transpose();
    EXPECT_LT((right.middle - seen_at(p, 0.05, 1.5, fov, kHalf, kSize.height)).norm(), 1.0) << p.transpose();
    if (p.z() > -1.4) {
      EXPECT_GT(left.middle.x(), right.middle.x() + 5) << "before the screen the left eye sees it further right";
    } else if (p.z() < -1.6) {
      EXPECT_LT(left.middle.x(), right.middle.x() - 3);
    }
  }
}

TEST_F(DrawnPicture, mono_shows_what_lies_between_the_eyes) {
  const Vec3 p(0.2, -0.1, -2);
  const Lamp lamp(p);
  const picture::ImageData image = draw(lamp.assets, lamp.scene);
  const Blob seen = blob(image, {0, 0, kSize.width, kSize.height});
  EXPECT_LT((seen.middle - seen_at(p, 0, 1.5, lamp.scene.camera.field_of_view_rad, kSize.width, kSize.height)).norm(),
            1.0);
}

/// A white ball over a white floor, the sun from the right, seen from the front.
struct Ball {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  Ball() {
    assets.meshes.push_back(picture::sphere_mesh(0.3, 48, 64));
    assets.meshes.push_back(picture::box_mesh(Vec3(4, 0.05, 4)));
    picture::MaterialData white;
    white.base_colour = Eigen::Vector4f(0.6F, 0.6F, 0.6F, 1);
    assets.materials.push_back(white);
    picture::Instance ball;
    ball.X_WM.translation() = Vec3f(0, 0.5F, 0);
    picture::Instance floor;
    floor.mesh = 1;
    floor.X_WM.translation() = Vec3f(0, -0.05F, 0);
    scene.instances = {ball, floor};
    scene.sun.to_sun_W = Vec3f(1, 1, 0).normalized();
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -0.1F, -2), Vec3f(2, 1, 2));
    scene.camera.p_WC = Vec3(0, 1.2, 3);
    scene.camera.p_WT = Vec3(0, 0.4, 0);
  }
  /// Pixel of a point in W.
  [[nodiscard]] Eigen::Vector2d pixel(const Vec3& p_W, picture::PixelSize size) const {
    const picture::EyeView view =
        picture::eye_view(scene.camera, picture::Eye::middle, static_cast<double>(size.width) / size.height);
    const Eigen::Vector4f clip = view.P * view.V_CW * p_W.cast<float>().homogeneous();
    return {(clip.x() / clip.w() * 0.5 + 0.5) * size.width, (0.5 - clip.y() / clip.w() * 0.5) * size.height};
  }
};

TEST_F(DrawnPicture, the_sun_lights_one_side_and_throws_a_shadow_on_the_other) {
  const Ball ball;
  const picture::ImageData image = draw(ball.assets, ball.scene);
  const Eigen::Vector2d lit = ball.pixel(Vec3(0.18, 0.6, 0.2), kSize);
  const Eigen::Vector2d unlit = ball.pixel(Vec3(-0.24, 0.45, 0.15), kSize);
  EXPECT_GT(mean(image, lit.x(), lit.y(), 3), mean(image, unlit.x(), unlit.y(), 3) + 40);
  // The ball's middle falls along the sun's ray to x = -0.5 on the floor.
  const Eigen::Vector2d shadow = ball.pixel(Vec3(-0.55, 0, 0), kSize);
  const Eigen::Vector2d open = ball.pixel(Vec3(0.9, 0, 0), kSize);
  const double dark = mean(image, shadow.x(), shadow.y(), 3);
  EXPECT_LT(dark, mean(image, open.x(), open.y(), 3) - 50);
  EXPECT_GT(dark, 15) << "the sky lights the shadow";

  picture::RenderScene without = ball.scene;
  without.instances[0].casts_shadow = false;
  const picture::ImageData bright = draw(ball.assets, without);
  EXPECT_GT(mean(bright, shadow.x(), shadow.y(), 3), dark + 50);
}

TEST_F(DrawnPicture, metal_mirrors_the_sky_and_is_nowhere_black) {
  Ball ball;
  ball.assets.materials[0].base_colour = Eigen::Vector4f(0.78F, 0.52F, 0.25F, 1);
  ball.assets.materials[0].metallic = 1;
  ball.assets.materials[0].roughness = 0.35F;
  const picture::ImageData image = draw(ball.assets, ball.scene);
  // Even where no sun comes.
  for (const Vec3& p : {Vec3(0.18, 0.6, 0.2), Vec3(-0.24, 0.45, 0.15), Vec3(0, 0.35, 0.25), Vec3(0, 0.75, 0.1)}) {
    const Vec3 seen = colour_at(image, ball.pixel(p, kSize), 2);
    EXPECT_GT(seen.x(), 40) << p.transpose();
    EXPECT_GT(seen.x(), seen.z()) << "bronze tints what it mirrors";
  }
}

TEST_F(DrawnPicture, what_is_near_hides_what_is_far_in_whichever_order) {
  Ball ball;
  picture::MaterialData dark;
  dark.base_colour = Eigen::Vector4f(0.02F, 0.02F, 0.02F, 1);
  dark.roughness = 1;
  ball.assets.materials.push_back(dark);
  picture::Instance behind = ball.scene.instances[0];
  behind.material = 1;
  behind.X_WM.translation() = Vec3f(0, 0.5F, -0.9F);
  for (const bool first : {true, false}) {
    picture::RenderScene scene = ball.scene;
    scene.instances.insert(first ? scene.instances.begin() : scene.instances.end(), behind);
    const picture::ImageData image = draw(ball.assets, scene);
    const Eigen::Vector2d at = ball.pixel(Vec3(0.1, 0.55, 0.28), kSize);
    EXPECT_GT(mean(image, at.x(), at.y(), 2), 90) << first;
  }
}

TEST_F(DrawnPicture, shadows_are_drawn_anew_when_something_moves_and_only_then) {
  Ball ball;
  const picture::ImageData first = draw(ball.assets, ball.scene);
  EXPECT_EQ(draw(ball.assets, ball.scene).rgba, first.rgba);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 1U);
  ball.scene.camera.p_WC.x() += 0.1;
  (void)draw(ball.assets, ball.scene);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 1U) << "who looks throws no shadow";
  ball.scene.camera.p_WC.x() -= 0.1;
  const Eigen::Vector2d shadow = ball.pixel(Vec3(-0.55, 0, 0), kSize);
  const double dark = mean(first, shadow.x(), shadow.y(), 3);
  ball.scene.instances[0].X_WM.translation().z() = -0.9F;
  const picture::ImageData moved = draw(ball.assets, ball.scene);
  EXPECT_GT(mean(moved, shadow.x(), shadow.y(), 3), dark + 50) << "the shadow went with the ball";
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 2U);
  picture::RenderRope rope;
  rope.radius_m = 0.1F;
  rope.points_W = {Vec3f(-1, 0.4F, 0), Vec3f(1, 0.4F, 0)};
  ball.scene.ropes.push_back(rope);
  (void)draw(ball.assets, ball.scene);
  ball.scene.ropes[0].points_W[0].y() = 0.5F;
  (void)draw(ball.assets, ball.scene);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 4U);
  // Other meshes under the same numbers.
  renderer_->forget_assets();
  (void)draw(ball.assets, ball.scene);
  EXPECT_EQ(renderer_->shadow_maps_drawn(), 5U);
}

TEST_F(DrawnPicture, what_is_out_of_sight_still_throws_its_shadow_into_the_picture) {
  Ball ball;
  // Up to the sun's side, above the picture's edge.
  ball.scene.instances[0].X_WM.translation() = Vec3f(1.8F, 2.3F, 0);
  ball.scene.shadow_box_W.extend(Vec3f(2.2F, 2.7F, 0));
  const Eigen::Vector2d where = ball.pixel(Vec3(1.8, 2.3, 0), kSize);
  ASSERT_LT(where.y(), -100);
  const picture::ImageData image = draw(ball.assets, ball.scene);
  const Eigen::Vector2d shadow = ball.pixel(Vec3(-0.5, 0, 0), kSize);
  const Eigen::Vector2d open = ball.pixel(Vec3(0.5, 0, 0), kSize);
  EXPECT_LT(mean(image, shadow.x(), shadow.y(), 3), mean(image, open.x(), open.y(), 3) - 50);
}

TEST_F(DrawnPicture, a_hand_near_a_surface_darkens_it) {
  const Ball ball;
  picture::RenderScene scene = ball.scene;
  scene.instances.erase(scene.instances.begin());
  const picture::ImageData before = draw(ball.assets, scene);
  scene.occluders.push_back({Vec3f(0.4F, 0.06F, 0.3F), 0.05F});
  const picture::ImageData after = draw(ball.assets, scene);
  const Eigen::Vector2d near = ball.pixel(Vec3(0.4, 0, 0.3), kSize);
  const Eigen::Vector2d far = ball.pixel(Vec3(-0.9, 0, 0.3), kSize);
  EXPECT_LT(mean(after, near.x(), near.y(), 2), mean(before, near.x(), near.y(), 2) - 5);
  EXPECT_NEAR(mean(after, far.x(), far.y(), 2), mean(before, far.x(), far.y(), 2), 1);
}

TEST_F(DrawnPicture, words_are_drawn_within_their_panel) {
  picture::RenderScene scene;
  scene.overlay.title = "Ο κοχλίας";
  scene.overlay.caption = "Γυρίστε τη χειρολαβή.";
  scene.overlay.steps_total = 3;
  const picture::ImageData image = draw({}, scene);
  // The panel is dark with bright letters; above it is the sky.
  int bright = 0;
  int dark = 0;
  for (std::uint32_t y = kSize.height - 80; y < kSize.height - 24; ++y) {
    for (std::uint32_t x = 24; x < 300; ++x) {
      bright += brightness(image, x, y) > 200 ? 1 : 0;
      dark += brightness(image, x, y) < 90 ? 1 : 0;
    }
  }
  EXPECT_GT(bright, 150);
  EXPECT_GT(dark, 5000);
}

TEST(GlContext, tells_when_there_is_no_driver) {
  // In a process of its own: EGL looks for drivers once.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json", 1);
        const auto context = make_offscreen_context({64, 64});
        if (!context) std::fputs(context.error().to_string().c_str(), stderr);
        std::_Exit(context ? 1 : 0);
      },
      testing::ExitedWithCode(0), "libegl-mesa0");
}

}  // namespace
}  // namespace mechane::draw
