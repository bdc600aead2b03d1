#include "client-sdk/draw/text/overlay_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "client-sdk/draw/text/overlay_page.hpp"
#include "client-sdk/draw/text/overlay_sign.hpp"

namespace mechane::draw {
namespace {

constexpr float kPadding = 24;
constexpr float kTitleSize = 18;
constexpr float kGoalSize = 21;
constexpr float kCaptionSize = 27;
constexpr float kHintSize = 20;
constexpr float kNoteSize = 20;
constexpr float kLabelSize = 21;
constexpr float kNoticeSize = 27;
constexpr float kNoticeLine = 36;
constexpr float kNoticeMoreSize = 20;
constexpr float kNoticeMoreLine = 28;
constexpr float kNoticePadding = 20;
constexpr float kNoticeWidest = 760;
constexpr float kSignSize = 84;

/// The content of a caption panel under its title, from top to bottom.
struct CaptionPart {
  Face face;
  float size;
  Eigen::Vector4f colour;
  const std::string& text;
};

/// Adds the lines under the title from y = 0 on; returns the height with the padding.
float add_caption_lines(Page& page, const picture::OverlayContent& content, float x, float inner) {
  const Palette& c = page.colours;
  const std::array<CaptionPart, 3> parts{{{Face::serif, kGoalSize, c.paper, content.goal},
                                          {Face::regular, kCaptionSize, c.paper, content.caption},
                                          {Face::regular, kHintSize, c.water, content.hint}}};
  float at = page.tx(kPadding) + page.tx(kTitleSize * 1.2F);
  for (const CaptionPart& part : parts) {
    const auto lines = page.lines(part.face, part.size, part.text, inner);
    if (!lines.empty()) at += page.tx(8);
    for (const std::string& line : lines) {
      page.add_text(x, at + page.tx(part.size * 1.02F), part.face, part.size, part.colour, line);
      at += page.tx(part.size * 1.37F);
    }
  }
  return at + page.tx(kPadding);
}

/// Adds the panel at the bottom of `room`; words become smaller until it fits. Returns its place.
Box add_caption(Page& page, const picture::OverlayContent& content, const Box& room) {
  if (content.caption.empty() && content.title.empty()) return {};
  const float wanted = page.scale;
  const std::size_t texts = page.out.texts.size();
  float height = 0;
  float padding = 0;
  for (;; page.scale *= 0.92F) {
    padding = page.tx(kPadding);
    page.out.texts.resize(texts);
    height = add_caption_lines(page, content, room.x + padding, room.width - 2 * padding);
    if (height <= room.height || page.scale < 0.3F) break;
  }
  // Still too many words, or almost no room: only the first ones.
  while (height > room.height && page.out.texts.size() > texts) {
    page.out.texts.pop_back();
    const OverlayText* last = page.out.texts.size() > texts ? &page.out.texts.back() : nullptr;
    height = (last == nullptr ? page.tx(kTitleSize * 1.2F) + padding : last->baseline + page.tx(8)) + padding;
  }
  const Box box{room.x, room.below() - height, room.width, height};
  page.move_down(page.out.shapes.size(), texts, page.out.targets.size(), box.y);
  page.add_panel(box);
  const float title_line = page.tx(kTitleSize * 1.2F);
  page.add_shape({box.x, box.y + padding, page.px(page.high_contrast ? 10 : 4), title_line}, 0, page.colours.gold);
  const float dots =
      page.add_dots(box.right() - padding, box.y + padding + title_line / 2, content.steps_done, content.steps_total);
  // A title that would reach the dots is cut: the caption is more important.
  const auto title = page.lines(Face::bold, kTitleSize, content.title, box.width - 3 * padding - dots);
  if (!title.empty()) {
    page.add_text(box.x + padding, box.y + padding + page.tx(kTitleSize * 0.95F), Face::bold, kTitleSize,
                  page.colours.gold, title.front());
  }
  page.scale = wanted;
  return box;
}

/// A narrow picture has no room for labels beside the machine: the unit alone must explain the number, unless the author has named it.
struct ReadoutSizes {
  bool narrow, labelled;
  float padding, width, row, label, number;
};

/// The values of the whole bar.
std::string range_of(const picture::Readout& readout) {
  return readout.begin + (readout.begin.starts_with('-') ? " … " : "–") + readout.end;
}

/// What a label and the range beside it need at least.
float label_width(const Page& page, const picture::Readout& readout) {
  return page.measure(Face::regular, 15, readout.label) + page.tx(12) +
         page.measure(Face::regular, 13, range_of(readout));
}

ReadoutSizes readout_sizes(const Page& page, const std::vector<picture::Readout>& readouts) {
  const bool narrow = page.width < page.px(900);
  const bool labelled = !narrow || std::ranges::any_of(readouts, &picture::Readout::named);
  ReadoutSizes s{narrow,
                 labelled,
                 page.tx(narrow ? 14 : 18),
                 page.tx(224),
                 page.tx(narrow ? 56 : 92),
                 page.tx(labelled ? 21 : 0),
                 narrow ? 28.F : 34.F};
  if (narrow) s.row += s.label;
  // The author's words may need more room; beyond that they are cut.
  for (const picture::Readout& readout : readouts) {
    if (readout.named) s.width = std::max(s.width, std::min(label_width(page, readout) + 2 * s.padding, page.tx(330)));
  }
  return s;
}

/// The beginning of a text that fits, with a sign that it goes on.
std::string cut_to(const Page& page, const std::string& text, float width) {
  if (page.measure(Face::regular, 15, text) <= width) return text;
  const auto lines = page.lines(Face::regular, 15, text, width - page.measure(Face::regular, 15, " …"));
  return lines.empty() ? std::string() : lines.front() + " …";
}

/// A mark across the bar.
void add_goal(Page& page, float x, float middle) {
  const float width = page.tx(page.high_contrast ? 8 : 4);
  const float height = page.tx(page.high_contrast ? 24 : 18);
  page.add_shape(
      {x - width / 2, middle - height / 2, width, height}, width / 2,
      page.high_contrast ? page.colours.paper : page.colours.gold);  // with high contrast the filled part is gold
}

void add_readout(Page& page, const picture::Readout& readout, const ReadoutSizes& s, float x, float y) {
  const Palette& c = page.colours;
  const float right = x + s.width - 2 * s.padding;
  const float baseline = y + s.label + page.tx(s.narrow ? 24 : 30);
  if (s.labelled) {
    const std::string range = range_of(readout);
    const float range_x = right - page.measure(Face::regular, 13, range);
    page.add_text(x, y + page.tx(13), Face::regular, 15, c.quiet,
                  cut_to(page, readout.label, range_x - page.tx(12) - x));
    page.add_text(range_x, y + page.tx(13), Face::regular, 13, c.quiet, range);
  }
  page.add_text(x, baseline, Face::bold, s.number, c.paper, readout.value);
  const float value_width = page.measure(Face::bold, s.number, readout.value);
  page.add_text(x + value_width + page.tx(7), baseline, Face::regular, 17, c.quiet, readout.unit);
  const float bar = page.tx(page.high_contrast ? 10 : 6);
  const float bar_y = baseline + page.tx(s.narrow ? 9 : 12);
  const float full = right - x;
  page.add_shape({x, bar_y, full, bar}, bar / 2, c.faint);
  const float filled = full * static_cast<float>(std::clamp(readout.fraction, 0.0, 1.0));
  if (filled >= bar) page.add_shape({x, bar_y, filled, bar}, bar / 2, c.water);
  if (readout.goal) add_goal(page, x + full * static_cast<float>(std::clamp(*readout.goal, 0.0, 1.0)), bar_y + bar / 2);
}

/// Adds as many readouts as fit above `below`, in their order.
Box add_readouts(Page& page, const picture::OverlayContent& content, const std::vector<Box>& others) {
  const ReadoutSizes s = readout_sizes(page, content.readouts);
  Box box{page.width - page.margin() - s.width, page.margin(), s.width, 0};
  float below = page.height - page.margin();
  for (const Box& other : others)
    if (!other.empty() && other.shares_columns(box)) below = std::min(below, other.y - page.gap());
  const float edges = 2 * s.padding - page.tx(12);
  const float rows = std::floor((below - box.y - edges) / s.row);
  const auto count = std::min(content.readouts.size(), static_cast<std::size_t>(std::max(rows, 0.0F)));
  if (count == 0) return {};
  box.height = static_cast<float>(count) * s.row + edges;
  page.add_panel(box);
  for (std::size_t i = 0; i < count; ++i) {
    add_readout(page, content.readouts[i], s, box.x + s.padding, box.y + s.padding + static_cast<float>(i) * s.row);
  }
  return box;
}

/// A note about the link, or a notice with its sign: its lines, measured.
struct Note {
  std::optional<picture::OverlayNotice::Sign> sign;
  std::vector<std::string> lines, more;
  float width = 0, height = 0;
  [[nodiscard]] std::size_t count() const { return lines.size() + more.size(); }
};

float widest(const Page& page, Face face, float size, const std::vector<std::string>& lines) {
  float most = 0;
  for (const std::string& line : lines)
    most = std::max(most, page.measure(face, size, line));
  return most;
}

Note measure_notice(const Page& page, const picture::OverlayNotice& notice, float most) {
  Note note;
  note.sign = notice.sign;
  most = std::min(most, page.tx(kNoticeWidest));
  const float beside = page.tx(kSignSize + 3 * kNoticePadding);
  note.lines = page.lines(Face::bold, kNoticeSize, notice.text, most - beside);
  note.more = page.lines(Face::regular, kNoticeMoreSize, notice.more, most - beside);
  note.width = beside + std::max(widest(page, Face::bold, kNoticeSize, note.lines),
                                 widest(page, Face::regular, kNoticeMoreSize, note.more));
  const float words = page.tx(kNoticeLine) * static_cast<float>(note.lines.size()) +
                      page.tx(kNoticeMoreLine) * static_cast<float>(note.more.size());
  note.height = std::max(page.tx(kSignSize), words) + 2 * page.tx(kNoticePadding);
  return note;
}

Note measure_note(const Page& page, const picture::OverlayContent& content, float most) {
  if (content.notice) return measure_notice(page, *content.notice, most);
  Note note;
  const float padding = page.tx(20);
  note.lines =
      page.lines(Face::regular, kNoteSize, content.note.empty() ? content.message : content.note, most - 2 * padding);
  if (note.lines.empty()) return note;
  note.width = widest(page, Face::regular, kNoteSize, note.lines) + 2 * padding;
  note.height = page.tx(18) + static_cast<float>(note.lines.size()) * page.tx(28);
  return note;
}

void add_notice_words(Page& page, const Note& note, const Box& box) {
  const float padding = page.tx(kNoticePadding);
  const float side = page.tx(kSignSize);
  add_sign(page, *note.sign, {box.x + padding, std::round(box.y + (box.height - side) / 2), side, side});
  const float x = box.x + 2 * padding + side;
  const float words = page.tx(kNoticeLine) * static_cast<float>(note.lines.size()) +
                      page.tx(kNoticeMoreLine) * static_cast<float>(note.more.size());
  float at = box.y + (box.height - words) / 2;
  for (const std::string& line : note.lines) {
    page.add_text(x, at + page.tx(0.75F * kNoticeLine), Face::bold, kNoticeSize, page.colours.paper, line);
    at += page.tx(kNoticeLine);
  }
  for (const std::string& line : note.more) {
    page.add_text(x, at + page.tx(0.75F * kNoticeMoreLine), Face::regular, kNoticeMoreSize, page.colours.paper, line);
    at += page.tx(kNoticeMoreLine);
  }
}

/// A note stands in the middle, a notice begins at `left`.
Box add_note(Page& page, const Note& note, float left, float y) {
  const Box box{note.sign ? left : std::round((page.width - note.width) / 2), y, note.width, note.height};
  if (note.sign) {
    page.add_panel(box);
    add_notice_words(page, note, box);
    return box;
  }
  page.add_shape(box, std::min(box.height / 2, page.tx(23)), page.colours.ink);
  float at = y + page.tx(30);
  for (const std::string& line : note.lines) {
    page.add_text(box.x + page.tx(20), at, Face::regular, kNoteSize, page.colours.paper, line);
    at += page.tx(28);
  }
  return box;
}

Box united(const Box& a, const Box& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  const float x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.right(), b.right()) - x, std::max(a.below(), b.below()) - y};
}

bool overlap(const Box& a, const Box& b) {
  return !a.empty() && !b.empty() && a.shares_columns(b) && a.y < b.below() && b.y < a.below();
}

/// The corners around a thing, to show which one is meant where several stand close together.
void add_corners(Page& page, const Box& thing) {
  const float line = page.px(page.high_contrast ? 8 : 3);
  const float arm = std::max(std::round(0.22F * std::min(thing.width, thing.height)), line);
  for (const float x : {thing.x, thing.right() - arm}) {
    for (const float y : {thing.y, thing.below() - line})
      page.add_shape({x, y, arm, line}, 0, page.colours.gold);
  }
  for (const float x : {thing.x, thing.right() - line}) {
    for (const float y : {thing.y, thing.below() - arm})
      page.add_shape({x, y, line, arm}, 0, page.colours.gold);
  }
}

/// Places a label above its thing, or below it, where there is nothing else: panels are more important.
void add_label(Page& page, const picture::OverlayLabel& label, const std::vector<Box>& others) {
  const float room = page.width - 2 * page.margin();
  const auto lines = page.lines(Face::bold, kLabelSize, label.text, room);
  if (lines.empty()) return;
  const auto is_free = [&](const Box& box) {
    const bool within = box.x >= 0 && box.y >= 0 && box.right() <= page.width && box.below() <= page.height;
    return within && std::ranges::none_of(others, [&](const Box& other) { return overlap(box, other); });
  };
  const float gap = page.px(6);
  const Box thing{std::round(label.left - gap), std::round(label.top - gap),
                  std::round(label.right - label.left + 2 * gap), std::round(label.bottom - label.top + 2 * gap)};
  if (label.framed && is_free(thing)) add_corners(page, thing);
  const float padding = page.tx(14);
  const float width = std::min(page.measure(Face::bold, kLabelSize, lines.front()) + 2 * padding, room);
  const float height = page.tx(38);
  const float middle = (label.left + label.right) / 2;
  const float x = std::round(std::clamp(middle - width / 2, page.margin(), page.width - page.margin() - width));
  for (const float y : {thing.y - page.px(4) - height, thing.below() + page.px(4)}) {
    const Box box{x, std::round(y), width, height};
    if (!is_free(box)) continue;
    page.add_shape(box, page.tx(10), page.colours.ink);
    return page.add_text(x + padding, box.y + page.tx(26), Face::bold, kLabelSize, page.colours.paper, lines.front());
  }
}

Box inset_box(picture::PixelSize size) {
  const PixelRectangle inset = inset_rectangle(size);
  return {static_cast<float>(inset.x), static_cast<float>(inset.y), static_cast<float>(inset.width),
          static_cast<float>(inset.height)};
}

void add_inset_frame(Page& page, const Box& inset, const std::string& caption) {
  const auto [x, y, width, height] = inset;
  const float line = std::max(page.px(page.high_contrast ? 6 : 3), 1.0F);
  Eigen::Vector4f frame = page.colours.ink;
  frame.w() = 1;
  const auto lines = page.lines(Face::regular, 15, caption, width - 2 * page.px(14));
  const float strip = page.tx(30);
  page.add_shape({x, y + height - strip, width, strip}, 0, page.colours.ink);
  page.add_shape({x - line, y - line, width + 2 * line, line}, 0, frame);
  page.add_shape({x - line, y + height, width + 2 * line, line}, 0, frame);
  page.add_shape({x - line, y, line, height}, 0, frame);
  page.add_shape({x + width, y, line, height}, 0, frame);
  if (!lines.empty()) {
    page.add_text(x + page.px(14), y + height - page.tx(10), Face::regular, 15, page.colours.paper, lines.front());
  }
}

/// The caption's room: beside the buttons if there is enough width, otherwise above them.
Box caption_room(const Page& page, const Box& corner, float top) {
  const float margin = page.margin();
  const float wanted = std::min(page.width - 2 * margin, page.tx(820));
  const float beside = corner.empty() ? wanted : corner.x - page.gap() - margin;
  const bool fits = beside >= std::min(wanted, page.tx(600));
  const float below = fits ? page.height - margin : corner.y - page.gap();
  return {margin, top, fits ? std::min(wanted, beside) : wanted, below - top};
}

void lay_out_panel(Page& page, const picture::OverlayContent& content, const Box& corner) {
  const float margin = page.margin();
  const Note note = measure_note(page, content, page.width - 2 * margin);
  float top = margin;
  if (!note.lines.empty()) top = add_note(page, note, margin, top).below() + page.gap();
  const float below = corner.empty() ? page.height - margin : corner.y - page.gap();
  add_question_panel(page, *content.panel, {margin, top, page.width - 2 * margin, below - top});
}

void lay_out_pose(Page& page, const picture::OverlayPose& pose, const Box& corner) {
  const float margin = page.margin();
  const float below = corner.empty() ? page.height - margin : corner.y - page.gap();
  add_pose(page, pose, {margin, margin, page.width - 2 * margin, below - margin});
}

void lay_out_captions(Page& page, const picture::OverlayContent& content, const Box& corner, const Box& inset) {
  const float gap = page.gap();
  const float margin = page.margin();
  const ReadoutSizes readout = readout_sizes(page, content.readouts);
  const float readouts = page.width - margin - (content.readouts.empty() ? 0 : readout.width + gap);
  // At the top, a note in the middle and a notice over the caption, if it needs few lines; otherwise above the caption.
  const float middle = page.width / 2;
  const float left = inset.empty() ? margin : inset.right() + gap;
  const float room = content.notice ? readouts - left : 2 * std::min(readouts - middle, middle - left);
  Note note = measure_note(page, content, std::max(room, page.tx(240)));
  const bool note_above = note.width <= room && note.count() <= 3;
  if (!note_above) note = measure_note(page, content, page.width - 2 * margin);
  float top = inset.empty() ? margin : inset.below() + gap;
  // At least one readout is placed before a long caption.
  if (!content.readouts.empty()) top = std::max(top, margin + 2 * readout.padding + readout.row + gap);
  if (!note.lines.empty()) top = note_above ? std::max(top, margin + note.height + gap) : top + note.height + gap;
  const Box caption = add_caption(page, content, caption_room(page, corner, top));
  if (!caption.empty()) page.out.covered_below = 1 - caption.y / page.height;
  float low = page.height - margin + gap;
  for (const Box& box : {caption, corner})
    if (!box.empty()) low = std::min(low, box.y);
  Box said;
  if (!note.lines.empty())
    said = note_above ? add_note(page, note, left, margin) : add_note(page, note, margin, low - gap - note.height);
  const Box numbers = add_readouts(page, content, {caption, corner, said});
  if (content.label) add_label(page, *content.label, {caption, corner, said, inset, numbers});
}

}  // namespace

PixelRectangle inset_rectangle(picture::PixelSize size) {
  const float unit = overlay_unit(size);
  const auto px = [unit](float design) { return static_cast<std::uint32_t>(std::lround(design * unit)); };
  // A narrow picture has little room beside the readouts.
  const float width = static_cast<float>(size.width) < 900 * unit ? 220 : 300;
  return {px(36), px(36), px(width), px(0.68F * width)};
}

std::vector<std::string> break_lines(std::string_view text, float width,
                                     const std::function<float(std::string_view)>& measure) {
  std::vector<std::string> lines;
  std::string line;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(" \n\t", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end + 1;
    if (word.empty()) continue;
    std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
    if (!line.empty() && measure(longer) > width) {
      lines.push_back(std::move(line));
      line = std::string(word);
    } else {
      line = std::move(longer);
    }
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

OverlayLayout lay_out(const picture::OverlayContent& content, picture::PixelSize size, const MeasureText& measure,
                      const std::string* inset_caption) {
  Page page(size, content.style, measure);
  page.out.size = size;
  page.meant = content.meant;
  for (const picture::OverlayDot& dot : content.dots)
    page.add_shape({dot.x - dot.radius, dot.y - dot.radius, 2 * dot.radius, 2 * dot.radius}, dot.radius, dot.colour);
  Box inset;
  const bool in_front = content.panel || content.pose;
  if (inset_caption != nullptr && !in_front) {
    inset = inset_box(size);
    add_inset_frame(page, inset, *inset_caption);
  }
  if (in_front) page.add_shape({0, 0, page.width, page.height}, 0, page.colours.veil);
  const Box corner = add_corner(page, content.corner);
  if (content.panel) {
    lay_out_panel(page, content, corner);
  } else if (content.pose) {
    lay_out_pose(page, *content.pose, corner);
  } else {
    const Box code = content.code ? add_code(page, *content.code, corner) : Box();
    lay_out_captions(page, content, united(corner, code), inset);
  }
  return std::move(page.out);
}

std::optional<picture::OverlayAction> action_at(const OverlayLayout& layout, double x, double y) {
  for (const OverlayTarget& target : layout.targets) {
    if (x >= target.x && y >= target.y && x < target.x + target.width && y < target.y + target.height)
      return target.action;
  }
  return std::nullopt;
}

}  // namespace mechane::draw
