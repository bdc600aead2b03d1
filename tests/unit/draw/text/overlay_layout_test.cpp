#include "client-sdk/draw/text/overlay_layout.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/base/math.hpp"
#include "tests/unit/draw/text/some_overlay.hpp"

namespace mechane::draw {
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
  picture::OverlayContent content;
  content.title = "Ο κοχλίας του Αρχιμήδη";
  content.caption = "Γυρίστε τη χειρολαβή με σταθερό ρυθμό, ώσπου να γεμίσει η δεξαμενή.";
  content.hint = "Πιο αργά.";
  content.steps_done = 2;
  content.steps_total = 5;
  content.readouts = {{"Νερό", "12,4", "λίτρα", 0.6, "20"}, {"Ταχύτητα", "31", "στρ./λεπτό", 0.5, "60"}};
  for (const picture::PixelSize size :
       {picture::PixelSize{1280, 720}, {640, 720}, {640, 360}, {1920, 1080}, {3840, 2160}}) {
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

/// A code of so many modules a side, with its finders' corners dark.
picture::OverlayCode chequered(std::uint32_t side) {
  picture::OverlayCode code{side, {}, "On your phone"};
  for (std::uint32_t i = 0; i < side * side; ++i)
    code.dark.push_back(i % 2 == 0);
  return code;
}

TEST(OverlayLayout, a_code_has_quiet_around_it_and_covers_nothing) {
  for (const float words : {1.0F, 1.5F}) {
    for (const picture::PixelSize size : {picture::PixelSize{1280, 720}, {1920, 1080}, {1080, 1920}, {3840, 2160}}) {
      picture::OverlayContent content;
      content.title = "Το χωριό";
      content.caption = "Αγγίξτε μια πινακίδα για να πάτε στη μηχανή της.";
      content.style.text_scale = words;
      content.corner = {{{picture::OverlayAction::Kind::language, "el"}, "Ελληνικά"}};
      const OverlayLayout without = lay_out(content, size, half_square);
      content.code = chequered(37);
      const OverlayLayout with = lay_out(content, size, half_square);
      // The card and its modules follow each other.
      const auto card = std::ranges::find_if(with.shapes, [](const OverlayShape& s) { return s.colour.x() > 0.97F; });
      ASSERT_NE(card, with.shapes.end()) << size.width;
      const auto module = std::next(card);
      ASSERT_GE(module->width, 2) << size.width;
      EXPECT_EQ(module->width, std::round(module->width)) << "sharp edges";
      EXPECT_GE(module->x - card->x, 4 * module->width);
      EXPECT_GE(module->y - card->y, 4 * module->width);
      EXPECT_GE(card->x + card->width - module->x, (37 + 4) * module->width);
      EXPECT_GE(card->y + card->height - module->y, (37 + 4) * module->width);
      EXPECT_LE(card->x + card->width, static_cast<float>(size.width));
      EXPECT_EQ(
          std::count_if(card, with.shapes.end(), [&](const OverlayShape& s) { return s.colour == module->colour; }),
          (37 * 37 + 1) / 2);
      for (const OverlayTarget& target : with.targets)
        EXPECT_LE(card->y + card->height, target.y) << "it stands over the buttons";
      const auto& panel = with.shapes[without.shapes.size() > 1 ? with.shapes.size() - 1 : 0];
      EXPECT_TRUE(panel.x + panel.width <= card->x || panel.y + panel.height <= card->y ||
                  panel.y >= card->y + card->height)
          << size.width;
    }
  }
}

TEST(OverlayLayout, a_code_that_no_phone_could_read_is_not_drawn) {
  picture::OverlayContent content;
  const std::size_t before = lay_out(content, {480, 270}, half_square).shapes.size();
  content.code = chequered(37);
  EXPECT_EQ(lay_out(content, {480, 270}, half_square).shapes.size(), before);
}

TEST(OverlayLayout, dots_tell_what_is_done) {
  picture::OverlayContent content;
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

RC_GTEST_PROP(OverlayLayoutOfAnything, captions_lie_over_nothing_and_within_the_picture, ()) {
  picture::OverlayContent content;
  add_some_corner(content);
  content.title = some_words(1, 6);
  content.goal = some_words(0, 20);
  content.caption = some_words(0, 40);
  content.hint = some_words(0, 20);
  content.steps_total = from_to(0U, 19U);
  content.steps_done = from_to(0U, content.steps_total);
  const std::vector<picture::Readout> readouts{{"Νερό", "12,4", "λίτρα", 0.6, "20"},
                                               {"Ταχύτητα", "31", "στρ./λεπτό", 0.5, "60"},
                                               {"Θερμοκρασία", "100", "°C", 0.5, "100"},
                                               {"Δύναμη", "-31,5", "νιούτον", 1, "50"}};
  content.readouts.assign(readouts.begin(), readouts.begin() + from_to(0, 4));
  for (picture::Readout& readout : content.readouts)
    if (from_to(0, 2) == 0) readout.named = true, readout.label = some_words(1, 8), readout.begin = "-1000";
  if (from_to(0, 1) == 0)  // the longest words that there are
    content.notice = {picture::OverlayNotice::Sign(from_to(0, 5)), "Το γάντι δεν είναι συνδεδεμένο",
                      *rc::gen::arbitrary<bool>() ? "Πιάστε την με το χέρι σας ή ενημερώστε το προσωπικό." : ""};
  const picture::PixelSize size = some_size();
  const std::string inset = "Από κοντά";
  const bool close_up = *rc::gen::arbitrary<bool>();
  const OverlayLayout layout = lay_out(content, size, real_letters(), close_up ? &inset : nullptr);
  const std::string fault = fault_of(layout, size, real_letters(), content.style.high_contrast);
  RC_LOG() << size.width << "x" << size.height << ": " << fault;
  RC_ASSERT(fault.empty());
  RC_ASSERT(layout.targets.size() == content.corner.size());
}

RC_GTEST_PROP(OverlayLayoutOfAnything, questions_lie_over_nothing_and_within_the_picture, ()) {
  picture::OverlayContent content;
  add_some_corner(content);
  picture::OverlayPanel panel;
  panel.title = some_words(1, 6);
  panel.goal = some_words(0, 14);
  panel.text = some_words(1, 14);
  panel.scale = *rc::gen::arbitrary<bool>();
  panel.low = panel.scale ? some_words(1, 4) : "";
  panel.high = panel.scale ? some_words(1, 4) : "";
  const int answers = from_to(0, panel.scale ? 10 : 6);
  for (int i = 0; i < answers; ++i) {
    const std::string name = std::to_string(i + 1);
    panel.answers.push_back(
        button_of(picture::OverlayAction::Kind::answer, panel.scale ? name : some_words(1, 8), name));
  }
  panel.leave = button_of(picture::OverlayAction::Kind::skip, "Παράλειψη");
  panel.questions = from_to(1U, 5U);
  content.panel = panel;
  const picture::PixelSize size = some_size();
  const OverlayLayout layout = lay_out(content, size, real_letters());
  const std::string fault = fault_of(layout, size, real_letters(), content.style.high_contrast);
  RC_LOG() << size.width << "x" << size.height << ": " << fault;
  RC_ASSERT(fault.empty());
  RC_ASSERT(layout.targets.size() == content.corner.size() + panel.answers.size() + 1);
}

picture::OverlayPose some_pose() {
  picture::OverlayPose pose;
  pose.text = some_words(1, 6);
  pose.more = some_words(0, 9);
  pose.again = some_words(0, 9);
  pose.held = static_cast<float>(from_to(0, 10)) / 10;
  pose.total = 3;
  pose.done = from_to(0U, 3U);
  if (pose.done < 3) pose.drawing = {{{-0.4F, 0.3F}, {0.4F, -0.3F}, 0.2F, 0}, {{0, 0}, {0, 0.5F}, 0.1F, 1}};
  return pose;
}

RC_GTEST_PROP(OverlayLayoutOfAnything, a_pose_lies_over_nothing_and_within_the_picture, ()) {
  picture::OverlayContent content;
  add_some_corner(content);
  content.title = content.caption = "not shown";
  content.pose = some_pose();
  const picture::PixelSize size = some_size();
  const OverlayLayout layout = lay_out(content, size, real_letters());
  const std::string fault = fault_of(layout, size, real_letters(), content.style.high_contrast);
  RC_LOG() << size.width << "x" << size.height << ": " << fault;
  RC_ASSERT(fault.empty());
  RC_ASSERT(layout.targets.size() == content.corner.size());
}

TEST(OverlayLayout, a_pose_has_a_ring_that_fills) {
  picture::OverlayContent content;
  content.pose = {.drawing = {{{-0.3F, 0}, {0.3F, 0}, 0.2F, 0}}, .text = "Make a fist", .total = 3};
  const auto filled = [&content](float held) {
    content.pose->held = held;
    const OverlayLayout layout = lay_out(content, {1280, 720}, half_square);
    const OverlayShape& disc = layout.shapes[2];  // on the veil and the panel
    return std::ranges::count_if(layout.shapes, [&](const OverlayShape& shape) {
      const float x = shape.x + shape.width / 2 - disc.x - disc.width / 2;
      const float y = shape.y + shape.height / 2 - disc.y - disc.height / 2;
      return std::hypot(x, y) > disc.width / 2 && std::hypot(x, y) < 0.7F * disc.width && shape.colour.w() == 1;
    });
  };
  EXPECT_EQ(filled(0), 0);
  EXPECT_EQ(filled(0.5F), 30);
  EXPECT_EQ(filled(1), 60);
}

TEST(OverlayLayout, a_poses_parts_have_one_outline_each) {
  picture::OverlayContent content;
  content.pose = {
      .drawing = {{{-0.3F, 0}, {0.3F, 0}, 0.2F, 0}, {{0, 0}, {0, 0.4F}, 0.2F, 0}, {{0, 0}, {0, 0}, 0.1F, 1}},
      .text = "Make a fist"};
  const OverlayLayout layout = lay_out(content, {1280, 720}, half_square);
  std::string drawn;
  for (std::size_t i = 3; i < 9; ++i)
    drawn += layout.shapes[i].colour.x() < 0.5F ? 'o' : 'f';
  EXPECT_EQ(drawn, "ooffof");
  EXPECT_NEAR(layout.shapes[4].turn_rad, kPi / 2, 1e-5) << "downwards";
  EXPECT_NEAR(layout.shapes[4].width, layout.shapes[3].width * (0.4F + 0.4F) / (0.6F + 0.4F), 2);
}

TEST(OverlayLayout, a_notice_stands_in_the_notes_place_with_its_sign_beside_its_words) {
  picture::OverlayContent content;
  content.note = "a note";
  for (int sign = 0; sign <= static_cast<int>(picture::OverlayNotice::Sign::unplugged); ++sign) {
    content.notice = {picture::OverlayNotice::Sign(sign), "Take the handle", "Please."};
    const OverlayLayout layout = lay_out(content, {1280, 720}, half_square);
    ASSERT_EQ(layout.texts.size(), 2U) << "no note";
    EXPECT_EQ(layout.texts[0].text, "Take the handle");
    EXPECT_GE(layout.texts[0].size_px, 27) << "it is read at 2 m";
    ASSERT_GT(layout.shapes.size(), 4U);
    const Extent panel = extent_of(layout.shapes[0]), tile = extent_of(layout.shapes[1]);
    EXPECT_TRUE(within(tile, panel));
    EXPECT_GE(layout.texts[0].x, tile.right);
    for (std::size_t i = 2; i < layout.shapes.size(); ++i)
      EXPECT_TRUE(within(extent_of(layout.shapes[i]), tile)) << sign << ", stroke " << i;
  }
}

TEST(OverlayLayout, a_finger_finds_each_button) {
  picture::OverlayContent content;
  content.title = "t";
  content.corner = {button_of(picture::OverlayAction::Kind::home, "Χωριό"),
                    button_of(picture::OverlayAction::Kind::language, "EN", "en")};
  picture::OverlayPanel panel;
  panel.text = "Πόσες στροφές του τροχού έχει το μίλι του Βιτρούβιου;";
  panel.leave = button_of(picture::OverlayAction::Kind::skip, "Παράλειψη");
  for (const char* name : {"a", "b", "c", "d"})
    panel.answers.push_back(button_of(picture::OverlayAction::Kind::answer, "Τετρακόσιες στροφές", name));
  for (const float scale : {1.0F, picture::kLargeText}) {
    content.style.text_scale = scale;
    for (const bool asks : {false, true}) {
      content.panel = asks ? std::optional(panel) : std::nullopt;
      for (const picture::PixelSize size : {picture::PixelSize{1280, 720}, {1920, 1080}, {720, 1280}, {640, 720}}) {
        const OverlayLayout layout = lay_out(content, size, real_letters());
        for (const OverlayTarget& target : layout.targets) {
          // 9 mm at 40 pixels a centimetre; more where the picture is larger.
          const float least = 36.0F * static_cast<float>(std::min(size.width, size.height)) / 720.0F;
          EXPECT_GE(target.width, least) << size.width << "x" << size.height;
          EXPECT_GE(target.height, least) << size.width << "x" << size.height;
          EXPECT_EQ(action_at(layout, target.x + target.width / 2, target.y + target.height / 2), target.action);
        }
        EXPECT_EQ(action_at(layout, 1, 1), std::nullopt);
      }
    }
  }
}

TEST(OverlayLayout, high_contrast_is_opaque_black_under_white_and_yellow_words) {
  picture::OverlayContent content;
  content.style.high_contrast = true;
  content.title = "title";
  content.caption = "caption";
  content.hint = "hint";
  content.goal = "goal";
  content.readouts = {{"Νερό", "12,4", "λίτρα", 0.6, "20", 0.75}};
  const OverlayLayout layout = lay_out(content, {1280, 720}, real_letters());
  EXPECT_EQ(layout.shapes.front().colour, Eigen::Vector4f(0, 0, 0, 1));
  for (const OverlayShape& shape : layout.shapes) {
    EXPECT_EQ(shape.colour.w(), 1);
    EXPECT_GE(std::min(shape.width, shape.height), 8) << "no thin lines";
  }
  for (const OverlayText& text : layout.texts) {
    EXPECT_EQ(text.colour.w(), 1);
    const float luminance = 0.2126F * text.colour.x() + 0.7152F * text.colour.y() + 0.0722F * text.colour.z();
    EXPECT_GT(luminance, 0.75F) << text.text;
  }
}

TEST(OverlayLayout, a_goal_is_a_mark_on_its_gauge) {
  picture::OverlayContent content;
  content.readouts = {{"Water", "12.4", "litres", 0.5, "20"}};
  const std::vector<OverlayShape> without = lay_out(content, {1280, 720}, real_letters()).shapes;
  content.readouts[0].goal = 0.75;
  const std::vector<OverlayShape> with = lay_out(content, {1280, 720}, real_letters()).shapes;
  ASSERT_EQ(with.size(), without.size() + 1);
  const OverlayShape &gauge = with[with.size() - 3], &filled = with[with.size() - 2], &mark = with.back();
  EXPECT_NEAR(mark.x + mark.width / 2, gauge.x + 0.75F * gauge.width, 0.5);
  EXPECT_NEAR(filled.width, 0.5F * gauge.width, 0.5);
  EXPECT_NEAR(mark.y + mark.height / 2, gauge.y + gauge.height / 2, 0.5);
  EXPECT_GT(mark.height, 2 * gauge.height);
}

/// How wide the frame is round what can be pressed; 0: it has none.
float frame_of(const OverlayLayout& layout, const OverlayTarget& target) {
  const auto outer = std::ranges::find_if(layout.shapes, [&](const OverlayShape& shape) {
    return shape.x == target.x && shape.y == target.y && shape.width == target.width && shape.height == target.height;
  });
  if (outer == layout.shapes.end() || std::next(outer) == layout.shapes.end()) return 0;
  const OverlayShape& inner = *std::next(outer);
  const bool within = std::abs(2 * inner.x + inner.width - 2 * outer->x - outer->width) < 1 && inner.y >= outer->y;
  return within ? inner.x - outer->x : 0;
}

TEST(OverlayLayout, the_button_under_the_mouse_has_a_thicker_frame_and_nothing_moves) {
  picture::OverlayContent content;
  content.panel.emplace();
  content.panel->text = "What lifts the water?";
  content.panel->answers = {{{picture::OverlayAction::Kind::answer, "a"}, "Pockets"},
                            {{picture::OverlayAction::Kind::answer, "b"}, "Air"}};
  content.corner = {{{picture::OverlayAction::Kind::language, "el"}, "EL"}};
  for (const bool high_contrast : {false, true}) {
    content.style.high_contrast = high_contrast;
    content.meant.reset();
    const OverlayLayout resting = lay_out(content, {1280, 720}, real_letters());
    ASSERT_EQ(resting.targets.size(), 3U);
    for (std::size_t chosen = 0; chosen < 3; ++chosen) {
      content.meant = resting.targets[chosen].action;
      const OverlayLayout meant = lay_out(content, {1280, 720}, real_letters());
      ASSERT_EQ(meant.targets.size(), 3U);
      for (std::size_t i = 0; i < 3; ++i) {
        const float before = frame_of(resting, resting.targets[i]);
        EXPECT_EQ(meant.targets[i].y, resting.targets[i].y);
        if (i == chosen) {
          EXPECT_GE(frame_of(meant, meant.targets[i]), before + 2) << i << (high_contrast ? ", high contrast" : "");
        } else {
          EXPECT_EQ(frame_of(meant, meant.targets[i]), before) << i;
        }
      }
      ASSERT_EQ(meant.texts.size(), resting.texts.size());
      for (std::size_t i = 0; i < meant.texts.size(); ++i)
        EXPECT_EQ(meant.texts[i].baseline, resting.texts[i].baseline);
    }
  }
}

TEST(OverlayLayout, large_text_is_larger) {
  picture::OverlayContent content;
  content.title = "title";
  const int usual = lay_out(content, {1280, 720}, real_letters()).texts.front().size_px;
  content.style.text_scale = picture::kLargeText;
  EXPECT_NEAR(lay_out(content, {1280, 720}, real_letters()).texts.front().size_px,
              picture::kLargeText * static_cast<float>(usual), 1);
}

// Wherever a thing is seen, its name lies within the picture, and over no panel; where there is room beside its thing, it is there.
RC_GTEST_PROP(OverlayLayout, a_name_lies_over_nothing, ()) {
  picture::OverlayContent content;
  content.title = "Archimedes' screw";
  content.caption = "Turn the crank.";
  content.readouts = {{"Water", "12.4", "litres", 0.6, "20"}};
  content.corner = {{{picture::OverlayAction::Kind::language, "el"}, "EL"}};
  if (*rc::gen::arbitrary<bool>()) content.note = "Press and hold to take it";
  content.style.text_scale = *rc::gen::element(1.0F, picture::kLargeText);
  const picture::PixelSize size =
      *rc::gen::element(picture::PixelSize{1280, 720}, picture::PixelSize{640, 720}, picture::PixelSize{3840, 2160});
  const std::size_t shapes = lay_out(content, size, half_square).shapes.size();
  const auto pixel = [](int low, std::uint32_t high) {
    return static_cast<float>(*rc::gen::inRange(low, static_cast<int>(high) + 200));
  };
  picture::OverlayLabel label;
  label.text = "The barrel";
  label.left = pixel(-200, size.width);
  label.right = label.left + pixel(1, size.width / 8);
  label.top = pixel(-200, size.height);
  label.bottom = label.top + pixel(1, size.height / 4);
  content.label = label;
  const OverlayLayout layout = lay_out(content, size, half_square);
  if (layout.shapes.size() == shapes) {
    // In the middle of a broad picture there always is room.
    const float unit = static_cast<float>(size.height) / 720;
    RC_ASSERT(size.width < 900 || label.top < 290 * unit || label.top > 400 * unit);
    return;
  }
  RC_ASSERT(layout.shapes.size() == shapes + 1);
  RC_ASSERT(layout.texts.back().text == "The barrel");
  const OverlayShape& chip = layout.shapes.back();
  RC_ASSERT(chip.x >= 0 && chip.y >= 0);
  RC_ASSERT(chip.x + chip.width <= static_cast<float>(size.width));
  RC_ASSERT(chip.y + chip.height <= static_cast<float>(size.height));
  RC_ASSERT(chip.y + chip.height <= label.top || chip.y >= label.bottom);
  for (std::size_t i = 0; i + 1 < layout.shapes.size(); ++i) {
    const OverlayShape& other = layout.shapes[i];
    const bool beside = other.x >= chip.x + chip.width || chip.x >= other.x + other.width;
    RC_ASSERT(beside || other.y >= chip.y + chip.height || chip.y >= other.y + other.height);
  }
}

TEST(OverlayLayout, the_corners_of_what_is_meant_are_about_it_or_nowhere) {
  picture::OverlayContent content;
  content.caption = "Turn the crank.";
  const std::size_t bare = lay_out(content, {1280, 720}, half_square).shapes.size();
  content.label = picture::OverlayLabel{"The barrel", 600, 300, 680, 400, true};
  const OverlayLayout layout = lay_out(content, {1280, 720}, half_square);
  ASSERT_EQ(layout.shapes.size(), bare + 9) << "eight arms and the name";
  float left = 1e9F, top = 1e9F, right = 0, bottom = 0;
  for (std::size_t i = bare; i < bare + 8; ++i) {
    const OverlayShape& arm = layout.shapes[i];
    left = std::min(left, arm.x), top = std::min(top, arm.y);
    right = std::max(right, arm.x + arm.width), bottom = std::max(bottom, arm.y + arm.height);
    const bool over = arm.x < 680 && arm.x + arm.width > 600 && arm.y < 400 && arm.y + arm.height > 300;
    EXPECT_FALSE(over) << "it is to be seen";
  }
  EXPECT_EQ(Eigen::Vector4f(left, top, right, bottom), Eigen::Vector4f(594, 294, 686, 406));
  content.label->bottom = 690;  // behind the caption
  EXPECT_EQ(lay_out(content, {1280, 720}, half_square).shapes.size(), bare + 1);
}

TEST(OverlayLayout, a_long_note_is_at_the_top_in_two_lines_and_not_over_what_it_speaks_of) {
  picture::OverlayContent content;
  content.caption = "Put the two pistons into the cylinders.";
  content.readouts = {{"Water", "12.4", "litres", 0.6, "20"}};
  content.note = "Bring it to the blue ring; hold the right button to turn it; the wheel brings it farther or nearer";
  const std::string inset = "Close up";
  for (const std::string* close_up : {static_cast<const std::string*>(nullptr), &inset}) {
    int lines = 0;
    for (const OverlayText& text : lay_out(content, {1280, 720}, real_letters(), close_up).texts) {
      if (content.note.find(text.text) == std::string::npos) continue;
      ++lines;
      EXPECT_LT(text.baseline, 120) << text.text;
    }
    EXPECT_EQ(lines, 2);
  }
}

TEST(OverlayLayout, a_name_goes_away_before_questions) {
  picture::OverlayContent content;
  content.label = picture::OverlayLabel{"The barrel", 600, 300, 680, 400, true};
  EXPECT_EQ(lay_out(content, {1280, 720}, half_square).texts.size(), 1U);
  content.panel.emplace().text = "Did you like it?";
  for (const OverlayText& text : lay_out(content, {1280, 720}, half_square).texts)
    EXPECT_NE(text.text, "The barrel");
}

TEST(OverlayLayout, nothing_to_say_draws_nothing) {
  const OverlayLayout layout = lay_out({}, {1280, 720}, half_square);
  EXPECT_TRUE(layout.shapes.empty());
  EXPECT_TRUE(layout.texts.empty());
}

}  // namespace
}  // namespace mechane::draw
