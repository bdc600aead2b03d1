#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

using Kind = picture::ParticleEffect::Kind;

/// A dark wall behind a grey floor.
struct Yard {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  Yard() {
    assets.meshes = {picture::box_mesh(Vec3(4, 0.05, 4)), picture::box_mesh(Vec3(4, 3, 0.05)),
                     picture::box_mesh(Vec3(0.15, 0.5, 0.02))};
    for (const float grey : {0.5F, 0.05F}) {
      picture::MaterialData material;
      material.base_colour = Eigen::Vector4f(grey, grey, grey, 1);
      assets.materials.push_back(material);
    }
    add(0, 0, Vec3f(0, -0.05F, 0));
    add(1, 1, Vec3f(0, 1, -1.5F));
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -0.1F, -2), Vec3f(2, 2, 2));
    scene.camera.p_WC = Vec3(0, 0.9, 2.6);
    scene.camera.p_WT = Vec3(0, 0.6, 0);
    scene.time_s = 12.3;
  }
  void add(std::uint32_t mesh, std::uint32_t material, const Vec3f& p_W) { add_instance(scene, mesh, material, p_W); }
};

TEST_F(DrawnPicture, each_kind_of_particle_looks_its_part) {
  Yard yard;
  const picture::ImageData bare = draw(yard.assets, yard.scene);
  const auto seen = [&](const picture::ParticleEffect& effect, const Vec3& p) {
    yard.scene.effects = {effect};
    const picture::ImageData image = draw(yard.assets, yard.scene);
    const Eigen::Vector2d at = pixel_of(yard.scene, p);
    return Vec3(colour_at(image, at, 6) - colour_at(bare, at, 6));
  };
  const Vec3 steam = seen({Kind::steam, Vec3f(0, 0.4F, 0), Vec3f::UnitY(), 1, 0.05F, 1.0F}, Vec3(0.05, 0.75, 0));
  EXPECT_GT(steam.minCoeff(), 25) << "white over the dark wall";
  EXPECT_LT(steam.maxCoeff() - steam.minCoeff(), 30);
  const Vec3 fire = seen({Kind::fire, Vec3f(0, 0.5F, 0), Vec3f::UnitY(), 1, 0.14F, 0.2F}, Vec3(0.01, 0.7, 0));
  EXPECT_GT(fire.x(), 120);
  EXPECT_GT(fire.x(), fire.z() + 60) << "warm";
  const Vec3 smoke = seen({Kind::smoke, Vec3f(0, 0.0F, 0.8F), Vec3f::UnitY(), 1, 0.1F, 0.3F}, Vec3(0.05, 0.1, 0.8));
  EXPECT_LT(smoke.maxCoeff(), -15) << "dark before the floor";
  const Vec3 dust = seen({Kind::dust, Vec3f(0, 0.3F, 0), Vec3f::UnitY(), 1, 0.15F, 0.6F}, Vec3(0, 0.38, 0));
  EXPECT_GT(dust.x(), dust.z() + 8) << "earth";
  const Vec3 spray = seen({Kind::spray, Vec3f(-0.6F, 0.6F, 0), Vec3f(0.8F, 0.6F, 0), 1, 0.04F, 3}, Vec3(-0.4, 0.72, 0));
  EXPECT_GT(spray.minCoeff(), 4);
}

TEST_F(DrawnPicture, steam_stands_still_when_the_world_does) {
  Yard yard;
  yard.scene.effects = {{Kind::steam, Vec3f(0, 0.4F, 0), Vec3f::UnitY(), 1, 0.05F, 1.0F}};
  const picture::ImageData first = draw(yard.assets, yard.scene);
  EXPECT_EQ(draw(yard.assets, yard.scene).rgba, first.rgba);
  yard.scene.time_s += 0.2;
  EXPECT_NE(draw(yard.assets, yard.scene).rgba, first.rgba);
}

TEST_F(DrawnPicture, what_stands_before_steam_hides_it_and_it_meets_the_floor_softly) {
  Yard yard;
  yard.add(2, 0, Vec3f(0, 0.5F, 0.6F));
  const Vec3 p(0, 0.7, 0.62);
  const Vec3 post = colour_at(draw(yard.assets, yard.scene), pixel_of(yard.scene, p), 3);
  yard.scene.effects = {{Kind::steam, Vec3f(0, 0.3F, 0), Vec3f::UnitY(), 1, 0.08F, 1.0F}};
  const Vec3 hidden = colour_at(draw(yard.assets, yard.scene), pixel_of(yard.scene, p), 3);
  EXPECT_LT((post - hidden).norm(), 0.5);
}

TEST_F(DrawnPicture, a_fire_lights_what_is_near_it) {
  Yard yard;
  yard.scene.sun.irradiance *= 0.02F;
  yard.scene.sky = false;
  const Vec3 near(0.35, 0, 0.2);
  const Vec3 far(-1.3, 0, -0.8);
  const picture::ImageData dark = draw(yard.assets, yard.scene);
  yard.scene.effects = {{Kind::fire, Vec3f(0, 0.05F, 0), Vec3f::UnitY(), 1, 0.15F, 0.2F}};
  const picture::ImageData lit = draw(yard.assets, yard.scene);
  const Vec3 warm = colour_at(lit, pixel_of(yard.scene, near), 2) - colour_at(dark, pixel_of(yard.scene, near), 2);
  const Vec3 faint = colour_at(lit, pixel_of(yard.scene, far), 2) - colour_at(dark, pixel_of(yard.scene, far), 2);
  EXPECT_GT(warm.x(), 40);
  EXPECT_GT(warm.x(), warm.z() + 20);
  EXPECT_LT(faint.x(), 0.6 * warm.x());
}

TEST_F(DrawnPicture, a_jet_flies_on_its_parabola_and_falls_apart) {
  Yard yard;
  const picture::ImageData bare = draw(yard.assets, yard.scene);
  picture::WaterStream jet;
  jet.p_WS = Vec3f(-1, 0.9F, 0);
  jet.v_W = Vec3f(3.6F, 1.2F, 0);
  jet.width_m = 0.012F;
  jet.jet = true;
  yard.scene.streams = {jet};
  const picture::ImageData image = draw(yard.assets, yard.scene);
  // The share of its path at which something is seen, within a pixel or so of the parabola: whole at the nozzle, in pieces at the end.
  const auto seen = [&](double from_s, double to_s) {
    int count = 0;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      const double t = from_s + (to_s - from_s) * i / kSteps;
      const Eigen::Vector2d at = pixel_of(yard.scene, Vec3(-1 + 3.6 * t, 0.9 + 1.2 * t - 4.905 * t * t, 0));
      count += (colour_at(image, at, 1) - colour_at(bare, at, 1)).norm() > 6 ? 1 : 0;
    }
    return count / static_cast<double>(kSteps);
  };
  EXPECT_GT(seen(0.01, 0.12), 0.95);
  EXPECT_LT(seen(0.40, 0.52), 0.9);
  EXPECT_GT(seen(0.40, 0.52), 0.05);
}

}  // namespace
}  // namespace mechane::draw
