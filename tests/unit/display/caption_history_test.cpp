#include "client-sdk/display/caption_history.hpp"

#include <gtest/gtest.h>

namespace mechane::display {
namespace {

constexpr picture::PixelSize kEye{1280, 720};

TimePoint at_s(double seconds) {
  return TimePoint{} + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
}

class CaptionHistoryTest : public testing::Test {
 protected:
  picture::OverlayContent told(double seconds, picture::PixelSize eye = kEye) {
    picture::OverlayContent content = words_;
    history_.tell(content, eye, at_s(seconds));
    return content;
  }
  void drawn(const picture::PictureBox& caption) {
    draw::OverlayLayout layout;
    layout.caption = caption;
    history_.see(layout);
  }

  picture::OverlayContent words_;
  CaptionHistory history_;
};

TEST_F(CaptionHistoryTest, EachTextHasItsOwnTime) {
  words_.caption = "Press the lever.";
  words_.note = "One moment.";
  EXPECT_EQ(told(5).caption_for_s, 0);
  EXPECT_FLOAT_EQ(told(8).caption_for_s, 3);
  words_.hint = "Slower.";
  EXPECT_EQ(told(9).caption_for_s, 0) << "there is something new to read";
  EXPECT_FLOAT_EQ(told(9).note_for_s, 4);
  words_.note.clear();
  words_.message = "We close at eight.";
  EXPECT_EQ(told(10).note_for_s, 0);
  EXPECT_FLOAT_EQ(told(10).caption_for_s, 1);
}

TEST_F(CaptionHistoryTest, WordsStayWhereTheyWereUntilOthersCome) {
  words_.caption = "Press the lever.";
  EXPECT_FALSE(told(0).caption_at);
  const picture::PictureBox box{100, 100, 500, 200};
  drawn(box);
  EXPECT_EQ(told(1).caption_at, box);
  EXPECT_FALSE(told(2, {640, 720}).caption_at) << "another size";
  drawn(box);
  words_.caption = "Well done.";
  EXPECT_FALSE(told(3).caption_at);
}

}  // namespace
}  // namespace mechane::display
