#include "client-sdk/draw/text/overlay_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client-sdk/draw/text/overlay_captions.hpp"
#include "client-sdk/draw/text/overlay_page.hpp"
#include "client-sdk/draw/text/overlay_place.hpp"

namespace mechane::draw {
namespace {

constexpr float kLabelSize = 21;
constexpr std::size_t kNoteRows = 3;  ///< of a note at the top, on a page
/// More things than visitors can look at; the search for a place takes longer with each.
constexpr std::size_t kMostSeen = 16;
/// A caption that gives way may be smaller: share of its width, lines of a page, and what that costs beside the costs of places. The last is
/// the smallest.
struct SmallerPanel {
  float width;
  std::size_t lines;
  float cost;
};
constexpr SmallerPanel kSmallerPanels[] = {
    {0.75F, 99, 0.1F}, {0.75F, 2, 0.2F}, {0.55F, 99, 0.25F}, {0.55F, 2, 0.3F}, {0.55F, 1, 0.6F}};

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

/// The panel of as many readouts as fit above the others, in their order. Empty: none fits.
Box readouts_box(const Page& page, const picture::OverlayContent& content, const std::vector<Box>& others) {
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
  return box;
}

void add_readouts(Page& page, const picture::OverlayContent& content, const Box& box) {
  if (box.empty()) return;
  const ReadoutSizes s = readout_sizes(page, content.readouts);
  page.add_panel(box);
  const auto count = static_cast<std::size_t>(std::lround((box.height - 2 * s.padding) / s.row));
  for (std::size_t i = 0; i < count; ++i) {
    add_readout(page, content.readouts[i], s, box.x + s.padding, box.y + s.padding + static_cast<float>(i) * s.row);
  }
}

Box united(const Box& a, const Box& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  const float x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.right(), b.right()) - x, std::max(a.below(), b.below()) - y};
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

/// Places a label above its thing, or below it, where there is nothing else: panels are more important. Of the two it takes the one that
/// covers nothing of `seen`, if there is one.
void add_label(Page& page, const picture::OverlayLabel& label, const std::vector<Box>& others,
               const std::vector<Box>& seen) {
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
  std::vector<Box> places;
  for (const float y : {thing.y - page.px(4) - height, thing.below() + page.px(4)})
    if (const Box box{x, std::round(y), width, height}; is_free(box)) places.push_back(box);
  if (places.empty()) return;
  const auto hides = [&](const Box& box) {
    return std::ranges::any_of(seen, [&](const Box& other) { return overlap(box, other); });
  };
  const Box& box = hides(places.front()) && !hides(places.back()) ? places.back() : places.front();
  page.add_shape(box, page.tx(10), page.colours.ink);
  page.add_text(x + padding, box.y + page.tx(26), Face::bold, kLabelSize, page.colours.paper, lines.front());
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
  if (!note.lines.empty()) {
    const Box said{note.sign ? margin : std::round((page.width - note.width) / 2), margin, note.width, note.height};
    add_note(page, note, said);
    top = said.below() + page.gap();
  }
  const float below = corner.empty() ? page.height - margin : corner.y - page.gap();
  add_question_panel(page, *content.panel, {margin, top, page.width - 2 * margin, below - top});
}

void lay_out_pose(Page& page, const picture::OverlayPose& pose, const Box& corner) {
  const float margin = page.margin();
  const float below = corner.empty() ? page.height - margin : corner.y - page.gap();
  add_pose(page, pose, {margin, margin, page.width - 2 * margin, below - margin});
}

picture::PictureBox picture_box(const Box& box) {
  return {box.x, box.y, box.right(), box.below()};
}

/// The caption and the note beside each other, and beside what else is on the page.
class CaptionLayout {
 public:
  CaptionLayout(Page& page, const picture::OverlayContent& content, const Box& corner, const Box& inset)
      : page_(page), content_(content), corner_(corner), inset_(inset) {}

  void add() {
    measure();
    place_as_usual();
    if (!caption_.empty()) page_.out.covered_below = 1 - caption_.y / page_.height;
    give_way();
    if (!caption_.empty()) {
      add_caption(page_, content_, panel_, caption_);
      page_.out.caption = picture_box(caption_);
    }
    if (!said_.empty()) {
      add_note(page_, note_, said_);
      page_.out.note = picture_box(said_);
    }
    const Box numbers = readouts_box(page_, content_, {caption_, corner_, said_});
    add_readouts(page_, content_, numbers);
    if (content_.label) add_label(page_, *content_.label, {caption_, corner_, said_, inset_, numbers}, around_.seen);
  }

 private:
  /// At the top, a note in the middle and a notice over the caption, if it needs few lines; otherwise above the caption.
  void measure() {
    const float gap = page_.gap();
    const float margin = page_.margin();
    const ReadoutSizes readout = readout_sizes(page_, content_.readouts);
    const float readouts = page_.width - margin - (content_.readouts.empty() ? 0 : readout.width + gap);
    const float middle = page_.width / 2;
    left_ = inset_.empty() ? margin : inset_.right() + gap;
    const float room = content_.notice ? readouts - left_ : 2 * std::min(readouts - middle, middle - left_);
    note_ = measure_note(page_, content_, std::max(room, page_.tx(240)), kNoteRows);
    note_above_ = note_.width <= room && note_.rows <= kNoteRows;
    if (!note_above_) note_ = measure_note(page_, content_, page_.width - 2 * margin);
    float top = inset_.empty() ? margin : inset_.below() + gap;
    // At least one readout is placed before a long caption.
    if (!content_.readouts.empty()) top = std::max(top, margin + 2 * readout.padding + readout.row + gap);
    if (!note_.lines.empty()) top = note_above_ ? std::max(top, margin + note_.height + gap) : top + note_.height + gap;
    room_ = caption_room(page_, corner_, top);
    const float note = note_.lines.empty() ? 0 : note_.width * note_.height;
    most_ = {room_.width, room_.height, kMostCovered * page_.width * page_.height - note};
    panel_ = measure_caption(page_, content_, most_);
  }

  void place_as_usual() {
    caption_ = usual_for(panel_);
    if (note_.lines.empty()) return;
    const float margin = page_.margin();
    float low = page_.height - margin + page_.gap();
    for (const Box& box : {caption_, corner_})
      if (!box.empty()) low = std::min(low, box.y);
    const float x = !note_.sign ? std::round((page_.width - note_.width) / 2) : note_above_ ? left_ : margin;
    said_ = {x, note_above_ ? margin : low - page_.gap() - note_.height, note_.width, note_.height};
  }

  [[nodiscard]] Box usual_for(const CaptionPanel& panel) const {
    return panel.height > 0 ? Box{room_.x, room_.below() - panel.height, panel.width, panel.height} : Box{};
  }

  /// The note gives way first: it is smaller.
  void give_way() {
    const float margin = page_.margin();
    around_.bounds = {margin, margin, page_.width - 2 * margin, page_.height - 2 * margin};
    around_.fixed = {corner_, inset_, readouts_box(page_, content_, {corner_})};
    around_.gap = page_.gap();
    around_.away = page_.gap();
    const Box whole{0, 0, page_.width, page_.height};
    for (const picture::PictureBox& box : content_.keep_off) {
      const Box seen{box.left, box.top, box.right - box.left, box.bottom - box.top};
      if (overlap(seen, whole) && around_.seen.size() < kMostSeen) around_.seen.push_back(seen);
    }
    if (!said_.empty() && (was_away(said_, content_.note_at) || !around_.is_seen_beside(said_))) {
      around_.fixed.push_back(caption_);
      said_ = moved(said_, content_.note_at);
      around_.fixed.pop_back();
    }
    around_.fixed.push_back(said_);
    if (!caption_.empty() && (was_away(caption_, content_.caption_at) || !around_.is_seen_beside(caption_)))
      move_caption();
  }

  /// Whether it was elsewhere in the last picture.
  [[nodiscard]] static bool was_away(const Box& usual, const std::optional<picture::PictureBox>& last) {
    return last && *last != picture_box(usual);
  }

  /// As it was in the last picture, or as usual, or elsewhere.
  [[nodiscard]] Box moved(const Box& usual, const std::optional<picture::PictureBox>& last) const {
    const auto kept = where_it_was(usual, last);
    if (kept && around_.is_seen_beside(*kept)) return *kept;
    if (around_.is_seen_beside(usual)) return usual;
    if (const auto place = free_place(around_, usual)) return place->box;
    return least_covering_place(around_, usual).value_or(usual);
  }

  /// Its last place, if a panel of this size was there.
  [[nodiscard]] std::optional<Box> where_it_was(const Box& usual,
                                                const std::optional<picture::PictureBox>& last) const {
    if (!last) return {};
    const Box box{last->left, last->top, last->right - last->left, last->bottom - last->top};
    const bool same = std::abs(box.width - usual.width) < 1 && std::abs(box.height - usual.height) < 1;
    const bool free = std::ranges::none_of(around_.fixed, [&](const Box& other) { return overlap(box, other); });
    return same && free ? std::optional(Box{box.x, box.y, usual.width, usual.height}) : std::nullopt;
  }

  /// To the cheapest place, whole, or narrower or lower with more pages.
  void move_caption() {
    const Box usual = caption_;
    std::vector<CaptionPanel> panels{panel_};
    const auto take = [&](std::size_t i, const Box& box) {
      panel_ = panels[i];
      caption_ = box;
    };
    for (const SmallerPanel& smaller : kSmallerPanels) {
      CaptionLimits most = most_;
      most.width = most.least_width = std::round(smaller.width * panel_.width);
      most.lines = smaller.lines;
      panels.push_back(measure_caption(page_, content_, most));
    }
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const auto kept = where_it_was(usual_for(panels[i]), content_.caption_at);
      if (kept && around_.is_seen_beside(*kept)) return take(i, *kept);
    }
    if (around_.is_seen_beside(usual)) return;
    float least_cost = std::numeric_limits<float>::max();
    std::optional<std::pair<std::size_t, Box>> best;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      const auto place = free_place(around_, usual_for(panels[i]));
      const float cost = place ? place->cost + (i == 0 ? 0 : kSmallerPanels[i - 1].cost) : least_cost;
      if (cost >= least_cost) continue;
      least_cost = cost;
      best = {i, place->box};
    }
    if (best) return take(best->first, best->second);
    const Box least = usual_for(panels.back());
    if (const auto place = least_covering_place(around_, least)) take(panels.size() - 1, *place);
  }

  Page& page_;
  const picture::OverlayContent& content_;
  Box corner_, inset_;
  Note note_;
  bool note_above_ = false;
  float left_ = 0;  ///< of a notice at the top
  Box room_;        ///< of the caption, usually
  CaptionLimits most_;
  CaptionPanel panel_;
  Surroundings around_;
  Box caption_, said_;
};

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
    CaptionLayout(page, content, united(corner, code), inset).add();
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
