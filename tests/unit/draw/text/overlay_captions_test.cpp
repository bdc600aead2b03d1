// Captions leave most of the picture free, do not cover what visitors look at, and turn pages.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/draw/text/overlay_page.hpp"
#include "client-sdk/draw/text/overlay_pages.hpp"
#include "server/base/utf8.hpp"
#include "tests/unit/draw/text/some_overlay.hpp"

namespace mechane::draw {
namespace {

Extent placed_at(const picture::PictureBox& box) {
  return {box.left, box.top, box.right, box.bottom, "box"};
}

float area_of(const std::optional<picture::PictureBox>& box) {
  return box ? (box->right - box->left) * (box->bottom - box->top) : 0;
}

float reach(std::uint32_t pixels, float share) {
  return static_cast<float>(pixels) * share;
}

/// Hands and parts, at random.
std::vector<picture::PictureBox> some_boxes(picture::PixelSize size) {
  std::vector<picture::PictureBox> boxes(from_to<std::size_t>(0, 7));
  for (picture::PictureBox& box : boxes) {
    const auto share = [](int most) { return static_cast<float>(from_to(0, most)) / 1000; };
    box.left = reach(size.width, share(1000)) - 20;
    box.top = reach(size.height, share(1000)) - 20;
    box.right = box.left + 5 + reach(size.width, share(350));
    box.bottom = box.top + 5 + reach(size.height, share(350));
  }
  return boxes;
}

picture::OverlayContent some_captions() {
  picture::OverlayContent content;
  add_some_corner(content);
  content.title = some_words(1, 6);
  content.goal = some_words(0, 30);
  content.caption = some_words(1, 60);
  content.hint = some_words(0, 40);
  content.steps_total = from_to(0U, 19U);
  const std::vector<picture::Readout> readouts{{"Νερό", "12,4", "λίτρα", 0.6, "20"},
                                               {"Ταχύτητα", "31", "στρ./λεπτό", 0.5, "60"}};
  content.readouts.assign(readouts.begin(), readouts.begin() + from_to(0, 2));
  if (from_to(0, 2) == 0) content.message = some_words(1, 40);
  if (from_to(0, 3) == 0)
    content.notice = {picture::OverlayNotice::Sign(from_to(0, 5)), "Το γάντι δεν είναι συνδεδεμένο",
                      *rc::gen::arbitrary<bool>() ? "Πιάστε την με το χέρι σας ή ενημερώστε το προσωπικό." : ""};
  return content;
}

/// Whether a box of this size has a place in the picture over none of the others, sought pixel by pixel with coarse steps. A place must
/// be free with some room to spare, as the layout's gaps ask for.
bool has_place(const picture::PictureBox& panel, picture::PixelSize size, const std::vector<Extent>& fixed,
               const std::vector<picture::PictureBox>& seen) {
  constexpr float kRounding = 2;
  const float unit = overlay_unit(size);
  const float margin = std::round(36 * unit), gap = std::round(16 * unit) + kRounding;
  const float width = panel.right - panel.left, height = panel.bottom - panel.top;
  const float step = std::max(3 * unit, 1.0F);
  for (float y = margin; y + height <= static_cast<float>(size.height) - margin; y += step) {
    for (float x = margin; x + width <= static_cast<float>(size.width) - margin; x += step) {
      const auto apart = [&](const Extent& other, float by) {
        return x >= other.right + by || other.left >= x + width + by || y >= other.bottom + by ||
               other.top >= y + height + by;
      };
      const bool free = std::ranges::all_of(fixed, [&](const Extent& other) { return apart(other, gap); }) &&
                        std::ranges::all_of(seen, [&](const auto& box) { return apart(placed_at(box), kRounding); });
      if (free) return true;
    }
  }
  return false;
}

bool covers_any(const picture::PictureBox& panel, const std::vector<picture::PictureBox>& boxes) {
  return std::ranges::any_of(boxes, [&](const auto& box) { return overlap(placed_at(panel), placed_at(box)); });
}

/// Buttons, readouts and a close-up: what there is without captions.
std::vector<Extent> fixed_shapes(picture::OverlayContent content, picture::PixelSize size, const std::string* inset) {
  content.title = content.goal = content.caption = content.hint = content.note = content.message = "";
  content.notice.reset();
  std::vector<Extent> extents;
  for (const OverlayShape& shape : lay_out(content, size, real_letters(), inset).shapes)
    extents.push_back(extent_of(shape));
  if (inset == nullptr) return extents;
  const PixelRectangle at = inset_rectangle(size);
  extents.push_back(placed_at({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.x + at.width),
                               static_cast<float>(at.y + at.height)}));
  return extents;
}

RC_GTEST_PROP(OverlayCaptions, cover_a_quarter_at_most_and_nothing_to_be_seen_where_there_is_a_free_place, ()) {
  picture::OverlayContent content = some_captions();
  const picture::PixelSize size = some_size();
  content.keep_off = some_boxes(size);
  content.caption_for_s = content.note_for_s = static_cast<float>(from_to(0, 60));
  const std::string close_up = "Από κοντά";
  const std::string* inset = *rc::gen::arbitrary<bool>() ? &close_up : nullptr;
  const OverlayLayout layout = lay_out(content, size, real_letters(), inset);
  const float whole = reach(size.width, 1) * reach(size.height, 1);
  RC_LOG() << size.width << "x" << size.height << ": " << area_of(layout.caption) / whole << " + "
           << area_of(layout.note) / whole;
  RC_ASSERT(layout.caption.has_value());
  RC_ASSERT(area_of(layout.caption) + area_of(layout.note) <= kMostCovered * whole * 1.001F);
  const std::string fault = fault_of(layout, size, real_letters(), content.style.high_contrast);
  RC_LOG() << fault;
  RC_ASSERT(fault.empty());
  const bool covers = covers_any(*layout.caption, content.keep_off);
  RC_CLASSIFY(covers, "covers something");
  RC_CLASSIFY(!covers && covers_any(*lay_out(
                                         [&] {
                                           picture::OverlayContent free = content;
                                           free.keep_off.clear();
                                           return free;
                                         }(),
                                         size, real_letters(), inset)
                                         .caption,
                                    content.keep_off),
              "gives way");
  if (!covers) return;
  std::vector<Extent> fixed = fixed_shapes(content, size, inset);
  if (layout.note) fixed.push_back(placed_at(*layout.note));
  RC_ASSERT(!has_place(*layout.caption, size, fixed, content.keep_off));
  // It is the smallest panel: one line of words under the title.
  content.keep_off.clear();
  const OverlayLayout usual = lay_out(content, size, real_letters(), inset);
  RC_ASSERT(layout.caption->right - layout.caption->left < 0.6F * (usual.caption->right - usual.caption->left));
}

RC_GTEST_PROP(OverlayCaptions, a_note_gives_way_where_there_is_a_free_place, ()) {
  picture::OverlayContent content;
  content.message = some_words(1, 20);
  const picture::PixelSize size = some_size();
  content.keep_off = some_boxes(size);
  const OverlayLayout layout = lay_out(content, size, real_letters());
  RC_ASSERT(layout.note.has_value());
  if (covers_any(*layout.note, content.keep_off)) RC_ASSERT(!has_place(*layout.note, size, {}, content.keep_off));
}

/// What is read in a panel at a time, without spaces and without the title.
struct Reading {
  std::string words;
  std::string mark;  ///< of the page
};

Reading read_in(const OverlayLayout& layout, const std::optional<picture::PictureBox>& panel) {
  Reading read;
  if (!panel) return read;
  for (const OverlayText& text : layout.texts) {
    const bool inside =
        text.x >= panel->left && text.x < panel->right && text.baseline > panel->top && text.baseline < panel->bottom;
    if (!inside) continue;
    if (text.face != Face::bold) read.words += text.text;
    if (text.face == Face::bold && text.text.find('/') != std::string::npos) read.mark = text.text;
  }
  std::erase(read.words, ' ');
  return read;
}

std::string unspaced(std::string text) {
  std::erase(text, ' ');
  return text;
}

RC_GTEST_PROP(OverlayCaptions, every_word_is_on_one_page_and_stays_until_it_is_read, ()) {
  picture::OverlayContent content = some_captions();
  content.notice.reset();
  const picture::PixelSize size = some_size();
  content.keep_off = some_boxes(size);
  const std::string wanted = unspaced(content.goal + content.caption + content.hint);
  const std::string& note = content.note.empty() ? content.message : content.note;
  for (const bool of_note : {false, true}) {
    const auto seen_at = [&](float seconds) {
      (of_note ? content.note_for_s : content.caption_for_s) = seconds;
      const OverlayLayout layout = lay_out(content, size, real_letters());
      return read_in(layout, of_note ? layout.note : layout.caption);
    };
    const std::string all = of_note ? unspaced(note) : wanted;
    Reading page = seen_at(0);
    std::string words = page.words;
    float from_s = 0;
    for (float at_s = 3.5F; words != all && at_s < 600; at_s += 3.5F) {
      const Reading now = seen_at(at_s);
      if (now.mark == page.mark) continue;
      const float least_s = std::max(kLeastPage_s, static_cast<float>(utf8_letters(page.words)) / kLettersRead_s);
      RC_ASSERT(at_s - from_s > least_s - 3.6F);
      page = now;
      from_s = at_s;
      words += now.words;
      RC_LOG() << now.mark << ": " << words << "\n" << all;
      RC_ASSERT(all.starts_with(words));
    }
    RC_LOG() << size.width << "x" << size.height << (of_note ? " note" : " caption");
    RC_ASSERT(words == all);
  }
}

TEST(OverlayCaptions, pages_follow_each_other_and_begin_again) {
  picture::OverlayContent content;
  content.title = "Pump";
  for (int i = 0; i < 120; ++i)
    content.caption += "lever ";
  const auto mark_at = [&](float seconds) {
    content.caption_for_s = seconds;
    const OverlayLayout layout = lay_out(content, {1280, 720}, real_letters());
    return read_in(layout, layout.caption).mark;
  };
  std::vector<std::string> seen;
  for (float at_s = 0; at_s < 90; at_s += 0.5F)
    if (const std::string mark = mark_at(at_s); seen.empty() || seen.back() != mark) seen.push_back(mark);
  ASSERT_GE(seen.size(), 4U);
  seen.resize(4);
  EXPECT_EQ(seen, (std::vector<std::string>{"1/3", "2/3", "3/3", "1/3"}));
  content.caption = "Press the lever.";
  EXPECT_EQ(mark_at(0), "") << "one page needs no mark";
}

TEST(OverlayCaptions, the_panel_stands_still_while_pages_turn) {
  picture::OverlayContent content;
  for (int i = 0; i < 71; ++i)
    content.caption += "lever ";
  const OverlayLayout first = lay_out(content, {1280, 720}, real_letters());
  content.caption_for_s = 20;
  const OverlayLayout second = lay_out(content, {1280, 720}, real_letters());
  EXPECT_NE(first.texts.back().text, second.texts.back().text);
  EXPECT_EQ(first.caption, second.caption);
}

TEST(OverlayCaptions, what_gave_way_once_stays_there_until_it_covers_something) {
  picture::OverlayContent content;
  content.title = "Pump";
  content.caption = "Press the lever.";
  const OverlayLayout usual = lay_out(content, {1280, 720}, real_letters());
  content.keep_off = {{200, 600, 300, 700}};
  const OverlayLayout away = lay_out(content, {1280, 720}, real_letters());
  EXPECT_NE(away.caption, usual.caption);
  EXPECT_EQ(away.covered_below, usual.covered_below) << "or the view would move, and what is seen with it";
  content.caption_at = away.caption;
  content.keep_off = {};
  EXPECT_EQ(lay_out(content, {1280, 720}, real_letters()).caption, away.caption) << "it does not jump back";
  content.keep_off = {{1000, 600, 1100, 650}};
  EXPECT_EQ(lay_out(content, {1280, 720}, real_letters()).caption, usual.caption);
}

TEST(OverlayCaptions, where_all_is_to_be_seen_the_least_important_is_covered) {
  picture::OverlayContent content;
  content.caption = "Press the lever until the water comes.";
  content.keep_off = {{0, 0, 640, 720}, {640, 0, 1280, 720}};
  const OverlayLayout layout = lay_out(content, {1280, 720}, real_letters());
  EXPECT_GE(layout.caption->left, 640);
}

RC_GTEST_PROP(OverlayPages, are_as_few_and_as_even_as_can_be, ()) {
  std::vector<PageLine> lines(from_to<std::size_t>(1, 30));
  for (PageLine& line : lines) {
    line.height = static_cast<float>(from_to(20, 50));
    line.gap = static_cast<float>(from_to(0, 1) * 10);
  }
  const auto most = static_cast<float>(from_to(50, 300));
  const auto begins = page_begins(lines, most);
  RC_ASSERT(!begins.empty() && begins.front() == 0);
  RC_ASSERT(highest_page(lines, begins) <= most);
  constexpr float kHighest = 60;  // a line and its gap
  const float all = highest_page(lines, std::vector<std::size_t>{0}) + 10;
  const auto pages = static_cast<float>(begins.size());
  RC_ASSERT(all > (pages - 1) * (most - kHighest));                  // few
  RC_ASSERT(highest_page(lines, begins) <= all / pages + kHighest);  // even
}

TEST(OverlayPages, of_equal_lines_only_the_last_page_may_be_short) {
  std::vector<PageLine> lines(5, {37, 0});
  lines.front().gap = 8;
  EXPECT_EQ(page_begins(lines, 84), (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(page_begins(lines, 160), (std::vector<std::size_t>{0, 3}));
}

TEST(OverlayPages, a_page_stays_for_its_letters_and_the_first_comes_again) {
  const std::vector<std::string> lines{std::string(74, 'a'), "b"};  // 5 s, and the least
  const std::vector<std::size_t> begins{0, 1};
  for (const float round_s : {0.0F, 9.0F, 900.0F}) {
    EXPECT_EQ(page_at(lines, begins, round_s + 0.1F).mark, "1/2");
    EXPECT_EQ(page_at(lines, begins, round_s + 4.9F).mark, "1/2");
    EXPECT_EQ(page_at(lines, begins, round_s + 5.1F).mark, "2/2");
    EXPECT_EQ(page_at(lines, begins, round_s + 8.9F).mark, "2/2");
  }
}

TEST(OverlayPages, a_line_higher_than_a_page_has_none) {
  EXPECT_TRUE(page_begins(std::vector<PageLine>{{10, 0}, {60, 0}}, 50).empty());
  EXPECT_TRUE(page_begins({}, 50).empty());
}

}  // namespace
}  // namespace mechane::draw
