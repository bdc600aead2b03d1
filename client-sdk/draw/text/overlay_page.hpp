// The page on which overlays are laid out: its unit, colours and boxes. Used by the files overlay_*.cpp only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/draw/text/overlay_layout.hpp"

namespace mechane::draw {

struct Palette {
  Eigen::Vector4f ink;     ///< panels
  Eigen::Vector4f paper;   ///< words
  Eigen::Vector4f gold;    ///< titles, marks
  Eigen::Vector4f quiet;   ///< less important words
  Eigen::Vector4f faint;   ///< steps that are not reached yet
  Eigen::Vector4f water;   ///< gauges, hints
  Eigen::Vector4f button;  ///< its face
  Eigen::Vector4f veil;    ///< darkens the picture behind a panel
};

/// A block of the page, pixels.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] float right() const { return x + width; }
  [[nodiscard]] float below() const { return y + height; }
  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  /// Whether the blocks' columns overlap.
  [[nodiscard]] bool shares_columns(const Box& other) const { return x < other.right() && other.x < right(); }
};

/// All lengths are for a picture of 1280 x 720 and scale with it; in a narrow picture (half of a stereo pair) they
/// shrink less than the width, to stay readable. Boxes around words grow with the words.
class Page {
 public:
  Page(picture::PixelSize size, const picture::OverlayStyle& style, const MeasureText& measure);

  [[nodiscard]] float px(float design) const;
  /// A length that scales with the words.
  [[nodiscard]] float tx(float design) const { return px(design * scale); }
  [[nodiscard]] int font(float design) const;
  [[nodiscard]] float measure(Face face, float design, std::string_view text) const;
  /// Lines of at most `width_px`; a wider word is broken.
  [[nodiscard]] std::vector<std::string> lines(Face face, float design, std::string_view text, float width_px) const;
  /// Least height that a finger can press.
  [[nodiscard]] float finger() const;
  [[nodiscard]] float margin() const { return px(36); }
  [[nodiscard]] float gap() const { return px(16); }

  void add_shape(const Box& box, float corner_radius, const Eigen::Vector4f& colour);
  void add_text(float x, float baseline, Face face, float design, const Eigen::Vector4f& colour, std::string text);
  void add_panel(const Box& box) { add_shape(box, px(14), colours.ink); }
  /// Adds steps or questions as dots, ending at `right`; the present one is long. Returns the width.
  float add_dots(float right, float middle, std::uint32_t done, std::uint32_t total);
  /// Moves everything down that was added after these sizes.
  void move_down(std::size_t first_shape, std::size_t first_text, std::size_t first_target, float by);

  float width;
  float height;
  float scale;  ///< of words
  bool high_contrast;
  std::optional<picture::OverlayAction> meant;  ///< action of the highlighted button
  Palette colours;
  OverlayLayout out;

 private:
  float unit_;
  const MeasureText& measure_;
};

/// Pixels per unit of the design.
[[nodiscard]] float overlay_unit(picture::PixelSize size);

/// Adds the buttons at the lower right. Returns their block; empty: none.
Box add_corner(Page& page, const std::vector<picture::OverlayButton>& buttons);

/// Adds a QR code over the block `corner` at the lower right. Returns its block; empty: the picture is too small for it.
Box add_code(Page& page, const picture::OverlayCode& code, const Box& corner);

/// Adds the pose that a visitor is asked for, in the middle of `room`.
void add_pose(Page& page, const picture::OverlayPose& pose, const Box& room);

/// Adds the panel in the middle of `room`.
void add_question_panel(Page& page, const picture::OverlayPanel& panel, const Box& room);

}  // namespace mechane::draw
