// The caption's panel and the note: measured first, because their places depend on each other, then added. Used by the files overlay_*.cpp only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/draw/text/overlay_page.hpp"
#include "client-sdk/draw/text/overlay_pages.hpp"

namespace mechane::draw {

/// A line with its look; sizes are the design's.
struct LineLook {
  Face face = Face::regular;
  float size = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
  bool begins_part = false;
};

/// A caption's panel at one width: title and dots, and under them one page of goal, caption and hint.
struct CaptionPanel {
  float scale = 1;  ///< of its words
  float width = 0, height = 0;
  std::vector<std::string> lines;  ///< of all pages
  std::vector<LineLook> looks;
  std::vector<PageLine> heights;
  std::vector<std::size_t> begins;
};

/// How large the panel may be.
struct CaptionLimits {
  float width = 0, height = 0;
  float area = 0;
  float least_width = 0;   ///< 0: half of `width`
  std::size_t lines = 99;  ///< of the caption, on a page
};

[[nodiscard]] CaptionPanel measure_caption(Page& page, const picture::OverlayContent& content,
                                           const CaptionLimits& most);
void add_caption(Page& page, const picture::OverlayContent& content, const CaptionPanel& panel, const Box& box);

/// A note about the link, a message, or a notice with its sign: one page of its lines.
struct Note {
  std::optional<picture::OverlayNotice::Sign> sign;
  float scale = 1;
  std::vector<std::string> lines, more;
  std::string mark;  ///< of the page; empty: there is one
  float width = 0, height = 0;
  std::size_t rows = 0;  ///< lines of its fullest page
};

/// At most so wide, and as high as its share of the picture allows. A page has at most so many rows; a notice has one page.
[[nodiscard]] Note measure_note(Page& page, const picture::OverlayContent& content, float most, std::size_t rows = 99);
void add_note(Page& page, const Note& note, const Box& box);

}  // namespace mechane::draw
