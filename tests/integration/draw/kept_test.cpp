// The quality `cached`: what it keeps, and when.
#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

class Kept : public DrawnPicture {
 protected:
  void SetUp() override {
    DrawnPicture::SetUp();
    renderer_->set_quality(Quality::cached);
    assets_.meshes = {picture::box_mesh(Vec3(4, 0.05, 4)), picture::sphere_mesh(0.3, 24, 48)};
    assets_.materials.resize(2);
    assets_.materials[1].base_colour = Eigen::Vector4f(0.7F, 0.2F, 0.1F, 1);
    add_instance(scene_, 0, 0, Vec3f(0, -0.35F, 0));
    add_instance(scene_, 1, 1, Vec3f(-0.6F, 0, 0));
    add_instance(scene_, 1, 1, Vec3f(0.6F, 0, 0));
    scene_.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-4, -0.4F, -4), Vec3f(4, 0.6F, 4));
    scene_.camera.p_WC = Vec3(0, 0.9, 3.2);
  }
  picture::ImageData draw_times(std::uint32_t count) {
    picture::ImageData last;
    for (std::uint32_t i = 0; i < count; ++i)
      last = draw(assets_, scene_);
    return last;
  }
  [[nodiscard]] std::size_t differing(const picture::ImageData& a, const picture::ImageData& b) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
      count += std::abs(int{a.rgba[i]} - int{b.rgba[i]}) > 3 ? 1 : 0;
    return count;
  }
  static constexpr std::uint32_t kUntilKept = LowRenderer::kStill + LowRenderer::kSlices;
  picture::SceneAssets assets_;
  picture::RenderScene scene_;
};

TEST_F(Kept, a_kept_picture_is_made_in_slices_and_then_is_what_is_drawn_anew) {
  (void)draw_times(kUntilKept - 2);
  EXPECT_EQ(renderer_->low()->times_kept(), 0U) << "a slice in each picture";
  const picture::ImageData kept = draw_times(2);
  EXPECT_EQ(renderer_->low()->times_kept(), 1U);
  renderer_->set_quality(Quality::low);
  EXPECT_LT(differing(kept, draw(assets_, scene_)), kept.rgba.size() / 2000);
}

TEST_F(Kept, what_leaves_and_comes_to_rest_changes_only_its_place) {
  (void)draw_times(kUntilKept);
  for (int step = 0; step < 3; ++step) {
    scene_.instances[2].X_WM.translation().x() += 0.1F;
    (void)draw(assets_, scene_);
  }
  EXPECT_EQ(renderer_->low()->times_mended(), 1U) << "where it was kept";
  const picture::ImageData rests = draw_times(LowRenderer::kSettled - 2);
  EXPECT_EQ(renderer_->low()->times_mended(), 1U);
  const picture::ImageData joined = draw_times(2);
  EXPECT_EQ(renderer_->low()->times_mended(), 2U) << "where it has come to rest";
  EXPECT_EQ(renderer_->low()->times_kept(), 1U) << "the whole is not made again";
  // The edge of its shadow is a little softer now.
  EXPECT_LT(differing(rests, joined), rests.rgba.size() / 1000);
}

TEST_F(Kept, a_close_up_is_drawn_in_every_second_picture_and_at_once_when_its_view_changes) {
  scene_.inset = picture::Inset{scene_.camera, "all"};
  scene_.inset->camera.p_WC = Vec3(0, 0.5, 2);
  scene_.camera.p_WT = scene_.camera.p_WC + Vec3(0, 1, 0);  // it sees the sky alone
  (void)draw_times(kUntilKept * 2);
  // Two pictures in a row, a thing moving in each: one of them shows the last close-up.
  std::vector<picture::ImageData> shown;
  for (int i = 0; i < 4; ++i) {
    scene_.instances[2].X_WM.translation().x() += 0.1F;
    shown.push_back(draw(assets_, scene_));
  }
  const bool first = differing(shown[0], shown[1]) == 0;
  EXPECT_EQ(differing(shown[1], shown[2]) == 0, !first);
  EXPECT_EQ(differing(shown[2], shown[3]) == 0, first);
  for (int i = 0; i < 2; ++i) {
    scene_.inset->camera.p_WC.x() += 0.2;
    shown.push_back(draw(assets_, scene_));
    EXPECT_GT(differing(shown[shown.size() - 2], shown.back()), 0U);
  }
}

}  // namespace
}  // namespace mechane::draw
