// Everything that is written over the picture, as plain content. Where it lies is the layout's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/picture/overlay_controls.hpp"

namespace mechane::picture {

/// A number that visitors read.
struct Readout {
  std::string label;             ///< "Water lifted"
  std::string value;             ///< "12,4"
  std::string unit;              ///< "l"
  double fraction = 0;           ///< of the gauge's end, 0..1
  std::string end;               ///< what the gauge's end stands for: "20"
  std::optional<double> goal{};  ///< where on the gauge the step's goal is, 0..1
};

/// Drawn under all panels, in pixels of one eye's picture; sRGB with straight alpha.
struct OverlayDot {
  float x = 0;
  float y = 0;
  float radius = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
};

/// What a thing is called, above it where there is room. The thing's place is in pixels of one eye's picture.
struct OverlayLabel {
  std::string text;
  float left = 0, top = 0, right = 0, bottom = 0;
  bool framed = false;  ///< its corners are marked: all of it is there
};

/// Everything that is written over the picture, in one language, UTF-8.
struct OverlayContent {
  std::string title;
  std::string caption;
  std::string hint;
  std::string note;  ///< calm word about the link: "The connection was lost. Waiting ..."
  std::uint32_t steps_done = 0;
  std::uint32_t steps_total = 0;
  std::vector<Readout> readouts;
  std::string goal;                   ///< of the activity, at its beginning
  std::vector<OverlayButton> corner;  ///< low on the right
  std::optional<OverlayPanel> panel;  ///< it stands before captions and readouts, which are not shown then
  OverlayStyle style;
  std::vector<OverlayDot> dots{};        ///< of the display's own hand
  std::optional<OverlayLabel> label{};   ///< of what is pointed at
  std::optional<OverlayAction> meant{};  ///< of the button under the mouse: it is lit
};

}  // namespace mechane::picture
