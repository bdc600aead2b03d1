#include "client-sdk/draw/text/overlay_captions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "client-sdk/draw/text/overlay_sign.hpp"

namespace mechane::draw {
namespace {

constexpr float kPadding = 24;
constexpr float kTitleSize = 18;
constexpr float kTitleLine = 1.2F * kTitleSize;
constexpr float kGoalSize = 21;
constexpr float kCaptionSize = 27;
constexpr float kHintSize = 20;
constexpr float kLineStep = 1.37F;  ///< from a line to the next, of its size
constexpr float kPartGap = 8;
constexpr float kMarkSize = 15;
constexpr float kMostDots = 0.65F;  ///< share of a narrow panel's width
constexpr float kNoteSize = 20;
constexpr float kNotePadding = 20;
constexpr float kNoteEdges = 18;  ///< above and below its lines together
constexpr float kNoteLine = 28;
constexpr float kNoticeSize = 27;
constexpr float kNoticeLine = 36;
constexpr float kNoticeMoreSize = 20;
constexpr float kNoticeMoreLine = 28;
constexpr float kNoticePadding = 20;
constexpr float kNoticeWidest = 760;
constexpr float kSignSize = 84;
/// The note's part of what captions may cover. The rest must have room for a caption's line.
constexpr float kMostNote = 0.48F * kMostCovered;
/// Words become smaller by this factor until they fit, and not below this scale.
constexpr float kSmaller = 0.92F;
constexpr float kLeastWords = 0.3F;

/// Goal, caption and hint, broken at the panel's width.
void break_into_lines(const Page& page, const picture::OverlayContent& content, CaptionPanel& out) {
  const Palette& c = page.colours;
  const std::array<std::pair<LineLook, const std::string*>, 3> parts{
      {{{Face::serif, kGoalSize, c.paper, true}, &content.goal},
       {{Face::regular, kCaptionSize, c.paper, true}, &content.caption},
       {{Face::regular, kHintSize, c.water, true}, &content.hint}}};
  const float inner = out.width - 2 * page.tx(kPadding);
  for (const auto& [look, text] : parts) {
    LineLook line = look;
    for (std::string& words : page.lines(look.face, look.size, *text, inner)) {
      out.lines.push_back(std::move(words));
      out.looks.push_back(line);
      out.heights.push_back({page.tx(line.size * kLineStep), line.begins_part ? page.tx(kPartGap) : 0});
      line.begins_part = false;
    }
  }
}

/// A panel without a page's lines.
float bare_height(const Page& page) {
  return 2 * page.tx(kPadding) + page.tx(kTitleLine) + page.tx(kPartGap);
}

float height_of_lines(const Page& page, float lines) {
  return page.tx(kPartGap) + std::ceil(lines) + lines * page.tx(kCaptionSize * kLineStep);
}

/// Where there is little area, a narrower panel has room for two lines.
float width_for_two_lines(const Page& page, const CaptionLimits& most) {
  const float least = most.least_width > 0 ? most.least_width : 0.5F * most.width;
  return std::floor(std::clamp(most.area / (bare_height(page) + height_of_lines(page, 2)), least, most.width));
}

CaptionPanel measure_at_scale(const Page& page, const picture::OverlayContent& content, const CaptionLimits& most) {
  CaptionPanel out;
  out.scale = page.scale;
  out.width = width_for_two_lines(page, most);
  break_into_lines(page, content, out);
  const float bare = bare_height(page);
  const float room = std::min(most.height, most.area / std::max(out.width, 1.0F)) - bare;
  out.begins = page_begins(out.heights, std::min(room, height_of_lines(page, static_cast<float>(most.lines))));
  out.height = out.lines.empty() ? bare - page.tx(kPartGap) : bare + highest_page(out.heights, out.begins);
  return out;
}

/// Returns the width.
float add_mark(Page& page, float right, float baseline, const std::string& mark) {
  if (mark.empty()) return 0;
  const float width = page.measure(Face::bold, kMarkSize, mark);
  page.add_text(right - width, baseline, Face::bold, kMarkSize, page.colours.quiet, mark);
  return width;
}

/// A title that would reach the mark or the dots is cut: the caption is more important.
void add_title(Page& page, const picture::OverlayContent& content, const Box& box, const std::string& mark) {
  const float padding = page.tx(kPadding);
  const float line = page.tx(kTitleLine);
  const float y = box.y + padding;
  page.add_shape({box.x, y, page.px(page.high_contrast ? 10 : 4), line}, 0, page.colours.gold);
  const std::size_t shapes = page.out.shapes.size();
  float dots = page.add_dots(box.right() - padding, y + line / 2, content.steps_done, content.steps_total);
  if (dots > kMostDots * (box.width - 2 * padding)) {
    page.out.shapes.resize(shapes);
    dots = 0;
  }
  const float beside = box.right() - padding - dots - (dots > 0 ? padding / 2 : 0);
  const float number = add_mark(page, beside, y + page.tx(kTitleSize * 0.95F), mark);
  const float taken = dots + (number > 0 ? number + padding / 2 : 0);
  const float room = box.width - 3 * padding - taken;
  const auto title = page.lines(Face::bold, kTitleSize, content.title, room);
  if (title.empty() || page.measure(Face::bold, kTitleSize, title.front()) > room) return;
  page.add_text(box.x + padding, y + page.tx(kTitleSize * 0.95F), Face::bold, kTitleSize, page.colours.gold,
                title.front());
}

float widest(const Page& page, Face face, float size, const std::vector<std::string>& lines) {
  float most = 0;
  for (const std::string& line : lines)
    most = std::max(most, page.measure(face, size, line));
  return most;
}

float notice_words(const Page& page, const Note& note) {
  return page.tx(kNoticeLine) * static_cast<float>(note.lines.size()) +
         page.tx(kNoticeMoreLine) * static_cast<float>(note.more.size());
}

Note measure_notice(const Page& page, const picture::OverlayNotice& notice, float most) {
  Note note;
  note.sign = notice.sign;
  note.scale = page.scale;
  most = std::min(most, page.tx(kNoticeWidest));
  const float beside = page.tx(kSignSize + 3 * kNoticePadding);
  note.lines = page.lines(Face::bold, kNoticeSize, notice.text, most - beside);
  note.more = page.lines(Face::regular, kNoticeMoreSize, notice.more, most - beside);
  note.rows = note.lines.size() + note.more.size();
  note.width = beside + std::max(widest(page, Face::bold, kNoticeSize, note.lines),
                                 widest(page, Face::regular, kNoticeMoreSize, note.more));
  note.height = std::max(page.tx(kSignSize), notice_words(page, note)) + 2 * page.tx(kNoticePadding);
  return note;
}

/// A text without a sign; no lines: not even one fits in `area`.
Note measure_words(const Page& page, const picture::OverlayContent& content, float most, float area, std::size_t rows) {
  const std::string& text = content.note.empty() ? content.message : content.note;
  const float padding = page.tx(kNotePadding);
  const float edges = page.tx(kNoteEdges);
  Note note;
  note.scale = page.scale;
  // The page's mark has a column of its own, where there are pages.
  for (const float mark : {0.0F, page.measure(Face::bold, kMarkSize, "9/9") + padding / 2}) {
    const auto lines = page.lines(Face::regular, kNoteSize, text, most - 2 * padding - mark);
    note.width = widest(page, Face::regular, kNoteSize, lines) + 2 * padding + mark;
    const std::vector<PageLine> heights(lines.size(), {page.tx(kNoteLine), 0});
    const auto begins =
        page_begins(heights, std::min(area / note.width - edges, static_cast<float>(rows) * page.tx(kNoteLine)));
    const ShownPage shown = begins.empty() ? ShownPage{} : page_at(lines, begins, content.note_for_s);
    const auto first = lines.begin();
    note.lines.assign(first + static_cast<std::ptrdiff_t>(shown.first),
                      first + static_cast<std::ptrdiff_t>(shown.last));
    note.mark = shown.mark;
    note.height = edges + highest_page(heights, begins);
    note.rows = static_cast<std::size_t>(std::lround((note.height - edges) / page.tx(kNoteLine)));
    if (begins.size() < 2) break;
  }
  return note;
}

void add_notice(Page& page, const Note& note, const Box& box) {
  page.add_panel(box);
  const float padding = page.tx(kNoticePadding);
  const float side = page.tx(kSignSize);
  add_sign(page, *note.sign, {box.x + padding, std::round(box.y + (box.height - side) / 2), side, side});
  const float x = box.x + 2 * padding + side;
  float at = box.y + (box.height - notice_words(page, note)) / 2;
  for (const std::string& line : note.lines) {
    page.add_text(x, at + page.tx(0.75F * kNoticeLine), Face::bold, kNoticeSize, page.colours.paper, line);
    at += page.tx(kNoticeLine);
  }
  for (const std::string& line : note.more) {
    page.add_text(x, at + page.tx(0.75F * kNoticeMoreLine), Face::regular, kNoticeMoreSize, page.colours.paper, line);
    at += page.tx(kNoticeMoreLine);
  }
}

}  // namespace

CaptionPanel measure_caption(Page& page, const picture::OverlayContent& content, const CaptionLimits& most) {
  if (content.caption.empty() && content.title.empty()) return {};
  const float wanted = page.scale;
  CaptionPanel panel = measure_at_scale(page, content, most);
  while (panel.begins.empty() && !panel.lines.empty() && page.scale > kLeastWords) {
    page.scale *= kSmaller;
    panel = measure_at_scale(page, content, most);
  }
  page.scale = wanted;
  return panel;
}

void add_caption(Page& page, const picture::OverlayContent& content, const CaptionPanel& panel, const Box& box) {
  const float wanted = std::exchange(page.scale, panel.scale);
  const ShownPage shown = page_at(panel.lines, panel.begins, content.caption_for_s);
  page.add_panel(box);
  add_title(page, content, box, shown.mark);
  float at = box.y + page.tx(kPadding) + page.tx(kTitleLine) + page.tx(kPartGap);
  // Not even a line fits where there are no pages.
  for (std::size_t i = shown.first; i < shown.last && !panel.begins.empty(); ++i) {
    const LineLook& look = panel.looks[i];
    if (look.begins_part && i > shown.first) at += page.tx(kPartGap);
    page.add_text(box.x + page.tx(kPadding), at + page.tx(look.size * 1.02F), look.face, look.size, look.colour,
                  panel.lines[i]);
    at += page.tx(look.size * kLineStep);
  }
  page.scale = wanted;
}

Note measure_note(Page& page, const picture::OverlayContent& content, float most, std::size_t rows) {
  Note note;
  if (!content.notice && content.note.empty() && content.message.empty()) return note;
  const float area = kMostNote * page.width * page.height;
  const float wanted = page.scale;
  for (bool fits = false; !fits && page.scale > kLeastWords; page.scale *= kSmaller) {
    note =
        content.notice ? measure_notice(page, *content.notice, most) : measure_words(page, content, most, area, rows);
    fits = !note.lines.empty() && note.width * note.height <= area;
  }
  page.scale = wanted;
  return note;
}

void add_note(Page& page, const Note& note, const Box& box) {
  const float wanted = std::exchange(page.scale, note.scale);
  if (note.sign) {
    add_notice(page, note, box);
  } else {
    page.add_shape(box, std::min(box.height / 2, page.tx(23)), page.colours.ink);
    float at = box.y + page.tx(30);
    for (const std::string& line : note.lines) {
      page.add_text(box.x + page.tx(kNotePadding), at, Face::regular, kNoteSize, page.colours.paper, line);
      at += page.tx(kNoteLine);
    }
    add_mark(page, box.right() - page.tx(kNotePadding), at - page.tx(kNoteLine), note.mark);
  }
  page.scale = wanted;
}

}  // namespace mechane::draw
