#include "client-sdk/scene/hand_model.hpp"
#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

/// A hand over a pale table, seen from a visitor's place, near.
struct HandScene {
  scene::AssetLibrary assets{[](const std::string&) -> Expected<content::ImportedScene> {
    return fail(ErrorCode::not_found, "none", "", "");
  }};
  scene::HandModel model{assets};
  picture::RenderScene scene;
  client::HandPose hand;

  HandScene() {
    picture::MaterialData pale;
    pale.base_colour = Eigen::Vector4f(0.45F, 0.42F, 0.38F, 1);
    const std::uint32_t material = assets.add_material(pale);
    add_instance(scene, assets.add_mesh(picture::box_mesh(Vec3(1, 0.02, 1))), material, Vec3f(0, -0.02F, 0));
    scene.camera.p_WC = Vec3(0.05, 0.45, 0.6);
    scene.camera.p_WT = Vec3(0.02, 0.05, 0);
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-1, -0.1F, -1), Vec3f(1, 0.4F, 1));
    scene.focus_box_W = Eigen::AlignedBox3f(Vec3f(-0.3F, -0.1F, -0.3F), Vec3f(0.3F, 0.3F, 0.3F));
    hand.X_WS[0].p = Vec3(0, 0.06, 0);
  }
  void add_hand() { model.draw(hand, scene.camera, scene); }
};

TEST_F(DrawnPicture, a_hand_is_drawn_about_its_tip_and_throws_a_shadow) {
  for (const bool holding : {false, true}) {
    HandScene with;
    with.hand.holding = holding;
    with.add_hand();
    const picture::ImageData picture = draw(with.assets.assets(), with.scene);
    const scene::SegmentPoses X_WS = scene::hand_at_tip(with.hand.X_WS[0].p, holding, with.scene.camera);
    // Straight along the sun's ray from the middle of the hand on the table.
    const Vec3f sun = with.scene.sun.to_sun_W.normalized();
    const Vec3f palm = X_WS[0].p.cast<float>();
    const Vec3f fallen = palm - sun * (palm.y() / sun.y());
    with.scene.soft_bodies.clear();
    with.scene.instances.resize(1);
    const picture::ImageData without = draw(with.assets.assets(), with.scene);
    const Eigen::Vector2d at = pixel_of(with.scene, fallen.cast<double>());
    EXPECT_LT(mean(picture, at.x(), at.y(), 1), mean(without, at.x(), at.y(), 1) - 15);
    // The palm, and a finger on the way to the tip.
    for (const Vec3& p : {X_WS[0].p, X_WS[4].p, X_WS[5].p}) {
      const Eigen::Vector2d there = pixel_of(with.scene, p);
      EXPECT_GT((colour_at(picture, there) - colour_at(without, there)).norm(), 30) << p.transpose();
    }
    renderer_->forget_assets();
  }
}

TEST_F(DrawnPicture, a_hand_looks_as_it_is_asked_to) {
  std::vector<float> bright;
  for (const auto& [name, look] : scene::hand_look_names()) {
    ASSERT_EQ(scene::hand_look_of(name), look);
    HandScene with;
    with.model.wear(look);
    with.add_hand();
    const picture::ImageData picture = draw(with.assets.assets(), with.scene);
    const scene::SegmentPoses X_WS = scene::hand_at_tip(with.hand.X_WS[0].p, false, with.scene.camera);
    const Eigen::Vector2d back = pixel_of(with.scene, X_WS[0].p);
    bright.push_back(static_cast<float>(mean(picture, back.x(), back.y(), 2)));
    renderer_->forget_assets();
  }
  EXPECT_FALSE(scene::hand_look_of("green"));
  ASSERT_EQ(bright.size(), 4U);
  EXPECT_GT(bright[0], bright[1] + 8) << "light";
  EXPECT_GT(bright[1], bright[2] + 30) << "medium, dark";
  EXPECT_GT(bright[3], bright[1] + 15) << "white cotton";
}

}  // namespace
}  // namespace mechane::draw
