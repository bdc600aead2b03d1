#include "client-sdk/picture/picking.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::picture {
namespace {

constexpr PixelSize kPicture{1280, 720};

double pick(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

/// A box of 10 cm at each place, of object 0, 1, ...; seen from (0, 0, 3).
struct Boxes {
  RenderScene scene;
  SceneAssets assets;

  explicit Boxes(const std::vector<Vec3>& places) {
    scene.camera.p_WC = Vec3(0, 0, 3);
    assets.meshes.push_back(box_mesh(Vec3(0.1, 0.1, 0.1)));
    for (std::size_t i = 0; i < places.size(); ++i) {
      Instance box;
      box.X_WM.translation() = places[i].cast<float>();
      box.object = static_cast<std::uint32_t>(i);
      scene.instances.push_back(box);
    }
  }
  [[nodiscard]] PixelPlace seen_at(const Vec3& p_WQ, Stereo stereo, Eye eye) const {
    const bool mono = stereo == Stereo::mono;
    const double width = mono ? kPicture.width : kPicture.width / 2.0;
    const EyeView view = eye_view(scene.camera, eye, width / kPicture.height);
    const Eigen::Vector2f at = (view.P * view.V_CW * p_WQ.cast<float>().homogeneous()).hnormalized().head<2>();
    return {(at.x() + 1) / 2 * width + (eye == Eye::right ? width : 0), (1 - at.y()) / 2 * kPicture.height};
  }
  [[nodiscard]] std::optional<std::uint32_t> at(PixelPlace place, Stereo stereo = Stereo::mono) const {
    return object_at(scene, assets, place, stereo, kPicture);
  }
};

RC_GTEST_PROP(Picking, a_click_where_a_box_is_seen_finds_it_in_each_eye, ()) {
  const Vec3 here(pick(-0.8, 0.8), pick(-0.6, 0.6), pick(-2, 1));
  const Boxes boxes({here, here + Vec3(0.3, 0.1, 0)});
  RC_ASSERT(boxes.at(boxes.seen_at(here, Stereo::mono, Eye::middle)) == 0U);
  for (const Eye eye : {Eye::left, Eye::right})
    RC_ASSERT(boxes.at(boxes.seen_at(here, Stereo::side_by_side, eye), Stereo::side_by_side) == 0U);
}

TEST(Picking, OfTwoTheNearerAndBesideThemNothing) {
  const Boxes boxes({Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(0, 0, 5)});
  EXPECT_EQ(boxes.at({640, 360}), 1U) << "the third is behind the eye";
  EXPECT_EQ(boxes.at({40, 40}), std::nullopt);
}

TEST(Picking, SceneryHidesWhatIsBehindIt) {
  Boxes boxes({Vec3(0, 0, -1), Vec3(0, 0, 1)});
  boxes.scene.instances[1].object.reset();
  EXPECT_EQ(boxes.at({640, 360}), std::nullopt);
}

TEST(Picking, APictureWithoutPixelsHasNothing) {
  const Boxes boxes({Vec3::Zero()});
  EXPECT_EQ(object_at(boxes.scene, boxes.assets, {0, 0}, Stereo::side_by_side, {1, 0}), std::nullopt);
}

}  // namespace
}  // namespace mechane::picture
