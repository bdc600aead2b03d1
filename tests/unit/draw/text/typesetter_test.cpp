#include "client-sdk/draw/text/typesetter.hpp"

#include <algorithm>
#include <span>

#include <gtest/gtest.h>

#include "client-sdk/draw/text/overlay_layout.hpp"
#include "tests/support/error_like.hpp"

namespace mechane::draw {
namespace {

/// The pixels of a line's glyphs, one behind the other.
std::vector<std::uint8_t> ink(const Typesetter& typesetter, const SetLine& line) {
  std::vector<std::uint8_t> out;
  const std::size_t side = typesetter.atlas_side();
  for (const PlacedGlyph& g : line.glyphs) {
    const auto x0 = static_cast<std::size_t>(g.u0 * static_cast<float>(side) + 0.5F);
    const auto y0 = static_cast<std::size_t>(g.v0 * static_cast<float>(side) + 0.5F);
    for (std::size_t y = 0; y < static_cast<std::size_t>(g.height); ++y) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(g.width); ++x)
        out.push_back(typesetter.atlas().at((y0 + y) * side + x0 + x));
    }
  }
  return out;
}

SetLine set_line(Typesetter& typesetter, Face face, int size_px, std::string_view utf8) {
  const TextLine line{face, size_px, utf8};
  return typesetter.set_lines(std::span(&line, 1)).front();
}

TEST(Typesetter, sets_greek_with_accents_and_no_missing_letters) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value()) << typesetter.error().to_string();
  for (const Face face : {Face::regular, Face::bold, Face::serif}) {
    const SetLine greek = set_line(**typesetter, face, 27, "Ο κοχλίας του Ἀρχιμήδους· ΐΰώ");
    EXPECT_EQ(greek.missing, 0);
    EXPECT_GT(greek.width, 200);
    const std::vector<std::uint8_t> pixels = ink(**typesetter, greek);
    EXPECT_GT(std::ranges::count_if(pixels, [](std::uint8_t v) { return v > 128; }), 500);
    // A letter that the font lacks comes out as its box, and is counted.
    const SetLine box = set_line(**typesetter, face, 27, "\U000F0000");
    EXPECT_EQ(box.missing, 1);
    const SetLine alpha = set_line(**typesetter, face, 27, "α");
    EXPECT_NE(ink(**typesetter, alpha), ink(**typesetter, box));
  }
}

TEST(Typesetter, widths_add_up_and_grow_with_size) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value());
  const float small = (*typesetter)->width(Face::regular, 20, "νερό");
  EXPECT_NEAR((*typesetter)->width(Face::regular, 40, "νερό"), 2 * small, 0.05F * small);
  EXPECT_FLOAT_EQ(set_line(**typesetter, Face::regular, 20, "νερό").width, small);
}

TEST(Typesetter, broken_utf8_is_set_and_a_missing_font_is_told) {
  const auto typesetter = Typesetter::create(default_font_folder());
  ASSERT_TRUE(typesetter.has_value());
  EXPECT_GE(set_line(**typesetter, Face::regular, 20, "a\xff\xc3").width, 0);
  const auto none = Typesetter::create("/nowhere");
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error(), test::is_error(ErrorCode::not_found, 0, {"/nowhere/DejaVuSans.ttf", "fonts-dejavu-core"}));
}

const std::string kGreek = "ΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ αβγδεζηθικλμνξοπρστυφχψως ΆΈΉΊΌΎΏ άέήίόύώϊϋΐΰ 0123456789";
const std::string kLatin = "ABCDEFGHIJKLMNOPQRSTUVWXYZ abcdefghijklmnopqrstuvwxyz ÄÖÜäöüß éèêçñ 0123456789";

/// Captions and readouts, and then a panel of questions, each with all letters of an alphabet in each of its sizes.
std::vector<OverlayText> page_of(Typesetter& typesetter, const std::string& letters, float text_scale, bool panel) {
  picture::OverlayContent content;
  content.style.text_scale = text_scale;
  content.title = content.caption = content.hint = content.note = letters;
  content.readouts = {{letters.substr(0, 12), "12,4", "l", 0.6, "20"}};
  content.corner = {{{}, letters}};
  if (panel) {
    content.panel.emplace();
    content.panel->title = content.panel->goal = content.panel->text = content.panel->more = letters;
    content.panel->answers = {{{}, letters}};
  }
  const MeasureText measure = [&](Face face, int px, std::string_view text) {
    return typesetter.width(face, px, text);
  };
  return lay_out(content, {1920, 1080}, measure).texts;
}

std::vector<SetLine> set_page(Typesetter& typesetter, const std::vector<OverlayText>& texts) {
  std::vector<TextLine> lines;
  for (const OverlayText& text : texts)
    lines.push_back({text.face, text.size_px, text.text});
  return typesetter.set_lines(lines);
}

TEST(Typesetter, no_glyph_is_lost_however_many_alphabets_and_sizes_there_were) {
  const auto used = Typesetter::create(default_font_folder(), 16384);
  ASSERT_TRUE(used.has_value());
  std::size_t page = 0;
  for (int turn = 0; turn < 2; ++turn) {
    for (const std::string& letters : {kGreek, kLatin}) {
      for (const float text_scale : {1.0F, picture::kLargeText}) {
        for (const bool panel : {false, true}) {
          ++page;
          const std::vector<OverlayText> texts = page_of(**used, letters, text_scale, panel);
          const std::vector<SetLine> set = set_page(**used, texts);
          const auto fresh = Typesetter::create(default_font_folder(), 16384);
          const std::vector<SetLine> expected = set_page(**fresh, texts);
          for (std::size_t i = 0; i < texts.size(); ++i) {
            ASSERT_EQ(set[i].glyphs.size(), expected[i].glyphs.size()) << "page " << page << ": " << texts[i].text;
            ASSERT_EQ(ink(**used, set[i]), ink(**fresh, expected[i])) << "page " << page << ": " << texts[i].text;
          }
        }
      }
    }
  }
  EXPECT_EQ((*used)->atlas_side(), Typesetter::kLeastSide) << "each picture alone has room in the smallest atlas";
}

TEST(Typesetter, a_picture_that_needs_more_gets_a_larger_atlas_up_to_the_graphics_card_s_limit) {
  std::vector<OverlayText> texts;
  for (int size_px = 40; size_px < 80; ++size_px) {
    OverlayText& text = texts.emplace_back();
    text.size_px = size_px;
    text.text = kLatin;
  }
  const auto count = [](const std::vector<SetLine>& lines) {
    std::size_t sum = 0;
    for (const SetLine& line : lines)
      sum += line.glyphs.size();
    return sum;
  };
  const std::size_t letters = static_cast<std::size_t>(std::ranges::count_if(
      kLatin, [](char c) { return c != ' ' && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
  const auto typesetter = Typesetter::create(default_font_folder(), 16384);
  ASSERT_TRUE(typesetter.has_value());
  EXPECT_EQ(count(set_page(**typesetter, texts)), letters * texts.size());
  EXPECT_GT((*typesetter)->atlas_side(), Typesetter::kLeastSide);
  EXPECT_LE((*typesetter)->atlas_side(), 4 * Typesetter::kLeastSide);
  EXPECT_EQ((*typesetter)->atlas().size(), std::size_t{(*typesetter)->atlas_side()} * (*typesetter)->atlas_side());
  const std::uint64_t revision = (*typesetter)->atlas_revision();
  EXPECT_EQ(count(set_page(**typesetter, texts)), letters * texts.size());
  EXPECT_EQ((*typesetter)->atlas_revision(), revision) << "the same picture again is not uploaded again";
  // On a card that allows no more, what has no room is left out and the rest is drawn.
  const auto small = Typesetter::create(default_font_folder(), Typesetter::kLeastSide);
  const std::size_t drawn = count(set_page(**small, texts));
  EXPECT_LT(drawn, letters * texts.size());
  EXPECT_GT(drawn, 300U);
  EXPECT_EQ((*small)->atlas_side(), Typesetter::kLeastSide);
}

}  // namespace
}  // namespace mechane::draw
