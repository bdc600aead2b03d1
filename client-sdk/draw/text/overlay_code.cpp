// A QR code on a bright card, with a line of words under it.
#include <algorithm>
#include <cmath>

#include "client-sdk/draw/text/overlay_page.hpp"

namespace mechane::draw {
namespace {

constexpr float kCodeSide = 230;      // with the quiet modules
constexpr std::uint32_t kQuiet = 4;   // modules around, as ISO/IEC 18004 asks for
constexpr float kLeastModule_px = 2;  // smaller ones are not read by a phone's camera
constexpr float kCodeWords = 19;
constexpr float kCodeLine = 30;
constexpr float kLeastCaption = 600;  // room that a caption needs beside it
const Eigen::Vector4f kCard(0.98F, 0.98F, 0.97F, 1);
const Eigen::Vector4f kDark(0.05F, 0.06F, 0.08F, 1);

/// Dark modules that follow each other in a row are one shape.
void add_modules(Page& page, const picture::OverlayCode& code, float x, float y, float module) {
  const auto dark = [&](std::uint32_t row, std::uint32_t column) {
    return column < code.side && code.dark[row * code.side + column];
  };
  for (std::uint32_t row = 0; row < code.side; ++row) {
    for (std::uint32_t from = 0; from < code.side; ++from) {
      if (!dark(row, from)) continue;
      std::uint32_t to = from;
      while (dark(row, to))
        ++to;
      const float left = x + module * static_cast<float>(from), above = y + module * static_cast<float>(row);
      page.add_shape({left, above, module * static_cast<float>(to - from), module}, 0, kDark);
      from = to;
    }
  }
}

}  // namespace

Box add_code(Page& page, const picture::OverlayCode& code, const Box& corner) {
  const auto modules = static_cast<float>(code.side + 2 * kQuiet);
  const float module = std::floor(page.px(kCodeSide) / modules);  // whole pixels: sharp edges
  if (code.side == 0 || code.dark.size() != std::size_t{code.side} * code.side || module < kLeastModule_px) return {};
  const float side = module * modules;
  const float words = page.measure(Face::bold, kCodeWords, code.text);
  const float width = std::max(side, std::ceil(words + 2 * page.px(12)));
  const float height = side + std::ceil(page.tx(kCodeLine)) - module;
  const float below = corner.empty() ? page.height - page.margin() : corner.y - page.gap();
  const Box card{std::floor(page.width - page.margin() - width), std::floor(below - height), width, height};
  const bool beside = card.x - page.gap() - page.margin() >= page.tx(kLeastCaption);
  if (card.y < page.height / 3 || !(beside || page.height > page.width)) return {};
  page.add_shape(card, 2 * module, kCard);
  const float x = card.x + std::floor((width - side) / 2), quiet = module * static_cast<float>(kQuiet);
  add_modules(page, code, x + quiet, card.y + quiet, module);
  page.add_text(card.x + std::round((width - words) / 2), card.y + side + page.tx(kCodeLine) / 2 - module, Face::bold,
                kCodeWords, kDark, code.text);
  return card;
}

}  // namespace mechane::draw
