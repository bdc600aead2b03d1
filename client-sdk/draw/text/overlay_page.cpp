#include "client-sdk/draw/text/overlay_page.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/utf8.hpp"

namespace mechane::draw {
namespace {

const Eigen::Vector4f kWhite(0.97F, 0.96F, 0.93F, 1.0F);

Palette calm() {
  return {.ink = {0.055F, 0.065F, 0.075F, 0.80F},
          .paper = kWhite,
          .gold = {0.93F, 0.77F, 0.46F, 1.0F},
          .quiet = {0.97F, 0.96F, 0.93F, 0.66F},
          .faint = {0.97F, 0.96F, 0.93F, 0.24F},
          .water = {0.45F, 0.74F, 0.86F, 1.0F},
          .button = {0.97F, 0.96F, 0.93F, 0.14F},
          .veil = {0.02F, 0.025F, 0.03F, 0.42F}};
}

Palette contrasty() {
  const Eigen::Vector4f white(1, 1, 1, 1);
  const Eigen::Vector4f yellow(1, 0.87F, 0, 1);
  return {.ink = {0, 0, 0, 1},
          .paper = white,
          .gold = yellow,
          .quiet = white,
          .faint = {0.38F, 0.38F, 0.38F, 1},
          .water = yellow,
          .button = {0.20F, 0.20F, 0.20F, 1},
          .veil = {0, 0, 0, 0.72F}};
}

/// The longest beginning of a text that fits the width; at least one letter.
std::size_t fitting(std::string_view text, float width, const std::function<float(std::string_view)>& measure) {
  std::size_t fits = 0;
  for (std::size_t end = 1; end <= text.size(); ++end) {
    if (end < text.size() && !begins_letter(text[end])) continue;
    if (fits > 0 && measure(text.substr(0, end)) > width) break;
    fits = end;
  }
  return fits;
}

}  // namespace

float overlay_unit(picture::PixelSize size) {
  return std::max(std::min(static_cast<float>(size.height) / 720.0F, static_cast<float>(size.width) / 800.0F), 0.35F);
}

Page::Page(picture::PixelSize size, const picture::OverlayStyle& style, const MeasureText& measure)
    : width(static_cast<float>(size.width)),
      height(static_cast<float>(size.height)),
      scale(style.text_scale),
      high_contrast(style.high_contrast),
      colours(style.high_contrast ? contrasty() : calm()),
      unit_(overlay_unit(size)),
      measure_(measure) {}

float Page::px(float design) const {
  return std::round(design * unit_);
}

int Page::font(float design) const {
  return std::max(8, static_cast<int>(std::lround(design * scale * unit_)));
}

/// 9 mm on a screen of 40 pixels a centimetre, whatever the picture's size.
float Page::finger() const {
  return std::max(px(64), 36.0F);
}

float Page::measure(Face face, float design, std::string_view text) const {
  return measure_(face, font(design), text);
}

std::vector<std::string> Page::lines(Face face, float design, std::string_view text, float width_px) const {
  const auto wide = [&](std::string_view part) { return measure(face, design, part); };
  std::vector<std::string> fitted;
  for (const std::string& line : break_lines(text, width_px, wide)) {
    std::string_view rest = line;
    while (wide(rest) > width_px) {
      const std::size_t end = fitting(rest, width_px, wide);
      if (end == rest.size()) break;  // a single letter may be wider than the page
      fitted.emplace_back(rest.substr(0, end));
      rest.remove_prefix(end);
    }
    fitted.emplace_back(rest);
  }
  return fitted;
}

void Page::add_shape(const Box& box, float corner_radius, const Eigen::Vector4f& colour) {
  out.shapes.push_back({box.x, box.y, box.width, box.height, corner_radius, colour});
}

void Page::add_text(float x, float baseline, Face face, float design, const Eigen::Vector4f& colour, std::string text) {
  out.texts.push_back({x, std::round(baseline), font(design), face, colour, std::move(text)});
}

float Page::add_dots(float right, float middle, std::uint32_t done, std::uint32_t total) {
  total = std::min(total, 16U);
  if (total < 2) return 0;  // a single step needs no dots
  const float dot = tx(9);
  const float space = tx(9);
  const float here = 2.4F * dot;
  const bool finished = done >= total;
  const float wide =
      static_cast<float>(total) * dot + static_cast<float>(total - 1) * space + (finished ? 0 : here - dot);
  float x = right - wide;
  for (std::uint32_t i = 0; i < total; ++i) {
    const bool present = i == done;
    const float w = present ? here : dot;
    add_shape({x, middle - dot / 2, w, dot}, dot / 2,
              i < done  ? colours.gold
              : present ? colours.paper
                        : colours.faint);
    x += w + space;
  }
  return wide;
}

void Page::move_down(std::size_t first_shape, std::size_t first_text, std::size_t first_target, float by) {
  for (std::size_t i = first_shape; i < out.shapes.size(); ++i)
    out.shapes[i].y += by;
  for (std::size_t i = first_text; i < out.texts.size(); ++i)
    out.texts[i].baseline += by;
  for (std::size_t i = first_target; i < out.targets.size(); ++i)
    out.targets[i].y += by;
}

}  // namespace mechane::draw
