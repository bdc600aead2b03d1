#include "client-sdk/display/overlay_layout.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::display {
namespace {

const Eigen::Vector4f kInk(0.055F, 0.065F, 0.075F, 0.80F);
const Eigen::Vector4f kPaper(0.97F, 0.96F, 0.93F, 1.0F);
const Eigen::Vector4f kGold(0.93F, 0.77F, 0.46F, 1.0F);
const Eigen::Vector4f kQuiet(0.97F, 0.96F, 0.93F, 0.66F);
const Eigen::Vector4f kFaint(0.97F, 0.96F, 0.93F, 0.24F);
const Eigen::Vector4f kWater(0.45F, 0.74F, 0.86F, 1.0F);

float unit_of(PixelSize size) {
  return std::max(std::min(static_cast<float>(size.height) / 720.0F, static_cast<float>(size.width) / 800.0F), 0.35F);
}

/// All lengths are for a picture of 1280 x 720 and grow with it; a narrow picture (half of a stereo pair) shrinks them less than
/// its width, for the sake of the reader.
class Page {
 public:
  Page(PixelSize size, const MeasureText& measure)
      : width(static_cast<float>(size.width)), height(static_cast<float>(size.height)), measure_(measure) {
    unit_ = unit_of(size);
  }
  [[nodiscard]] float px(float design) const { return std::round(design * unit_); }
  [[nodiscard]] int font(float design) const { return std::max(8, static_cast<int>(std::lround(design * unit_))); }
  [[nodiscard]] float measure(Face face, float design, std::string_view text) const {
    return measure_(face, font(design), text);
  }
  [[nodiscard]] std::vector<std::string> lines(Face face, float design, std::string_view text, float width_px) const {
    return break_lines(text, width_px, [&](std::string_view part) { return measure(face, design, part); });
  }

  float width;
  float height;
  OverlayLayout out;

 private:
  float unit_ = 1;
  const MeasureText& measure_;
};

constexpr float kMargin = 36;
constexpr float kPadding = 24;
constexpr float kTitleSize = 18;
constexpr float kCaptionSize = 27;
constexpr float kHintSize = 20;
constexpr float kDot = 9;
constexpr float kDotGap = 9;

void add_text(Page& page, float x, float baseline, Face face, float design, const Eigen::Vector4f& colour,
              std::string text) {
  page.out.texts.push_back({x, std::round(baseline), page.font(design), face, colour, std::move(text)});
}

/// Steps as dots, the present one long; the right end at `right`. Returns the width.
float add_dots(Page& page, float right, float middle, const OverlayContent& content) {
  const std::uint32_t total = std::min(content.steps_total, 16U);
  if (total < 2) return 0;  // one step is no way to be shown
  const float dot = page.px(kDot);
  const float gap = page.px(kDotGap);
  const float here = 2.4F * dot;
  const bool finished = content.steps_done >= content.steps_total;
  const float width =
      static_cast<float>(total) * dot + static_cast<float>(total - 1) * gap + (finished ? 0 : here - dot);
  float x = right - width;
  for (std::uint32_t i = 0; i < total; ++i) {
    const bool done = i < content.steps_done;
    const bool present = i == content.steps_done;
    const float w = present ? here : dot;
    page.out.shapes.push_back({x, middle - dot / 2, w, dot, dot / 2, done ? kGold : present ? kPaper : kFaint});
    x += w + gap;
  }
  return width;
}

void add_caption(Page& page, const OverlayContent& content) {
  if (content.caption.empty() && content.title.empty()) return;
  const float margin = page.px(kMargin);
  const float padding = page.px(kPadding);
  const float panel_width = std::min(page.width - 2 * margin, page.px(820));
  const float inner = panel_width - 2 * padding;
  const float line = page.px(kCaptionSize * 1.36F);
  const float hint_line = page.px(kHintSize * 1.40F);
  const auto caption = page.lines(Face::regular, kCaptionSize, content.caption, inner);
  const auto hint = page.lines(Face::regular, kHintSize, content.hint, inner);
  const float title_line = page.px(kTitleSize * 1.2F);
  float height = 2 * padding + title_line;
  if (!caption.empty()) height += page.px(8) + static_cast<float>(caption.size()) * line;
  if (!hint.empty()) height += page.px(8) + static_cast<float>(hint.size()) * hint_line;
  const float x = margin;
  const float y = page.height - margin - height;

  page.out.shapes.push_back({x, y, panel_width, height, page.px(14), kInk});
  page.out.shapes.push_back({x, y + padding, page.px(4), title_line, 0, kGold});
  const float baseline = y + padding + page.px(kTitleSize * 0.95F);
  const float dots = add_dots(page, x + panel_width - padding, y + padding + title_line / 2, content);
  // A title that meets the dots is cut short: the caption says what matters.
  const auto title = page.lines(Face::bold, kTitleSize, content.title, inner - dots - padding);
  if (!title.empty()) add_text(page, x + padding, baseline, Face::bold, kTitleSize, kGold, title.front());
  float at = y + padding + title_line + page.px(8);
  for (const std::string& text : caption) {
    add_text(page, x + padding, at + page.px(kCaptionSize * 1.02F), Face::regular, kCaptionSize, kPaper, text);
    at += line;
  }
  at += hint.empty() ? 0 : page.px(8);
  for (const std::string& text : hint) {
    add_text(page, x + padding, at + page.px(kHintSize * 1.02F), Face::regular, kHintSize, kWater, text);
    at += hint_line;
  }
}

/// A narrow picture has no room beside the machine: there the unit must say what the number is.
void add_readouts(Page& page, const OverlayContent& content) {
  if (content.readouts.empty()) return;
  const bool narrow = page.width < page.px(900);
  const float margin = page.px(kMargin);
  const float padding = page.px(narrow ? 14 : 18);
  const float width = page.px(224);
  const float row = page.px(narrow ? 56 : 92);
  const float label_height = page.px(narrow ? 0 : 21);
  const float number_size = narrow ? 28 : 34;
  const auto count = static_cast<float>(content.readouts.size());
  const float x = page.width - margin - width;
  const float y = margin;
  page.out.shapes.push_back({x, y, width, count * row + 2 * padding - page.px(12), page.px(14), kInk});
  float at = y + padding;
  for (const Readout& readout : content.readouts) {
    const float baseline = at + label_height + page.px(narrow ? 24 : 30);
    const float end_width = page.measure(Face::regular, 13, readout.end);
    if (!narrow) add_text(page, x + padding, at + page.px(13), Face::regular, 15, kQuiet, readout.label);
    add_text(page, x + padding, baseline, Face::bold, number_size, kPaper, readout.value);
    const float value_width = page.measure(Face::bold, number_size, readout.value);
    add_text(page, x + padding + value_width + page.px(7), baseline, Face::regular, 17, kQuiet, readout.unit);
    if (!narrow) {
      add_text(page, x + width - padding - end_width, at + page.px(13), Face::regular, 13, kQuiet, readout.end);
    }
    const float bar = page.px(6);
    const float bar_y = baseline + page.px(narrow ? 9 : 12);
    const float full = width - 2 * padding;
    page.out.shapes.push_back({x + padding, bar_y, full, bar, bar / 2, kFaint});
    const float filled = full * static_cast<float>(std::clamp(readout.fraction, 0.0, 1.0));
    if (filled >= bar) page.out.shapes.push_back({x + padding, bar_y, filled, bar, bar / 2, kWater});
    at += row;
  }
}

void add_note(Page& page, const OverlayContent& content) {
  if (content.note.empty()) return;
  const float text_width = page.measure(Face::regular, 20, content.note);
  const float padding = page.px(20);
  const float height = page.px(46);
  const float width = text_width + 2 * padding;
  const float x = std::round((page.width - width) / 2);
  const float y = page.px(kMargin);
  page.out.shapes.push_back({x, y, width, height, height / 2, kInk});
  add_text(page, x + padding, y + page.px(30), Face::regular, 20, kPaper, content.note);
}

void add_inset_frame(Page& page, PixelSize size, const std::string& caption) {
  const PixelRectangle inset = inset_rectangle(size);
  const auto x = static_cast<float>(inset.x);
  const auto y = static_cast<float>(inset.y);
  const auto width = static_cast<float>(inset.width);
  const auto height = static_cast<float>(inset.height);
  const float line = std::max(page.px(3), 1.0F);
  const float strip = page.px(30);
  Eigen::Vector4f frame = kInk;
  frame.w() = 1;
  page.out.shapes.push_back({x, y + height - strip, width, strip, 0, kInk});
  page.out.shapes.push_back({x - line, y - line, width + 2 * line, line, 0, frame});
  page.out.shapes.push_back({x - line, y + height, width + 2 * line, line, 0, frame});
  page.out.shapes.push_back({x - line, y, line, height, 0, frame});
  page.out.shapes.push_back({x + width, y, line, height, 0, frame});
  add_text(page, x + page.px(14), y + height - page.px(10), Face::regular, 15, kPaper, caption);
}

}  // namespace

PixelRectangle inset_rectangle(PixelSize size) {
  const float unit = unit_of(size);
  const auto px = [unit](float design) { return static_cast<std::uint32_t>(std::lround(design * unit)); };
  // Narrow pictures have little room beside the readouts.
  const float width = static_cast<float>(size.width) < 900 * unit ? 220 : 300;
  return {px(kMargin), px(kMargin), px(width), px(0.68F * width)};
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

OverlayLayout lay_out(const OverlayContent& content, PixelSize size, const MeasureText& measure,
                      const std::string* inset_caption) {
  Page page(size, measure);
  if (inset_caption != nullptr) add_inset_frame(page, size, *inset_caption);
  add_caption(page, content);
  add_readouts(page, content);
  add_note(page, content);
  return std::move(page.out);
}

}  // namespace mechane::display
