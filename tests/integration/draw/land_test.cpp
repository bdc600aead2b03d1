#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

constexpr float kPlain_m = -0.06F;

/// A square piece of level earth about the origin whose rim slopes down, 8 cm in 12.
picture::MeshData piece_of_earth() {
  picture::MeshData mesh;
  constexpr float kTop_m = 0.5F;
  constexpr float kFoot_m = 0.62F;
  const auto add = [&](const std::array<Vec3f, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3f n = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (const Vec3f& p : corners) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(n);
      mesh.uv.emplace_back(0, 0);
    }
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  };
  std::array<Vec3f, 4> top;
  std::array<Vec3f, 4> foot;
  constexpr std::array<std::array<float, 2>, 4> kCorners{{{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    top[k] = Vec3f(kTop_m * kCorners[k][0], 0, kTop_m * kCorners[k][1]);
    foot[k] = Vec3f(kFoot_m * kCorners[k][0], -0.08F, kFoot_m * kCorners[k][1]);
  }
  add(top);
  for (std::size_t k = 0; k < 4; ++k)
    add({foot[k], foot[(k + 1) % 4], top[(k + 1) % 4], top[k]});
  return mesh;
}

/// Earth on the plain, so much higher than what is modelled; none: the plain alone.
struct EarthScene {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  explicit EarthScene(std::optional<float> higher_m) {
    assets.images.push_back({1, 1, {128, 128, 128, 255}, true});
    assets.images.push_back({1, 1, {128, 128, 255, 255}, false});
    picture::MaterialData earth;
    earth.land = true;
    earth.base_colour_image = 0;
    earth.normal_image = 1;
    assets.materials.push_back(earth);
    assets.meshes.push_back(piece_of_earth());
    scene.ground_height_m = kPlain_m;
    scene.land_material = 0;
    scene.camera.p_WC = Vec3(0.8, 1.2, 2);
    scene.camera.p_WT = Vec3(0, 0, 0);
    if (higher_m) {
      add_instance(scene, 0, 0, Vec3f(0, *higher_m, 0));
      scene.instances.back().casts_shadow = false;
    }
  }
};

TEST_F(DrawnPicture, earth_that_goes_under_the_plain_has_no_rim) {
  // In the middle of the slope that faces the sun, by how much it is lighter than the plain would be there.
  const auto lighter_by = [&](float higher_m) {
    const EarthScene with(higher_m);
    const EarthScene without({});
    const Eigen::Vector2d rim = pixel_of(with.scene, Vec3(0.56, double{higher_m} - 0.04, 0));
    const double slope = mean(draw(with.assets, with.scene), rim.x(), rim.y(), 1);
    renderer_->forget_assets();
    const double plain = mean(draw(without.assets, without.scene), rim.x(), rim.y(), 1);
    renderer_->forget_assets();
    return slope - plain;
  };
  const double step = lighter_by(0.4F);
  EXPECT_GT(step, 12) << "a step of earth is seen as one";
  EXPECT_LT(std::abs(lighter_by(0)), 0.5 * step);
}

}  // namespace
}  // namespace mechane::draw
