#include "client-sdk/display/caption_room.hpp"

#include <chrono>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/camera.hpp"

namespace mechane::display {
namespace {

constexpr TimePoint kFirstPicture{std::chrono::seconds(100)};

TEST(CaptionRoom, CaptionsThatScenesAreFramedForChangeNothing) {
  for (const double covered : {0.0, 0.2, CaptionRoom::kFramedFor}) {
    CaptionRoom room;
    room.see(covered, kFirstPicture);
    EXPECT_DOUBLE_EQ(room.room_below(), 1);
  }
}

TEST(CaptionRoom, TheFirstIsTakenAtOnceAndALaterOneIsFollowed) {
  CaptionRoom room;
  room.see(0.5, kFirstPicture);
  EXPECT_NEAR(room.room_below(), (1 - CaptionRoom::kFramedFor) / 0.5, 1e-12);
  double last = room.room_below();
  for (int picture = 1; picture <= 300; ++picture) {
    room.see(0.2, kFirstPicture + picture * std::chrono::milliseconds(16));
    EXPECT_LE(room.room_below(), last);
    EXPECT_LT(last - room.room_below(), 0.02) << "no cut";
    last = room.room_below();
  }
  EXPECT_NEAR(last, 1, 1e-3);
}

TEST(CaptionRoom, HoweverMuchIsCoveredTheViewStaysUsable) {
  CaptionRoom room;
  room.see(1.0, kFirstPicture);
  EXPECT_DOUBLE_EQ(room.room_below(), CaptionRoom::kMost);
  room.see(-3, kFirstPicture - std::chrono::seconds(5));  // a clock that goes back moves nothing
  EXPECT_DOUBLE_EQ(room.room_below(), CaptionRoom::kMost);
}

double drawn_between(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

/// What stood right above a caption of two lines stands right above the larger one, and the upper edge has stayed.
RC_GTEST_PROP(CaptionRoom, what_was_seen_above_the_words_is_seen_above_larger_ones, ()) {
  picture::Camera camera;
  camera.p_WC = Vec3(drawn_between(-1, 1), drawn_between(1, 2), drawn_between(3, 5));
  const double covered = drawn_between(CaptionRoom::kFramedFor, 0.6);
  CaptionRoom room;
  room.see(covered, kFirstPicture);
  picture::Camera roomy = camera;
  roomy.room_below = room.room_below();
  for (const picture::Eye eye : {picture::Eye::left, picture::Eye::right}) {
    const picture::EyeView before = picture::eye_view(camera, eye, 1.6);
    const picture::EyeView after = picture::eye_view(roomy, eye, 1.6);
    // A place of the plane in which both eyes' frusta meet, from its height in the picture.
    const auto height_of = [&](const picture::EyeView& view, const Eigen::Vector4f& p_W) {
      const Eigen::Vector4f clip = view.P * view.V_CW * p_W;
      return 0.5 * (1 + double{clip.y()} / double{clip.w()});
    };
    for (const double y : {1.0, CaptionRoom::kFramedFor}) {
      const Eigen::Vector4f clip(0, static_cast<float>(2 * y - 1), 0.5F, 1);
      const Eigen::Vector4f p = (before.P * before.V_CW).inverse() * clip;
      const double there = height_of(after, p / p.w());
      RC_ASSERT(std::abs(there - (y == 1.0 ? 1.0 : covered)) < 2e-3);
    }
  }
}

}  // namespace
}  // namespace mechane::display
