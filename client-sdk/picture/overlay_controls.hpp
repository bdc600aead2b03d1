// What a visitor can press in the overlay, as plain content: buttons in the corner, a panel of questions. The layout
// places them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mechane::picture {

struct OverlayAction {
  enum class Kind : std::uint8_t {
    home,
    language,  ///< value: the language's code
    answer,    ///< value: the answer's name, or the mark from 1 on
    skip,      ///< this question alone
    close,
    activity,  ///< value: of the activity that begins
  };
  Kind kind = Kind::home;
  std::string value{};
  friend bool operator==(const OverlayAction&, const OverlayAction&) = default;
};

struct OverlayButton {
  OverlayAction action;
  std::string text;
};

/// One question, or a farewell: one panel in the middle of the picture.
struct OverlayPanel {
  std::string title;  ///< the exhibit's and the activity's
  std::string goal;   ///< under the title; empty: none
  std::string text;
  std::string more;  ///< under the text; empty: none
  std::vector<OverlayButton> answers;
  bool scale = false;  ///< answers are marks in a row, from `low` to `high`
  std::string low;
  std::string high;
  std::optional<OverlayButton> leave;
  std::uint32_t asked = 0;  ///< questions before this one
  std::uint32_t questions = 0;
};

/// For visitors with impaired sight.
struct OverlayStyle {
  float text_scale = 1;        ///< 1.35: large text
  bool high_contrast = false;  ///< opaque black panels, white and yellow words, no thin lines
};

inline constexpr float kLargeText = 1.35F;

}  // namespace mechane::picture
