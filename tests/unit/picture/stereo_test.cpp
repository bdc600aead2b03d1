#include "client-sdk/picture/stereo.hpp"

#include <gtest/gtest.h>

namespace mechane::picture {
namespace {

constexpr PixelSize kWhole{1280, 720};

TEST(Stereo, every_mode_has_a_name_of_its_own) {
  EXPECT_EQ(stereo_names().size(), 10U);
  for (const auto& [name, mode] : stereo_names())
    EXPECT_EQ(stereo_name(mode), name);
  EXPECT_EQ(stereo_name(Stereo::side_by_side), "sbs");
  EXPECT_EQ(stereo_name(Stereo::row_interleaved), "rows");
}

TEST(Stereo, what_is_squeezed_has_half_the_pixels_and_the_proportions_of_the_whole_screen) {
  EXPECT_EQ(eye_size(Stereo::side_by_side_squeezed, kWhole), (PixelSize{640, 720}));
  EXPECT_EQ(seen_size(Stereo::side_by_side_squeezed, kWhole), kWhole);
  EXPECT_EQ(eye_size(Stereo::top_bottom_squeezed, kWhole), (PixelSize{1280, 360}));
  EXPECT_EQ(seen_size(Stereo::top_bottom_squeezed, kWhole), kWhole);
  EXPECT_EQ(seen_size(Stereo::side_by_side, kWhole), (PixelSize{640, 720}));
  const EyePlace left = eye_at(Stereo::side_by_side_squeezed, kWhole, {320, 360});
  EXPECT_EQ(left.eye, Eye::left);
  EXPECT_DOUBLE_EQ(left.x, 0);
  EXPECT_DOUBLE_EQ(left.aspect, 1280.0 / 720);
  EXPECT_EQ(eye_at(Stereo::top_bottom_squeezed, kWhole, {320, 361}).eye, Eye::right);
}

TEST(Stereo, a_place_belongs_to_the_eye_that_sees_it) {
  const EyePlace left = eye_at(Stereo::side_by_side, kWhole, {320, 360});
  EXPECT_EQ(left.eye, Eye::left);
  EXPECT_DOUBLE_EQ(left.x, 0);
  EXPECT_DOUBLE_EQ(left.aspect, 640.0 / 720);
  const EyePlace right = eye_at(Stereo::side_by_side, kWhole, {1280 - 160, 0});
  EXPECT_EQ(right.eye, Eye::right);
  EXPECT_DOUBLE_EQ(right.x, 0.5);
  EXPECT_DOUBLE_EQ(right.y, 1);
  const EyePlace lower = eye_at(Stereo::top_bottom, kWhole, {0, 540});
  EXPECT_EQ(lower.eye, Eye::right);
  EXPECT_DOUBLE_EQ(lower.x, -1);
  EXPECT_DOUBLE_EQ(lower.y, 0);
  EXPECT_EQ(eye_at(Stereo::top_bottom, kWhole, {0, 100}).eye, Eye::left);
  EXPECT_EQ(eye_at(Stereo::right_eye, kWhole, {0, 100}).eye, Eye::right);
  for (const Stereo shared : {Stereo::anaglyph, Stereo::row_interleaved, Stereo::quad_buffer, Stereo::mono})
    EXPECT_EQ(eye_at(shared, kWhole, {3, 4}).eye, Eye::middle);
}

}  // namespace
}  // namespace mechane::picture
