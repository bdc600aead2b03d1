// The words of gauges: the author's names and ranges, in wide and narrow pictures.
#include <algorithm>

#include <gtest/gtest.h>

#include "client-sdk/draw/text/overlay_layout.hpp"

namespace mechane::draw {
namespace {

/// Every letter has half its height in width.
float letters(Face, int size_px, std::string_view text) {
  return 0.5F * static_cast<float>(size_px) * static_cast<float>(text.size());
}

TEST(GaugeLayout, a_gauge_with_a_name_has_it_in_a_narrow_picture_too) {
  picture::OverlayContent content;
  content.readouts = {{"Left cylinder", "12.4", "litres", 0.5, "20"}, {"Right cylinder", "3.0", "litres", 0.5, "20"}};
  const auto says = [](const OverlayLayout& layout, const std::string& words) {
    return std::ranges::count(layout.texts, words, &OverlayText::text);
  };
  EXPECT_EQ(says(lay_out(content, {640, 720}, letters), "Left cylinder"), 0);
  content.readouts[0].named = content.readouts[1].named = true;
  const OverlayLayout narrow = lay_out(content, {640, 720}, letters);
  EXPECT_EQ(says(narrow, "Left cylinder"), 1);
  EXPECT_EQ(says(narrow, "Right cylinder"), 1);
  EXPECT_EQ(says(narrow, "0–20"), 2);
  content.readouts[0].begin = "-5";
  EXPECT_EQ(says(lay_out(content, {1280, 720}, letters), "-5 … 20"), 1);
}

TEST(GaugeLayout, a_longer_name_widens_the_panel_and_is_cut_at_last) {
  picture::OverlayContent content;
  const auto panel = [&] { return lay_out(content, {1280, 720}, letters); };
  content.readouts = {{"Water", "12.4", "litres", 0.5, "20"}};
  const float usual = panel().shapes.front().width;
  content.readouts[0].named = true;
  EXPECT_EQ(panel().shapes.front().width, usual) << "a short name needs no more room";
  content.readouts[0].label = "Water in the left cylinder";
  EXPECT_GT(panel().shapes.front().width, usual);
  EXPECT_TRUE(std::ranges::any_of(panel().texts, [&](const auto& t) { return t.text == content.readouts[0].label; }));
  content.readouts[0].label = "All the water that stands in the left cylinder and above it in the pipe";
  const OverlayLayout cut = panel();
  const auto name = std::ranges::find_if(cut.texts, [](const auto& t) { return t.text.starts_with("All the water"); });
  ASSERT_NE(name, cut.texts.end());
  EXPECT_TRUE(name->text.ends_with(" …")) << name->text;
  EXPECT_LT(cut.shapes.front().width, 1.5F * usual);
}

}  // namespace
}  // namespace mechane::draw
