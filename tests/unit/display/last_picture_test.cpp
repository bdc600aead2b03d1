#include "client-sdk/display/last_picture.hpp"

#include <gtest/gtest.h>

namespace mechane::display {
namespace {

TEST(LastPicture, a_press_is_on_the_button_of_the_eye_that_it_lies_in) {
  draw::OverlayLayout layout;
  layout.size = {400, 400};
  layout.targets.push_back({300, 300, 80, 80, {picture::OverlayAction::Kind::home, ""}});
  LastPicture last{{800, 400}, picture::Stereo::side_by_side, &layout, false};
  for (const double x : {340.0, 740.0})
    EXPECT_TRUE(last.button_at({x, 340}).has_value()) << x;
  EXPECT_FALSE(last.button_at({540, 340}).has_value());
  last.stereo = picture::Stereo::mono;
  last.size = {400, 400};
  EXPECT_TRUE(last.button_at({340, 340}).has_value());
  EXPECT_FALSE(last.button_at({340, 100}).has_value());
  last.size = {1, 1};
  EXPECT_FALSE(last.button_at({0, 0}).has_value()) << "a window without pixels";
  EXPECT_FALSE(LastPicture{}.button_at({340, 340}).has_value()) << "nothing was drawn yet";
}

}  // namespace
}  // namespace mechane::display
