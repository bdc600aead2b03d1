#include "client-sdk/draw/screen_region.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/camera.hpp"

namespace mechane::draw {
namespace {

constexpr picture::PixelSize kRegionPicture{200, 100};

float region_number(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'000)) / 10'000.0F;
}

Eigen::Matrix4f some_view() {
  picture::Camera camera;
  camera.p_WC = Vec3(region_number(-2, 2), region_number(0.5F, 3), region_number(2, 5));
  camera.p_WT = Vec3(0, 0.5, 0);
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::middle, 2);
  return view.P * view.V_CW;
}

Eigen::AlignedBox3f some_box() {
  const Vec3f low(region_number(-1, 1), region_number(0, 1), region_number(-1, 1));
  return {low, low + Vec3f(region_number(0.01F, 0.5F), region_number(0.01F, 0.5F), region_number(0.01F, 0.5F))};
}

/// Whether the point's pixel is in the region, or it is not in the picture.
bool covers(const ScreenRegion& region, const Eigen::Matrix4f& PV, const Vec3f& p_W) {
  const Eigen::Vector4f clip = PV * p_W.homogeneous();
  if (clip.head<3>().cwiseAbs().maxCoeff() > clip.w()) return true;
  const float x = (clip.x() / clip.w() * 0.5F + 0.5F) * kRegionPicture.width;
  const float y = (clip.y() / clip.w() * 0.5F + 0.5F) * kRegionPicture.height;
  return x >= static_cast<float>(region.left) && x <= static_cast<float>(region.right) &&
         y >= static_cast<float>(region.bottom) && y <= static_cast<float>(region.top);
}

RC_GTEST_PROP(ScreenRegion, contains_what_is_seen_of_a_box_and_of_its_shadow, ()) {
  const Eigen::Matrix4f PV = some_view();
  const Eigen::AlignedBox3f box_W = some_box();
  const Vec3f to_sun_W = Vec3f(region_number(-1, 1), region_number(1, 2), region_number(-1, 1)).normalized();
  const ScreenRegion region = region_of(PV, corners_with_shadow(box_W, to_sun_W, -0.1F), kRegionPicture);
  for (int i = 0; i < 50; ++i) {
    const Vec3f share(region_number(0, 1), region_number(0, 1), region_number(0, 1));
    const Vec3f p_W = box_W.min() + box_W.sizes().cwiseProduct(share);
    const Vec3f shadow_W = p_W - to_sun_W * ((p_W.y() + 0.1F) / to_sun_W.y() * region_number(0, 1));
    RC_ASSERT(covers(region, PV, p_W));
    RC_ASSERT(covers(region, PV, shadow_W));
  }
}

TEST(ScreenRegion, what_reaches_behind_the_eye_may_be_everywhere) {
  picture::Camera camera;
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::middle, 2);
  const std::array<Vec3f, 2> points_W{camera.p_WT.cast<float>(), (2 * camera.p_WC - camera.p_WT).cast<float>()};
  EXPECT_EQ(region_of(view.P * view.V_CW, points_W, kRegionPicture), whole_region(kRegionPicture));
  EXPECT_TRUE(region_of(view.P * view.V_CW, {}, kRegionPicture).empty());
  EXPECT_TRUE(corners_with_shadow({Vec3f::Zero(), Vec3f::Ones()}, Vec3f::UnitX(), 0).empty()) << "no end of the shadow";
}

RC_GTEST_PROP(ScreenRegion, merged_ones_contain_all_and_do_not_overlap, ()) {
  const auto any = rc::gen::map(rc::gen::container<std::vector<int>>(4, rc::gen::inRange(0, 40)), [](const auto& n) {
    return ScreenRegion{n[0], n[1], n[0] + n[2], n[1] + n[3]};
  });
  const auto regions = *rc::gen::container<std::vector<ScreenRegion>>(any);
  const std::vector<ScreenRegion> out = merged(regions);
  for (int x = 0; x < 80; x += 3) {
    for (int y = 0; y < 80; y += 3) {
      const auto holds = [&](const ScreenRegion& r) {
        return x >= r.left && x < r.right && y >= r.bottom && y < r.top;
      };
      const auto count = std::ranges::count_if(out, holds);
      RC_ASSERT(count <= 1);
      if (std::ranges::any_of(regions, holds)) RC_ASSERT(count == 1);
    }
  }
}

RC_GTEST_PROP(ScreenRegion, cells_cover_all_once_and_little_else, ()) {
  constexpr picture::PixelSize kSize{150, 110};  // no whole number of cells
  constexpr int kNear = 32;
  std::vector<ScreenRegion> regions;
  for (int i = *rc::gen::inRange(0, 5); i > 0; --i) {
    const int left = *rc::gen::inRange(0, 150);
    const int bottom = *rc::gen::inRange(0, 110);
    regions.push_back({left, bottom, *rc::gen::inRange(left, 151), *rc::gen::inRange(bottom, 111)});
  }
  const std::vector<ScreenRegion> out = covered(regions, kSize);
  for (int x = 0; x < 150; x += 3) {
    for (int y = 0; y < 110; y += 3) {
      const auto near = [&](int margin) {
        return [=](const ScreenRegion& r) {
          return !r.empty() && x >= r.left - margin && x < r.right + margin && y >= r.bottom - margin &&
                 y < r.top + margin;
        };
      };
      const auto count = std::ranges::count_if(out, near(0));
      RC_ASSERT(count <= 1);
      if (std::ranges::any_of(regions, near(0))) RC_ASSERT(count == 1);
      if (count == 1) RC_ASSERT(std::ranges::any_of(regions, near(kNear)));
    }
  }
  for (const ScreenRegion& region : out)
    RC_ASSERT(region.right <= 150 && region.top <= 110);
}

TEST(ScreenRegion, a_crop_brings_the_region_s_corners_to_those_of_clip_space) {
  const ScreenRegion region{50, 20, 150, 45};
  const Eigen::Matrix4f crop = crop_to(region, kRegionPicture);
  EXPECT_TRUE((crop * Eigen::Vector4f(-0.5F, -0.6F, 0, 1)).isApprox(Eigen::Vector4f(-1, -1, 0, 1), 1e-5F));
  EXPECT_TRUE((crop * Eigen::Vector4f(0.5F, -0.1F, 0, 1)).isApprox(Eigen::Vector4f(1, 1, 0, 1), 1e-5F));
  EXPECT_EQ(crop_to(whole_region(kRegionPicture), kRegionPicture), Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
}

}  // namespace
}  // namespace mechane::draw
