#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

constexpr std::uint32_t kRed = 0;
constexpr std::uint32_t kBlue = 1;
constexpr std::uint32_t kWhite = 2;

/// Panes that face the eye, one behind the other, before a white wall. Index 0 of the meshes is a pane, 1 the wall, 2 the floor.
struct Panes {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  Panes() {
    assets.meshes = {picture::box_mesh(Vec3(0.4, 0.4, 0.004)), picture::box_mesh(Vec3(3, 3, 0.05)),
                     picture::box_mesh(Vec3(3, 0.05, 3))};
    for (const Vec3f& colour : {Vec3f(0.9F, 0.05F, 0.05F), Vec3f(0.05F, 0.05F, 0.9F), Vec3f(0.6F, 0.6F, 0.6F)}) {
      picture::MaterialData material;
      material.base_colour = Eigen::Vector4f(colour.x(), colour.y(), colour.z(), 0.75F);
      material.clear = true;
      assets.materials.push_back(material);
    }
    assets.materials[kWhite].base_colour.w() = 1;
    assets.materials[kWhite].clear = false;
    add(1, kWhite, Vec3f(0, 1, -1));
    scene.sun.to_sun_W = Vec3f(0.4F, 0.8F, 1).normalized();
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -1, -2), Vec3f(2, 2, 2));
    scene.camera.p_WC = Vec3(0, 1, 3);
    scene.camera.p_WT = Vec3(0, 1, 0);
  }
  void add(std::uint32_t mesh, std::uint32_t material, const Vec3f& p_W) { add_instance(scene, mesh, material, p_W); }
};

TEST_F(DrawnPicture, what_stands_behind_glass_is_seen_through_it) {
  Panes panes;
  panes.assets.materials[kRed].base_colour = Eigen::Vector4f(0.8F, 0.88F, 0.9F, 0.14F);
  const Vec3 p(0, 1, 0);
  const Vec3 wall = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, p), 2);
  panes.add(0, kRed, p.cast<float>());
  const picture::ImageData image = draw(panes.assets, panes.scene);
  const Vec3 through = colour_at(image, pixel_of(panes.scene, p), 2);
  EXPECT_LT((through - wall).norm(), 45) << "the wall is seen";
  EXPECT_GT((through - wall).norm(), 3) << "so is the pane";
}

TEST_F(DrawnPicture, panes_cover_each_other_in_the_order_of_their_distance) {
  for (const bool red_first : {true, false}) {
    Panes panes;
    // Red stands before blue, whichever is named first.
    if (red_first) panes.add(0, kRed, Vec3f(0, 1, 0.5F));
    panes.add(0, kBlue, Vec3f(0, 1, 0));
    if (!red_first) panes.add(0, kRed, Vec3f(0, 1, 0.5F));
    const picture::ImageData image = draw(panes.assets, panes.scene);
    const Vec3 seen = colour_at(image, pixel_of(panes.scene, Vec3(0, 1, 0.5)), 2);
    EXPECT_GT(seen.x(), seen.z() + 15) << red_first;
    // From the other side blue is before red; the wall would be in the way.
    panes.scene.camera.p_WC.z() = -3;
    panes.scene.instances[0].X_WM.translation().z() = 1.5F;
    panes.scene.sun.to_sun_W.z() *= -1;
    const picture::ImageData behind = draw(panes.assets, panes.scene);
    const Vec3 from_behind = colour_at(behind, pixel_of(panes.scene, Vec3(0, 1, 0)), 2);
    EXPECT_GT(from_behind.z(), from_behind.x() + 15) << red_first;
  }
}

TEST_F(DrawnPicture, a_pane_behind_something_solid_is_hidden_and_hides_nothing_itself) {
  Panes panes;
  panes.add(0, kWhite, Vec3f(0, 1, 0.5F));
  const Vec3 without = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, Vec3(0, 1, 0.5)), 2);
  panes.add(0, kRed, Vec3f(0, 1, 0));
  const Vec3 with = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, Vec3(0, 1, 0.5)), 2);
  EXPECT_LT((with - without).norm(), 0.5);
  // Water behind a pane was drawn before it, and shines through.
  panes.scene.instances.pop_back();
  panes.scene.instances.pop_back();
  panes.add(0, kRed, Vec3f(0, 1, 0.5F));
  const Vec3 dry = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, Vec3(0, 1, 0.5)), 2);
  picture::WaterInstance water;
  water.X_WM.translation() = Vec3f(0, 1, -0.3F);
  water.clearness = 0;
  panes.scene.waters.push_back(water);
  const Vec3 wet = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, Vec3(0, 1, 0.5)), 2);
  EXPECT_LT(wet.y(), dry.y() - 10);
}

TEST_F(DrawnPicture, glass_throws_no_shadow_and_mirrors_the_sun) {
  Panes panes;
  panes.assets.materials[kRed].roughness = 0.2F;
  panes.scene.instances.clear();
  panes.scene.sun.to_sun_W = Vec3f(0, 1, 0.2F).normalized();
  panes.scene.camera.p_WC = Vec3(0, 1.6, 2);
  panes.scene.camera.p_WT = Vec3(0, 0.2, 0);
  panes.add(2, kWhite, Vec3f(0, -0.05F, 0));
  const auto floor = pixel_of(panes.scene, Vec3(0, 0, -0.12));
  const double open = mean(draw(panes.assets, panes.scene), floor.x(), floor.y(), 2);
  // Flat over the floor, a little above the line of sight to the point that it would shade.
  panes.add(0, kWhite, Vec3f(0, 0.6F, 0));
  panes.scene.instances[1].X_WM.linear() = Eigen::AngleAxisf(1.5708F, Vec3f::UnitX()).matrix() * 0.3F;
  EXPECT_LT(mean(draw(panes.assets, panes.scene), floor.x(), floor.y(), 2), open - 50);
  panes.scene.instances[1].material = kRed;
  EXPECT_NEAR(mean(draw(panes.assets, panes.scene), floor.x(), floor.y(), 2), open, 2);
  // Turned so that it mirrors the sun into the eye, it is far brighter than its body.
  const Vec3f to_eye = (panes.scene.camera.p_WC.cast<float>() - Vec3f(0, 0.6F, 0)).normalized();
  const Vec3f half = (to_eye + panes.scene.sun.to_sun_W.normalized()).normalized();
  panes.scene.instances[1].X_WM.linear() =
      Eigen::Quaternionf::FromTwoVectors(Vec3f::UnitZ(), half).toRotationMatrix() * 0.5F;
  const Vec3 glint = colour_at(draw(panes.assets, panes.scene), pixel_of(panes.scene, Vec3(0, 0.6, 0)), 1);
  EXPECT_GT(glint.minCoeff(), 225) << "white, not red: " << glint.transpose();
}

}  // namespace
}  // namespace mechane::draw
