// The page that overlays are laid out on: its unit, its colours, its boxes. For the files overlay_*.cpp alone.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "client-sdk/draw/overlay_layout.hpp"

namespace mechane::draw {

struct Palette {
  Eigen::Vector4f ink;     ///< panels
  Eigen::Vector4f paper;   ///< words
  Eigen::Vector4f gold;    ///< titles, marks
  Eigen::Vector4f quiet;   ///< words of less weight
  Eigen::Vector4f faint;   ///< what is not reached yet
  Eigen::Vector4f water;   ///< gauges, hints
  Eigen::Vector4f button;  ///< its face
  Eigen::Vector4f veil;    ///< over the picture behind a panel
};

/// A block of the page, pixels.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] float right() const { return x + width; }
  [[nodiscard]] float below() const { return y + height; }
  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  /// Side by side they do not; one above the other they do.
  [[nodiscard]] bool shares_columns(const Box& other) const { return x < other.right() && other.x < right(); }
};

/// All lengths are for a picture of 1280 x 720 and grow with it; a narrow picture (half of a stereo pair) shrinks them less than its
/// width, for the sake of the reader. What holds words grows with the words too.
class Page {
 public:
  Page(picture::PixelSize size, const picture::OverlayStyle& style, const MeasureText& measure);

  [[nodiscard]] float px(float design) const;
  /// A length that goes with the words.
  [[nodiscard]] float tx(float design) const { return px(design * scale); }
  [[nodiscard]] int font(float design) const;
  [[nodiscard]] float measure(Face face, float design, std::string_view text) const;
  /// At most `width_px` wide, all of them: a word that is wider is broken.
  [[nodiscard]] std::vector<std::string> lines(Face face, float design, std::string_view text, float width_px) const;
  /// A finger finds it.
  [[nodiscard]] float finger() const;
  [[nodiscard]] float margin() const { return px(36); }
  [[nodiscard]] float gap() const { return px(16); }

  void add_shape(const Box& box, float corner_radius, const Eigen::Vector4f& colour);
  void add_text(float x, float baseline, Face face, float design, const Eigen::Vector4f& colour, std::string text);
  void add_panel(const Box& box) { add_shape(box, px(14), colours.ink); }
  /// Steps or questions as dots, the present one long; the right end at `right`. Returns the width.
  float add_dots(float right, float middle, std::uint32_t done, std::uint32_t total);
  /// Moves everything down that was added from these sizes on.
  void move_down(std::size_t first_shape, std::size_t first_text, std::size_t first_target, float by);

  float width;
  float height;
  float scale;  ///< of words
  bool high_contrast;
  std::optional<picture::OverlayAction> meant;  ///< this button is lit
  Palette colours;
  OverlayLayout out;

 private:
  float unit_;
  const MeasureText& measure_;
};

/// Pixels per unit of the design.
[[nodiscard]] float overlay_unit(picture::PixelSize size);

/// Buttons low on the right. Empty: there are none.
Box add_corner(Page& page, const std::vector<picture::OverlayButton>& buttons);

/// The panel in the middle of `room`.
void add_question_panel(Page& page, const picture::OverlayPanel& panel, const Box& room);

}  // namespace mechane::draw
