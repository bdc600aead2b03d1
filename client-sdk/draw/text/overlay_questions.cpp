// The buttons in the corner and the panel of questions.
#include <algorithm>
#include <cmath>

#include "client-sdk/draw/text/overlay_page.hpp"

namespace mechane::draw {
namespace {

constexpr float kCornerText = 22;
constexpr float kPanelTitle = 18;
constexpr float kPanelText = 30;
constexpr float kPanelGoal = 21;
constexpr float kAnswerText = 24;
constexpr float kMarkText = 30;
constexpr float kEndText = 20;

/// Adds a button's face, with a frame for high contrast or under a mouse. The caller adds the words.
void add_button(Page& page, const Box& box, const Eigen::Vector4f& face, const picture::OverlayAction& action) {
  page.out.targets.push_back({box.x, box.y, box.width, box.height, action});
  const bool meant = page.meant == action;
  const float radius = page.px(12);
  if (!page.high_contrast && !meant) return page.add_shape(box, radius, face);
  const float thin = page.high_contrast ? 4 : 3;
  const float frame = std::max(page.px(page.high_contrast && meant ? 2 * thin : thin), 2.0F);
  Eigen::Vector4f within = page.high_contrast ? page.colours.ink : face;
  within.w() = 1;  // opaque, or the frame's colour would shine through
  page.add_shape(box, radius, page.colours.gold);
  page.add_shape({box.x + frame, box.y + frame, box.width - 2 * frame, box.height - 2 * frame}, radius - frame, within);
}

/// A square house; the roof is drawn in rows, because shapes have no slopes.
void add_house(Page& page, float x, float y, float side, const Eigen::Vector4f& wall, const Eigen::Vector4f& door) {
  const float eaves = std::round(y + 0.48F * side);
  const float middle = x + side / 2;
  const float top = std::round(y);
  for (int i = 0; i < static_cast<int>(eaves - top); ++i) {
    const float row = top + static_cast<float>(i);
    const float half = (row + 0.5F - y) / (eaves - y) * side / 2;
    page.add_shape({middle - half, row, 2 * half, 1}, 0, wall);
  }
  const float left = std::round(x + 0.15F * side);
  page.add_shape({left, eaves, std::round(0.70F * side), std::round(0.48F * side)}, 0, wall);
  const float width = std::round(0.20F * side);
  const float height = std::round(0.28F * side);
  page.add_shape({std::round(middle - width / 2), eaves + std::round(0.48F * side) - height, width, height}, 0, door);
}

/// Adds lines of text in the middle of a box.
void add_centred(Page& page, const Box& box, Face face, float design, const Eigen::Vector4f& colour,
                 const std::vector<std::string>& lines) {
  const float line = page.tx(design * 1.25F);
  float at = box.y + (box.height - static_cast<float>(lines.size()) * line) / 2;
  for (const std::string& text : lines) {
    const float x = std::round(box.x + (box.width - page.measure(face, design, text)) / 2);
    page.add_text(x, at + page.tx(design * 0.97F), face, design, colour, text);
    at += line;
  }
}

/// Lays out the panel from the top down, at y = 0 until its height is known.
class QuestionPanel {
 public:
  QuestionPanel(Page& page, const picture::OverlayPanel& panel, float x, float width, float answer_height,
                std::size_t columns)
      : page_(page),
        panel_(panel),
        x_(x),
        padding_(page.tx(32)),
        inner_(width - 2 * padding_),
        least_(answer_height),
        columns_(columns),
        at_(padding_) {}

  /// Returns the height.
  float set() {
    set_title();
    set_lines(Face::serif, kPanelGoal, page_.colours.paper, panel_.goal);
    set_lines(Face::bold, kPanelText, page_.colours.paper, panel_.text);
    set_lines(Face::regular, kPanelGoal, page_.colours.paper, panel_.more);
    at_ += page_.tx(18);
    if (panel_.scale) {
      set_marks();
    } else {
      set_choices();
    }
    if (panel_.leave) set_leave(*panel_.leave);
    return at_ + padding_;
  }

 private:
  [[nodiscard]] float left() const { return x_ + padding_; }
  void set_title() {
    const float line = page_.tx(kPanelTitle * 1.2F);
    const float dots = page_.add_dots(left() + inner_, at_ + line / 2, panel_.asked, panel_.questions);
    const auto title = page_.lines(Face::bold, kPanelTitle, panel_.title, inner_ - dots - padding_);
    if (!title.empty()) {
      page_.add_text(left(), at_ + page_.tx(kPanelTitle * 0.95F), Face::bold, kPanelTitle, page_.colours.gold,
                     title.front());
    }
    at_ += line;
  }
  void set_lines(Face face, float design, const Eigen::Vector4f& colour, const std::string& text) {
    const auto lines = page_.lines(face, design, text, inner_);
    if (!lines.empty()) at_ += page_.tx(10);
    for (const std::string& line : lines) {
      page_.add_text(left(), at_ + page_.tx(design * 1.02F), face, design, colour, line);
      at_ += page_.tx(design * 1.32F);
    }
  }
  /// Adds a row of buttons of equal height, that of the highest.
  void set_row(std::size_t first, std::size_t count, std::size_t columns, Face face, float design) {
    const float gap = page_.px(12);
    const float width = std::floor((inner_ - static_cast<float>(columns - 1) * gap) / static_cast<float>(columns));
    std::vector<std::vector<std::string>> lines;
    float height = least_;
    for (std::size_t i = first; i < first + count; ++i) {
      lines.push_back(page_.lines(face, design, panel_.answers[i].text, width - 2 * page_.tx(12)));
      height = std::max(height, static_cast<float>(lines.back().size()) * page_.tx(design * 1.25F) + page_.tx(20));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Box box{left() + static_cast<float>(i) * (width + gap), at_, width, height};
      add_button(page_, box, page_.colours.button, panel_.answers[first + i].action);
      add_centred(page_, box, face, design, page_.colours.paper, lines[i]);
    }
    at_ += height + gap;
  }
  void set_choices() {
    for (std::size_t i = 0; i < panel_.answers.size(); i += columns_)
      set_row(i, std::min(columns_, panel_.answers.size() - i), columns_, Face::regular, kAnswerText);
  }
  /// Adds the answers in one row, if a finger can hit each.
  void set_marks() {
    const float gap = page_.px(12);
    const auto room = static_cast<std::size_t>(std::max(std::floor((inner_ + gap) / (least_ + gap)), 1.0F));
    const std::size_t columns = std::max<std::size_t>(std::min(room, panel_.answers.size()), 1);
    for (std::size_t i = 0; i < panel_.answers.size(); i += columns)
      set_row(i, std::min(columns, panel_.answers.size() - i), columns, Face::bold, kMarkText);
    const float half = (inner_ - gap) / 2;
    const auto low = page_.lines(Face::regular, kEndText, panel_.low, half);
    const auto high = page_.lines(Face::regular, kEndText, panel_.high, half);
    const float line = page_.tx(kEndText * 1.3F);
    for (std::size_t i = 0; i < std::max(low.size(), high.size()); ++i) {
      const float baseline = at_ + page_.tx(kEndText * 0.95F);
      if (i < low.size()) page_.add_text(left(), baseline, Face::regular, kEndText, page_.colours.paper, low[i]);
      if (i < high.size()) {
        const float x = left() + inner_ - page_.measure(Face::regular, kEndText, high[i]);
        page_.add_text(std::floor(x), baseline, Face::regular, kEndText, page_.colours.paper, high[i]);
      }
      at_ += line;
    }
    at_ += gap;
  }
  void set_leave(const picture::OverlayButton& leave) {
    at_ += page_.px(6);
    const auto lines = page_.lines(Face::regular, kEndText, leave.text, inner_ - 2 * page_.tx(24));
    float width = least_;
    for (const std::string& line : lines)
      width = std::max(width, page_.measure(Face::regular, kEndText, line) + 2 * page_.tx(24));
    const float height = std::max(least_, static_cast<float>(lines.size()) * page_.tx(kEndText * 1.25F));
    const Box box{std::floor(left() + inner_ - width), at_, width, height};
    Eigen::Vector4f face = page_.colours.button;  // less prominent than an answer's
    face.w() *= 0.45F;
    add_button(page_, box, face, leave.action);
    add_centred(page_, box, Face::regular, kEndText, page_.colours.gold, lines);
    at_ += height;
  }

  Page& page_;
  const picture::OverlayPanel& panel_;
  float x_;
  float padding_;
  float inner_;
  float least_;  ///< height of a button
  std::size_t columns_;
  float at_;
};

void forget_from(OverlayLayout& out, std::size_t shapes, std::size_t texts, std::size_t targets) {
  out.shapes.resize(shapes);
  out.texts.resize(texts);
  out.targets.resize(targets);
}

}  // namespace

Box add_corner(Page& page, const std::vector<picture::OverlayButton>& buttons) {
  if (buttons.empty()) return {};
  const float height = page.finger();
  const float padding = page.px(18);
  const float house = std::round(0.46F * height);
  const float y = page.height - page.margin() - height;
  float right = page.width - page.margin();
  const float before = right;
  for (std::size_t i = buttons.size(); i-- > 0;) {
    const picture::OverlayButton& button = buttons[i];
    const bool home = button.action.kind == picture::OverlayAction::Kind::home;
    const float icon = home ? house + page.px(12) : 0;
    const float text = page.measure(Face::bold, kCornerText, button.text);
    const float width = std::max(height, std::ceil(icon + text + 2 * padding));
    const Box box{right - width, y, width, height};
    add_button(page, box, page.colours.ink, button.action);
    if (home) {
      Eigen::Vector4f door = page.colours.ink;
      door.w() = 1;
      add_house(page, box.x + padding, y + std::round((height - house) / 2), house, page.colours.gold, door);
    }
    add_centred(page, {box.x + icon, y, width - icon, height}, Face::bold, kCornerText, page.colours.paper,
                {button.text});
    right = box.x - page.px(12);
  }
  const float left = right + page.px(12);
  return {left, y, before - left, height};
}

void add_question_panel(Page& page, const picture::OverlayPanel& panel, const Box& room) {
  const float width = std::min(room.width, page.tx(860));
  const float x = std::round(room.x + (room.width - width) / 2);
  const float wanted = page.scale;
  const std::size_t shapes = page.out.shapes.size();
  const std::size_t texts = page.out.texts.size();
  const std::size_t targets = page.out.targets.size();
  page.add_panel({});  // its size is set at the end
  float height = 0;
  bool fits = false;
  // Make words and buttons smaller, and put answers side by side, until everything fits.
  for (float shrink = 1; !fits && shrink > 0.25F; shrink *= 0.94F) {
    page.scale = wanted * shrink;
    const float least = std::max(page.px(64 * shrink), std::min(page.finger(), 36.0F * std::min(1.0F, shrink * 1.5F)));
    for (const std::size_t columns : {std::size_t{1}, std::size_t{2}}) {
      if (columns > 1 && (panel.scale || panel.answers.size() < 3)) continue;
      forget_from(page.out, shapes + 1, texts, targets);
      height = QuestionPanel(page, panel, x, width, least, columns).set();
      fits = height <= room.height;
      if (fits) break;
    }
  }
  const float y = std::round(room.y + std::max(0.0F, room.height - height) / 2);
  page.move_down(shapes + 1, texts, targets, y);
  OverlayShape& face = page.out.shapes[shapes];
  face.x = x;
  face.y = y;
  face.width = width;
  face.height = height;
  page.scale = wanted;
}

}  // namespace mechane::draw
