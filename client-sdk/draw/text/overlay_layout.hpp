// Layout of the overlay: a caption panel at the lower left, buttons at the lower right, readouts at the upper right, a
// note at the top; or one panel, of a question or of a pose to show. Nothing overlaps or leaves the picture. Caption and note together
// cover kMostCovered of it at most, and nothing of OverlayContent::keep_off where there is another place; a long text turns pages. Words
// become smaller only where not even a line has room.
// Pure: content and size in, shapes and lines of text out. Pixels, origin in the upper left corner; colours are sRGB
// with straight alpha.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/draw/gl_context.hpp"
#include "client-sdk/draw/text/typesetter.hpp"
#include "client-sdk/picture/overlay_content.hpp"

namespace mechane::draw {

struct OverlayShape {
  float x = 0, y = 0, width = 0, height = 0;
  float corner_radius = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
  float turn_rad = 0;  ///< about its middle, clockwise
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

/// Where a button can be pressed.
struct OverlayTarget {
  float x = 0, y = 0, width = 0, height = 0;
  picture::OverlayAction action;
};

/// Share of the picture's area that caption and note cover at most.
inline constexpr float kMostCovered = 0.25F;

struct OverlayLayout {
  picture::PixelSize size;           ///< of the picture
  std::vector<OverlayShape> shapes;  ///< drawn first, in order
  std::vector<OverlayText> texts;
  std::vector<OverlayTarget> targets;  ///< none lies over another
  float covered_below =
      0;  ///< share of the height from the bottom to the caption's upper edge, in its usual place; 0: no caption
  std::optional<picture::PictureBox> caption, note;  ///< where they are; empty: it is not shown
};

/// Width of a line, in pixels.
using MeasureText = std::function<float(Face, int size_px, std::string_view utf8)>;

/// `inset_caption`: the caption of a close-up in inset_rectangle(size); null: there is none.
[[nodiscard]] OverlayLayout lay_out(const picture::OverlayContent& content, picture::PixelSize size,
                                    const MeasureText& measure, const std::string* inset_caption = nullptr);

/// The button at a place of the same picture; none: no button.
[[nodiscard]] std::optional<picture::OverlayAction> action_at(const OverlayLayout& layout, double x, double y);

/// The place of a close-up: the upper left corner.
[[nodiscard]] PixelRectangle inset_rectangle(picture::PixelSize size);

/// Breaks text at spaces into lines of at most `width`; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> break_lines(std::string_view text, float width,
                                                   const std::function<float(std::string_view)>& measure);

}  // namespace mechane::draw
