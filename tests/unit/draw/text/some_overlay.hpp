// Overlays of random words, and what may be wrong with their layout.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <rapidcheck.h>

#include "client-sdk/draw/text/overlay_layout.hpp"

namespace mechane::draw {

struct Extent {
  float left, top, right, bottom;
  std::string what;
};

inline bool overlap(const Extent& a, const Extent& b) {
  constexpr float kTouch = 0.5F;
  return a.left + kTouch < b.right && b.left + kTouch < a.right && a.top + kTouch < b.bottom &&
         b.top + kTouch < a.bottom;
}

/// From a capital's head to the line: what two lines must not share.
inline std::vector<Extent> words_of(const OverlayLayout& layout, const MeasureText& measure) {
  std::vector<Extent> extents;
  for (const OverlayText& text : layout.texts) {
    const auto size = static_cast<float>(text.size_px);
    extents.push_back({text.x, text.baseline - 0.74F * size, text.x + measure(text.face, text.size_px, text.text),
                       text.baseline + 0.2F * size, text.text});
  }
  return extents;
}

inline std::vector<Extent> targets_of(const OverlayLayout& layout) {
  std::vector<Extent> extents;
  for (const OverlayTarget& t : layout.targets)
    extents.push_back({t.x, t.y, t.x + t.width, t.y + t.height, "target " + t.action.value});
  return extents;
}

inline Extent extent_of(const OverlayShape& s) {
  return {s.x, s.y, s.x + s.width, s.y + s.height, "shape"};
}

/// Shapes of the panels' own colour: panels, the note, the corner's buttons. With high contrast some are faces within frames.
inline std::vector<Extent> panels_of(const OverlayLayout& layout, bool high_contrast) {
  std::vector<Extent> extents;
  for (const OverlayShape& shape : layout.shapes) {
    if (!high_contrast && shape.colour.w() == 0.80F) extents.push_back(extent_of(shape));
  }
  return extents;
}

inline bool within(const Extent& a, const Extent& b) {
  return a.left >= b.left && a.top >= b.top && a.right <= b.right && a.bottom <= b.bottom;
}

/// What is wrong with a layout; empty: nothing.
inline std::string fault_of(const OverlayLayout& layout, picture::PixelSize size, const MeasureText& measure,
                            bool high_contrast) {
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  std::vector<Extent> all = words_of(layout, measure);
  const std::vector<Extent> targets = targets_of(layout);
  for (const std::vector<Extent>& kind : {all, targets, panels_of(layout, high_contrast)}) {
    for (std::size_t i = 0; i < kind.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (overlap(kind[i], kind[j])) return "'" + kind[i].what + "' lies over '" + kind[j].what + "'";
      }
    }
  }
  for (const Extent& words : all) {
    for (const Extent& target : targets) {
      if (overlap(words, target) && !within(words, target)) return "'" + words.what + "' sticks out of its button";
    }
  }
  all.insert(all.end(), targets.begin(), targets.end());
  for (const OverlayShape& shape : layout.shapes)
    all.push_back(extent_of(shape));
  for (const Extent& e : all) {
    if (e.left < -0.5F || e.top < -0.5F || e.right > width + 0.5F || e.bottom > height + 0.5F)
      return "'" + e.what + "' runs out of the picture";
  }
  return {};
}

/// Letters of real fonts, Greek ones too.
inline const MeasureText& real_letters() {
  static const auto typesetter = *Typesetter::create(default_font_folder());
  static const MeasureText measure = [](Face face, int px, std::string_view text) {
    return typesetter->width(face, px, text);
  };
  return measure;
}

inline picture::OverlayButton button_of(picture::OverlayAction::Kind kind, const std::string& text,
                                        const std::string& value = "") {
  picture::OverlayButton button;
  button.action.kind = kind;
  button.action.value = value;
  button.text = text;
  return button;
}

/// As wide in the first case as in the last.
template <class T>
T from_to(T least, T most) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<T>(least, most + 1));
}

inline std::string some_words(std::size_t least, std::size_t most) {
  static const std::vector<std::string> kWords{"νερό",      "κοχλίας",       "η",
                                               "σιγά-σιγά", "the",           "Αρχιμήδης",
                                               "στρέβλωση", "counterweight", "ανεμοστρόβιλος",
                                               "drum",      "Ἡρωνας",        "ηλεκτροεγκεφαλογράφημα"};
  std::string text;
  const auto count = from_to(least, most);
  for (std::size_t i = 0; i < count; ++i)
    text += (i > 0 ? " " : "") + kWords[from_to<std::size_t>(0, kWords.size() - 1)];
  return text;
}

inline picture::PixelSize some_size() {
  return *rc::gen::element(picture::PixelSize{1280, 720}, picture::PixelSize{1920, 1080}, picture::PixelSize{720, 1280},
                           picture::PixelSize{640, 720}, picture::PixelSize{640, 360}, picture::PixelSize{1280, 360},
                           picture::PixelSize{1080, 1920}, picture::PixelSize{1024, 768},
                           picture::PixelSize{3840, 2160}, picture::PixelSize{2560, 720}, picture::PixelSize{854, 480},
                           picture::PixelSize{2560, 1440});
}

inline void add_some_corner(picture::OverlayContent& content) {
  if (*rc::gen::arbitrary<bool>()) content.corner.push_back(button_of(picture::OverlayAction::Kind::home, "Χωριό"));
  const int languages = from_to(0, 2);
  for (int i = 0; i < languages; ++i)
    content.corner.push_back(button_of(picture::OverlayAction::Kind::language, "ΕΛ", std::to_string(i)));
  content.style.text_scale = *rc::gen::element(1.0F, picture::kLargeText);
  content.style.high_contrast = *rc::gen::arbitrary<bool>();
  if (from_to(0, 2) == 0) content.note = "Μια στιγμή, το έκθεμα συνεχίζει αμέσως …";
}

}  // namespace mechane::draw
