// A river is carried by its current, ends softly, and mirrors what stands at it where geometry says.
#include <cmath>

#include "tests/integration/draw/drawn_picture.hpp"
#include "tests/integration/draw/lamp.hpp"

namespace mechane::draw {
namespace {

constexpr PixelRectangle kWhole{0, 0, 640, 360};

/// A level sheet about the origin, 20 m long and wide.
picture::MeshData sheet_mesh() {
  picture::MeshData mesh;
  mesh.positions = {{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}};
  mesh.normals.assign(4, Vec3f::UnitY());
  mesh.uv = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// A glowing red ball over still water in the dark.
struct Pond {
  picture::SceneAssets assets;
  picture::RenderScene scene;
  Vec3 p_WB{0.15, 0.5, -0.6};

  explicit Pond(float level_m) {
    assets.meshes.push_back(picture::sphere_mesh(0.04, 24, 32));
    assets.meshes.push_back(sheet_mesh());
    picture::MaterialData red;
    red.base_colour = Eigen::Vector4f(0, 0, 0, 1);
    red.roughness = 1;
    red.emissive = Vec3f(0.9F, 0, 0);
    assets.materials.push_back(red);
    add_instance(scene, 0, 0, p_WB.cast<float>());
    picture::WaterInstance water;
    water.mesh = 1;
    water.ripple = 0;
    water.X_WM.translation() = Vec3f(0, level_m, 0);
    scene.waters.push_back(water);
    scene.sun.irradiance = Vec3f::Zero();
    scene.sky = false;
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-1, -1, -1), Vec3f(1, 1, 1));
    scene.camera.p_WC = Vec3(0, 0.9, 1.2);
    scene.camera.p_WT = Vec3(0, 0.05, -0.6);
    scene.camera.eye_distance_m = 0.1;
  }
  [[nodiscard]] double level() const { return scene.waters.front().X_WM.translation().y(); }
  /// The ball, turned over at the water.
  [[nodiscard]] Vec3 image_W() const { return {p_WB.x(), 2 * level() - p_WB.y(), p_WB.z()}; }
};

/// The rest of the picture is cut off: of a part about `at`.
Blob red_about(const picture::ImageData& image, const Eigen::Vector2d& at, std::uint32_t reach) {
  const PixelRectangle part{static_cast<std::uint32_t>(at.x()) - reach, static_cast<std::uint32_t>(at.y()) - reach,
                            2 * reach, 2 * reach};
  Blob out = blob(image, part);
  out.middle += Eigen::Vector2d(part.x, part.y);
  return out;
}

Eigen::Vector2d seen_by(const picture::EyeView& view, const Vec3& p_W, double width, double height) {
  const Eigen::Vector4f clip = view.P * view.V_CW * p_W.cast<float>().homogeneous();
  return {(clip.x() / clip.w() * 0.5 + 0.5) * width, (0.5 - clip.y() / clip.w() * 0.5) * height};
}

TEST_F(DrawnPicture, water_mirrors_a_ball_where_geometry_says) {
  Eigen::Vector2d higher = Eigen::Vector2d::Zero();
  for (const float level_m : {0.05F, -0.10F}) {
    const Pond pond(level_m);
    renderer_->forget_assets();
    const picture::ImageData image = draw(pond.assets, pond.scene);
    const Eigen::Vector2d predicted = pixel_of(pond.scene, pond.image_W());
    ASSERT_GT(predicted.y(), pixel_of(pond.scene, pond.p_WB).y() + 60) << "apart from the ball itself";
    const Blob mirrored = red_about(image, predicted, 28);
    ASSERT_GT(mirrored.weight, 200) << "the mirror image is seen";
    EXPECT_LT((mirrored.middle - predicted).norm(), 2) << "at " << level_m;
    if (level_m > 0) {
      higher = mirrored.middle;
    } else {
      EXPECT_GT(mirrored.middle.y(), higher.y() + 20) << "with the water lower, the image is lower";
    }
  }
}

TEST_F(DrawnPicture, each_eye_sees_its_own_mirror_image) {
  const Pond pond(0.0F);
  const picture::ImageData both = draw(pond.assets, pond.scene, picture::Stereo::side_by_side);
  constexpr double kHalf = kSize.width / 2.0;
  const double aspect = kHalf / kSize.height;
  const picture::EyeView left = picture::eye_view(pond.scene.camera, picture::Eye::left, aspect);
  const picture::EyeView right = picture::eye_view(pond.scene.camera, picture::Eye::right, aspect);
  const Eigen::Vector2d at_left = seen_by(left, pond.image_W(), kHalf, kSize.height);
  const Eigen::Vector2d at_right = seen_by(right, pond.image_W(), kHalf, kSize.height);
  const Blob in_left = red_about(both, at_left, 20);
  const Blob in_right = red_about(both, at_right + Eigen::Vector2d(kHalf, 0), 20);
  ASSERT_GT(in_left.weight, 100);
  ASSERT_GT(in_right.weight, 100);
  const double disparity = in_left.middle.x() - (in_right.middle.x() - kHalf);
  EXPECT_NEAR(disparity, at_left.x() - at_right.x(), 1.2);
  // Not that of the water at this place of the picture, which is nearer.
  const Vec3 p_WE = pond.scene.camera.p_WC;
  const Vec3 on_water = p_WE + p_WE.y() / (p_WE.y() - pond.image_W().y()) * (pond.image_W() - p_WE);
  const double of_water =
      (seen_by(left, on_water, kHalf, kSize.height) - seen_by(right, on_water, kHalf, kSize.height)).x();
  EXPECT_GT(std::abs(of_water - (at_left.x() - at_right.x())), 4) << "else a flat image would pass";
}

TEST_F(DrawnPicture, water_mirrors_nothing_that_lies_under_it) {
  Pond pond(0.0F);
  pond.scene.instances.front().X_WM.translation().y() = -0.5F;
  // The place where a sunken ball would be seen if the mirror did not cut it off: its image stands over the water.
  const Vec3 over(pond.p_WB.x(), 0.5, pond.p_WB.z());
  const picture::ImageData sunken = draw(pond.assets, pond.scene);
  EXPECT_LT(red_about(sunken, pixel_of(pond.scene, over), 28).weight, 50);
  pond.scene.instances.clear();
  const picture::ImageData none = draw(pond.assets, pond.scene);
  EXPECT_LT(blob(none, kWhole).weight, 50);
}

/// A river seen straight from above, the sun overhead: it glitters.
picture::RenderScene river_from_above(const Vec3f& flow_W) {
  picture::RenderScene scene;
  picture::WaterInstance water;
  water.flow_W = flow_W;
  water.clearness = 0.12F;
  scene.waters.push_back(water);
  scene.sun.to_sun_W = Vec3f::UnitY();
  scene.camera.p_WC = Vec3(0, 8, 0);
  scene.camera.field_of_view_rad = 21 * kPi / 180;
  scene.camera.p_WT = Vec3::Zero();
  scene.camera.up_W = -Vec3::UnitZ();
  return scene;
}

double green_at(const picture::ImageData& image, int column, int row) {
  return image.rgba[4 * (static_cast<std::size_t>(row) * image.width + static_cast<std::size_t>(column)) + 1];
}

/// How alike the middle of `after` is to that of `before` moved by (dx, dy) pixels: correlation of what is finer than some nine pixels, -1 to 1.
double likeness_moved(const picture::ImageData& before, const picture::ImageData& after, int dx, int dy) {
  std::vector<std::pair<double, double>> pairs;
  double mean_a = 0;
  double mean_b = 0;
  for (int y = 80; y < 280; y += 2) {
    for (int x = 160; x < 480; x += 2) {
      const auto value = [](const picture::ImageData& image, int column, int row) {
        const auto pixel = [&](int c, int r) { return green_at(image, c, r); };
        return pixel(column, row) - 0.25 * (pixel(column - 9, row) + pixel(column + 9, row) + pixel(column, row - 9) +
                                            pixel(column, row + 9));
      };
      pairs.emplace_back(value(before, x, y), value(after, x + dx, y + dy));
      mean_a += pairs.back().first;
      mean_b += pairs.back().second;
    }
  }
  mean_a /= static_cast<double>(pairs.size());
  mean_b /= static_cast<double>(pairs.size());
  double ab = 0;
  double aa = 1e-9;
  double bb = 1e-9;
  for (const auto& [a, b] : pairs) {
    ab += (a - mean_a) * (b - mean_b);
    aa += (a - mean_a) * (a - mean_a);
    bb += (b - mean_b) * (b - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

TEST_F(DrawnPicture, a_rivers_ripples_go_with_its_current) {
  picture::SceneAssets assets;
  assets.meshes.push_back(sheet_mesh());
  for (const Vec3f& flow_W : {Vec3f(0.5F, 0, 0), Vec3f(0, 0, -0.5F)}) {
    picture::RenderScene scene = river_from_above(flow_W);
    scene.time_s = 40;
    const picture::ImageData before = draw(assets, scene);
    scene.time_s = 40.3;
    const picture::ImageData after = draw(assets, scene);
    const Eigen::Vector2d way = pixel_of(scene, (0.3F * flow_W).cast<double>()) - pixel_of(scene, Vec3::Zero());
    ASSERT_GT(way.norm(), 12);
    const int dx = static_cast<int>(std::lround(way.x()));
    const int dy = static_cast<int>(std::lround(way.y()));
    const double with = likeness_moved(before, after, dx, dy);
    EXPECT_GT(with, 0.5);
    EXPECT_GT(with, likeness_moved(before, after, 0, 0) + 0.2);
    EXPECT_GT(with, likeness_moved(before, after, -dx, -dy) + 0.2);
    scene.time_s = 40;
    EXPECT_EQ(draw(assets, scene).rgba, before.rgba) << "by the world's time alone";
  }
}

TEST_F(DrawnPicture, water_ends_softly_at_a_bank) {
  picture::SceneAssets assets;
  assets.meshes.push_back(sheet_mesh());
  assets.meshes.push_back(picture::box_mesh(Vec3(2, 0.2, 2)));
  picture::MaterialData white;
  white.base_colour = Eigen::Vector4f(0.7F, 0.7F, 0.7F, 1);
  white.roughness = 1;
  assets.materials.push_back(white);
  // A beach that rises out of the water at x = 0, one to ten.
  picture::RenderScene scene = river_from_above(Vec3f::Zero());
  scene.sun = {};
  scene.camera.field_of_view_rad = kPi / 4;
  scene.camera.p_WC = Vec3(0, 3, 0);
  scene.waters.front().ripple = 0;
  add_instance(scene, 1, 0, Vec3f::Zero());
  Eigen::Affine3f& beach = scene.instances.front().X_WM;
  beach.linear() = Eigen::AngleAxisf(0.0997F, Vec3f::UnitZ()).toRotationMatrix();
  beach.translation() = -(beach.linear() * Vec3f(0, 0.2F, 0));
  scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-2, -1, -2), Vec3f(2, 1, 2));
  const picture::ImageData image = draw(assets, scene);
  const auto at = [&](double x) {
    const Eigen::Vector2d pixel = pixel_of(scene, Vec3(x, 0, 0));
    return mean(image, pixel.x(), pixel.y(), 1);
  };
  const double sand = at(0.2);
  const double deep = at(-1);
  ASSERT_GT(sand, deep + 60);
  EXPECT_GT(at(-0.05), deep + 0.3 * (sand - deep)) << "half a centimetre of water lets the sand through";
  double before = at(0.06);
  double steepest = 0;
  for (double x = 0.06; x > -0.8; x -= 0.02) {
    steepest = std::max(steepest, before - at(x));
    before = at(x);
  }
  EXPECT_LT(steepest, 0.35 * (sand - deep)) << "no edge";
}

}  // namespace
}  // namespace mechane::draw
