#include "client-sdk/visit/hand_drawing.hpp"

#include <map>

#include <gtest/gtest.h>

namespace mechane::visit {
namespace {

using hand::CalibrationPose;
using hand::HandSide;

TEST(HandDrawing, FillsItsDiscAndStaysOnIt) {
  for (const auto pose : {CalibrationPose::flat, CalibrationPose::fist, CalibrationPose::pinch}) {
    float farthest = 0;
    for (const picture::HandStroke& stroke : draw_hand(pose, HandSide::right)) {
      ASSERT_GT(stroke.radius, 0.03F) << "seen from afar";
      farthest = std::max({farthest, stroke.from.norm() + stroke.radius, stroke.to.norm() + stroke.radius});
    }
    EXPECT_LT(farthest, 0.97F) << static_cast<int>(pose);
    EXPECT_GT(farthest, 0.65F) << static_cast<int>(pose);
  }
}

TEST(HandDrawing, StrokesOfAPartFollowEachOther) {
  for (const auto pose : {CalibrationPose::flat, CalibrationPose::fist, CalibrationPose::pinch}) {
    std::uint32_t last = 0;
    std::map<std::uint32_t, int> strokes;
    for (const picture::HandStroke& stroke : draw_hand(pose, HandSide::right)) {
      EXPECT_GE(stroke.part, last);
      last = stroke.part;
      ++strokes[stroke.part];
    }
    EXPECT_EQ(strokes.size(), 2 + hand::kFingers) << "palm, cuff, fingers";
  }
}

TEST(HandDrawing, TheThumbLiesOverTheFistAndBesideTheFlatHand) {
  const auto fist = draw_hand(CalibrationPose::fist, HandSide::right);
  const auto flat = draw_hand(CalibrationPose::flat, HandSide::right);
  EXPECT_LT(fist.back().to.x(), fist.back().from.x()) << "drawn last, it bends towards the other fingers";
  float rightmost = -1;
  for (const picture::HandStroke& stroke : flat)
    rightmost = std::max(rightmost, stroke.to.x());
  EXPECT_GT(rightmost, 0.5F);
}

TEST(HandDrawing, OfALeftHandIsTheMirrorImage) {
  for (const auto pose : {CalibrationPose::flat, CalibrationPose::fist, CalibrationPose::pinch}) {
    const auto right = draw_hand(pose, HandSide::right), left = draw_hand(pose, HandSide::left);
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i].from, Eigen::Vector2f(-right[i].from.x(), right[i].from.y()));
      EXPECT_EQ(left[i].to, Eigen::Vector2f(-right[i].to.x(), right[i].to.y()));
    }
  }
}

}  // namespace
}  // namespace mechane::visit
