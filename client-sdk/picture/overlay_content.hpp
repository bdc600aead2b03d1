// Everything that is written over the picture, as plain content. The layout places it.
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
  double fraction = 0;           ///< where on the gauge the value is, 0..1
  std::string end;               ///< the value at the gauge's end: "20"
  std::optional<double> goal{};  ///< where on the gauge the step's goal is, 0..1
  std::string begin = "0";       ///< the value at the gauge's beginning
  bool named = false;            ///< the label is the author's: the unit alone does not say what it is
};

/// Drawn under all panels, in pixels of one eye's picture; sRGB with straight alpha.
struct OverlayDot {
  float x = 0;
  float y = 0;
  float radius = 0;
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();
};

/// A box in one eye's picture, pixels from its upper left corner.
struct PictureBox {
  float left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const PictureBox&, const PictureBox&) = default;
};

/// A thing's name, written above it where there is room. Places are in pixels of one eye's picture.
struct OverlayLabel {
  std::string text;
  float left = 0, top = 0, right = 0, bottom = 0;
  bool framed = false;  ///< marks its corners: the whole thing is in the picture
};

/// A sign and some words about something that a visitor touches; stands where the note would.
struct OverlayNotice {
  enum class Sign : std::uint8_t {
    take,  ///< a fist around a handle
    wear,  ///< a glove
    wait,
    target,  ///< to be calibrated
    warm,    ///< a thermometer
    unplugged,
  };
  Sign sign = Sign::wait;
  std::string text;
  std::string more;  ///< under the text, smaller; empty: none
};

/// A bar with round ends, on a disc of radius 1: x to the right and y down from its middle.
struct HandStroke {
  Eigen::Vector2f from = Eigen::Vector2f::Zero();
  Eigen::Vector2f to = Eigen::Vector2f::Zero();
  float radius = 0;
  std::uint32_t part = 0;  ///< strokes of one part, which follow each other, have one outline
};

/// A pose of the hand that a visitor is asked to show, in the middle of the picture.
struct OverlayPose {
  std::vector<HandStroke> drawing{};  ///< what lies behind first
  std::string text{};
  std::string more{};                 ///< under the text, smaller; empty: none
  std::string again{};                ///< why this pose is asked for once more; empty: it is not
  float held = 0;                     ///< how much of its time it was held, 0..1: a ring around the drawing
  std::uint32_t done = 0, total = 0;  ///< poses
};

/// A QR code, with a line of words under it.
struct OverlayCode {
  std::uint32_t side = 0;    ///< modules, without the quiet ones around
  std::vector<bool> dark{};  ///< side x side, rows from above
  std::string text{};
};

/// Everything that is written over the picture, in one language, UTF-8.
struct OverlayContent {
  std::string title;
  std::string caption;
  std::string hint;
  std::string note;                       ///< a calm note about the link, such as "The exhibit is getting ready …"
  std::optional<OverlayNotice> notice{};  ///< instead of the note
  std::string message{};  ///< the museum's words to visitors, where the note would be while there is none
  std::uint32_t steps_done = 0;
  std::uint32_t steps_total = 0;
  std::vector<Readout> readouts;
  std::string goal;                   ///< of the activity, at its beginning
  std::vector<OverlayButton> corner;  ///< at the lower right
  std::optional<OverlayPanel> panel;  ///< shown instead of captions and readouts
  std::optional<OverlayPose> pose{};  ///< shown instead of captions and readouts; not beside a panel
  OverlayStyle style;
  std::vector<OverlayDot> dots{};        ///< of the display's own hand
  std::optional<OverlayLabel> label{};   ///< of the thing under the pointer
  std::optional<OverlayAction> meant{};  ///< action of the button under the mouse, which is highlighted
  /// What captions and notes must not cover, the most important first.
  std::vector<PictureBox> keep_off{};
  float caption_for_s =
      0;                 ///< how long goal, caption and hint have been as they are: it turns the pages of a long text
  float note_for_s = 0;  ///< likewise the note, or the message
  std::optional<PictureBox> caption_at{};  ///< in the last picture: they stay there until they cover something
  std::optional<PictureBox> note_at{};
  std::optional<OverlayCode> code{};  ///< over the corner's buttons, where there is room; not beside a panel or a pose
};

}  // namespace mechane::picture
