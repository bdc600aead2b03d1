#include "client-sdk/draw/text/overlay_pages.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/base/utf8.hpp"

namespace mechane::draw {
namespace {

std::size_t end_of(std::span<const std::size_t> begins, std::size_t page, std::size_t lines) {
  return page + 1 < begins.size() ? begins[page + 1] : lines;
}

/// Fills one page after the other.
std::vector<std::size_t> filled_pages(std::span<const PageLine> lines, float most) {
  std::vector<std::size_t> begins;
  float used = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].height > most) return {};
    used += lines[i].gap + lines[i].height;
    if (i > 0 && used <= most) continue;
    begins.push_back(i);
    used = lines[i].height;
  }
  return begins;
}

float time_to_read_s(std::span<const std::string> lines) {
  std::size_t letters = 0;
  for (const std::string& line : lines)
    letters += utf8_letters(line) + 1;
  return std::max(static_cast<float>(letters) / kLettersRead_s, kLeastPage_s);
}

}  // namespace

float highest_page(std::span<const PageLine> lines, std::span<const std::size_t> begins) {
  float most = 0;
  for (std::size_t page = 0; page < begins.size(); ++page) {
    float height = -lines[begins[page]].gap;
    for (std::size_t i = begins[page]; i < end_of(begins, page, lines.size()); ++i)
      height += lines[i].gap + lines[i].height;
    most = std::max(most, height);
  }
  return most;
}

std::vector<std::size_t> page_begins(std::span<const PageLine> lines, float most) {
  std::vector<std::size_t> begins = filled_pages(lines, most);
  while (begins.size() > 1) {
    // A little less than the highest page has: the lines that it loses go to the others, until these are full.
    std::vector<std::size_t> flatter = filled_pages(lines, highest_page(lines, begins) - 0.5F);
    if (flatter.size() != begins.size()) break;
    begins = std::move(flatter);
  }
  return begins;
}

ShownPage page_at(std::span<const std::string> lines, std::span<const std::size_t> begins, float for_s) {
  if (begins.size() < 2) return {0, lines.size(), {}};
  std::vector<float> ends_s;
  for (std::size_t page = 0; page < begins.size(); ++page) {
    const std::size_t end = end_of(begins, page, lines.size());
    ends_s.push_back((ends_s.empty() ? 0 : ends_s.back()) +
                     time_to_read_s(lines.subspan(begins[page], end - begins[page])));
  }
  const float at_s = std::fmod(std::max(for_s, 0.0F), ends_s.back());
  const auto after = std::ranges::upper_bound(ends_s, at_s);
  const std::size_t page = std::min(static_cast<std::size_t>(std::distance(ends_s.begin(), after)), begins.size() - 1);
  return {begins[page], end_of(begins, page, lines.size()), fmt::format("{}/{}", page + 1, begins.size())};
}

}  // namespace mechane::draw
