// Long texts turn pages. Used by the files overlay_*.cpp only.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mechane::draw {

inline constexpr float kLettersRead_s = 15;  ///< a visitor's reading, letters a second
inline constexpr float kLeastPage_s = 4;

struct PageLine {
  float height = 0;
  float gap = 0;  ///< above it, unless it is a page's first
};

/// Indices of the lines with which pages begin, the first 0: as few pages as there can be, and of these the most even. `most`: height of a
/// page. Empty: there are no lines, or one is higher than a page.
[[nodiscard]] std::vector<std::size_t> page_begins(std::span<const PageLine> lines, float most);

/// The lines of a text on one of its pages.
struct ShownPage {
  std::size_t first = 0, last = 0;  ///< from `first` until before `last`
  std::string mark;                 ///< "1/2"; empty: there is one page
};

/// The page that is read after so many seconds. After the last page comes the first again.
[[nodiscard]] ShownPage page_at(std::span<const std::string> lines, std::span<const std::size_t> begins, float for_s);

/// The greatest height of a page.
[[nodiscard]] float highest_page(std::span<const PageLine> lines, std::span<const std::size_t> begins);

}  // namespace mechane::draw
