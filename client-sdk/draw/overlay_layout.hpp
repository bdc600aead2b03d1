// Where the words go: a caption panel low on the left, buttons low on the right, readouts high on the right, a note above; or one panel
// of questions. Nothing lies over anything else, nor out of the picture; words that are too many become smaller. Pure: content and size in, shapes
// and lines of text out. Pixels, origin in the upper left corner; colours are sRGB with straight alpha.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/typesetter.hpp"
#include "client-sdk/picture/overlay_content.hpp"

namespace mechane::draw {

struct OverlayShape {
  float x = 0, y = 0, width = 0, height = 0;
  float corner_radius = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
};

struct OverlayText {
  float x = 0;  ///< left end
  float baseline = 0;
  int size_px = 16;
  Face face = Face::regular;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
  std::string text;
};

/// Pixels of a picture, origin in the upper left corner.
struct PixelRectangle {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// What can be pressed, and where.
struct OverlayTarget {
  float x = 0, y = 0, width = 0, height = 0;
  picture::OverlayAction action;
};

struct OverlayLayout {
  picture::PixelSize size;           ///< of the picture
  std::vector<OverlayShape> shapes;  ///< drawn first, in order
  std::vector<OverlayText> texts;
  std::vector<OverlayTarget> targets;  ///< none lies over another
  float covered_below = 0;             ///< of the height, from below up to the caption's upper edge; 0: no caption
};

/// Width of a line, in pixels.
using MeasureText = std::function<float(Face, int size_px, std::string_view utf8)>;

/// `inset_caption`: of a close-up that lies in inset_rectangle(size); null: there is none.
[[nodiscard]] OverlayLayout lay_out(const picture::OverlayContent& content, picture::PixelSize size,
                                    const MeasureText& measure, const std::string* inset_caption = nullptr);

/// What is pressed at a place of the same picture; none: nothing of the overlay's.
[[nodiscard]] std::optional<picture::OverlayAction> action_at(const OverlayLayout& layout, double x, double y);

/// Where a close-up goes: the upper left corner.
[[nodiscard]] PixelRectangle inset_rectangle(picture::PixelSize size);

/// Breaks at blanks so that each line is at most `width` wide; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> break_lines(std::string_view text, float width,
                                                   const std::function<float(std::string_view)>& measure);

}  // namespace mechane::draw
