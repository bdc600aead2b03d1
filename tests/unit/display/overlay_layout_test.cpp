#include "client-sdk/display/overlay_layout.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::display {
namespace {

/// Every letter half as wide as it is high: enough to lay out, and exact.
float half_square(Face, int size_px, std::string_view text) {
  return 0.5F * static_cast<float>(size_px) * static_cast<float>(text.size());
}

RC_GTEST_PROP(BreakLines, keeps_all_words_and_the_width, (const std::vector<std::string>& raw)) {
  std::string text;
  std::vector<std::string> words;
  for (const std::string& part : raw) {
    std::string word;
    for (const char c : part)
      word += static_cast<char>('a' + static_cast<unsigned char>(c) % 26);
    if (word.empty()) continue;
    words.push_back(word);
    text += (text.empty() ? "" : " ") + word;
  }
  const float width = static_cast<float>(*rc::gen::inRange(1, 60));
  const auto lines = break_lines(text, width, [](std::string_view part) { return static_cast<float>(part.size()); });
  std::string joined;
  for (const std::string& line : lines) {
    RC_ASSERT(static_cast<float>(line.size()) <= width || line.find(' ') == std::string::npos);
    joined += (joined.empty() ? "" : " ") + line;
  }
  RC_ASSERT(joined == text);
}

TEST(OverlayLayout, everything_lies_within_the_picture) {
  OverlayContent content;
  content.title = "Ο κοχλίας του Αρχιμήδη";
  content.caption = "Γυρίστε τη χειρολαβή με σταθερό ρυθμό, ώσπου να γεμίσει η δεξαμενή.";
  content.hint = "Πιο αργά.";
  content.steps_done = 2;
  content.steps_total = 5;
  content.readouts = {{"Νερό", "12,4", "λίτρα", 0.6, "20"}, {"Ταχύτητα", "31", "στρ./λεπτό", 0.5, "60"}};
  for (const PixelSize size : {PixelSize{1280, 720}, {640, 720}, {640, 360}, {1920, 1080}, {3840, 2160}}) {
    const OverlayLayout layout = lay_out(content, size, half_square);
    for (const OverlayShape& shape : layout.shapes) {
      EXPECT_GE(shape.x, 0) << size.width;
      EXPECT_GE(shape.y, 0) << size.width;
      EXPECT_LE(shape.x + shape.width, static_cast<float>(size.width));
      EXPECT_LE(shape.y + shape.height, static_cast<float>(size.height));
    }
    for (const OverlayText& text : layout.texts) {
      EXPECT_GE(text.x, 0) << text.text;
      EXPECT_LE(text.baseline, static_cast<float>(size.height)) << text.text;
    }
  }
}

TEST(OverlayLayout, dots_tell_what_is_done) {
  OverlayContent content;
  content.title = "t";
  content.steps_total = 3;
  const auto golden = [&](std::uint32_t done) {
    content.steps_done = done;
    const OverlayLayout layout = lay_out(content, {1280, 720}, half_square);
    // The panel and its mark come first, then the dots.
    return std::count_if(layout.shapes.begin() + 2, layout.shapes.end(),
                         [&](const OverlayShape& s) { return s.colour == layout.shapes[1].colour; });
  };
  EXPECT_EQ(golden(0), 0);
  EXPECT_EQ(golden(2), 2);
  EXPECT_EQ(golden(3), 3);
}

TEST(OverlayLayout, nothing_to_say_draws_nothing) {
  const OverlayLayout layout = lay_out({}, {1280, 720}, half_square);
  EXPECT_TRUE(layout.shapes.empty());
  EXPECT_TRUE(layout.texts.empty());
}

}  // namespace
}  // namespace mechane::display
