#include "client-sdk/draw/typesetter.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace mechane::draw {
namespace {

/// The pixels of a line's glyphs, one behind the other.
std::vector<std::uint8_t> ink(const Typesetter& typesetter, const SetLine& line) {
  std::vector<std::uint8_t> out;
  constexpr float kSide = Typesetter::kAtlasSide;
  for (const PlacedGlyph& g : line.glyphs) {
    const auto x0 = static_cast<std::size_t>(g.u0 * kSide + 0.5F);
    const auto y0 = static_cast<std::size_t>(g.v0 * kSide + 0.5F);
    for (std::size_t y = 0; y < static_cast<std::size_t>(g.height); ++y) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(g.width); ++x) {
        out.push_back(typesetter.atlas()[(y0 + y) * Typesetter::kAtlasSide + x0 + x]);
      }
    }
  }
  return out;
}

TEST(Typesetter, sets_greek_with_accents_and_no_missing_letters) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value()) << typesetter.error().to_string();
  for (const Face face : {Face::regular, Face::bold, Face::serif}) {
    const SetLine greek = (*typesetter)->set_line(face, 27, "Ο κοχλίας του Ἀρχιμήδους· ΐΰώ");
    EXPECT_EQ(greek.missing, 0);
    EXPECT_GT(greek.width, 200);
    const std::vector<std::uint8_t> pixels = ink(**typesetter, greek);
    EXPECT_GT(std::ranges::count_if(pixels, [](std::uint8_t v) { return v > 128; }), 500);
    // A letter that the font lacks comes out as its box, and is counted.
    const SetLine box = (*typesetter)->set_line(face, 27, "\U000F0000");
    EXPECT_EQ(box.missing, 1);
    const SetLine alpha = (*typesetter)->set_line(face, 27, "α");
    EXPECT_NE(ink(**typesetter, alpha), ink(**typesetter, box));
  }
}

TEST(Typesetter, widths_add_up_and_grow_with_size) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value());
  const float small = (*typesetter)->width(Face::regular, 20, "νερό");
  EXPECT_NEAR((*typesetter)->width(Face::regular, 40, "νερό"), 2 * small, 0.05F * small);
  EXPECT_FLOAT_EQ((*typesetter)->set_line(Face::regular, 20, "νερό").width, small);
}

TEST(Typesetter, broken_utf8_is_set_and_a_missing_font_is_told) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value());
  EXPECT_GE((*typesetter)->set_line(Face::regular, 20, "a\xff\xc3").width, 0);
  const auto none = Typesetter::create("/nowhere");
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().where.find("/nowhere/DejaVuSans.ttf"), std::string::npos);
  EXPECT_NE(none.error().remedy.find("fonts-dejavu-core"), std::string::npos);
}

}  // namespace
}  // namespace mechane::draw
