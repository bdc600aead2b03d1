#include "client-sdk/cli/visit_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "client-sdk/cli/content_text.hpp"
#include "server/base/markup.hpp"
#include "server/base/utf8.hpp"

namespace mechane::cli {
namespace {

using visits::ActivitySummary;
using visits::AnswerTime;
using visits::QuestionSummary;
using visits::Satisfaction;
using visits::share_of;
using visits::StepSummary;
using visits::VisitEnding;

// The colours of the benchmarks' plots.
constexpr const char* kInk = "#1f1e1b";
constexpr const char* kQuiet = "#6b6a64";
constexpr const char* kGrid = "#e4e2da";
constexpr const char* kPaper = "#fcfcfb";
constexpr const char* kStrong = "#2a78d6";
constexpr const char* kMuted = "#a9bccf";
constexpr const char* kWarm = "#eb6834";

constexpr double kWidth = 900;
constexpr double kLeft = 210;
constexpr double kRight = 150;
constexpr double kField = kWidth - kLeft - kRight;
constexpr double kRow = 28;
constexpr double kFootOfAxis = 30;
constexpr std::size_t kLongestName = 26;

/// A file's text, escaped for XML; it ends at the first byte that is not UTF-8.
std::string escaped(const std::string& text) {
  return escape_markup(shown(text.substr(0, first_bad_utf8(text).value_or(text.size()))));
}

/// At most `letters` letters of a text; UTF-8 letters are not cut.
std::string shortened(const std::string& text, std::size_t letters) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (begins_letter(text[i]) && ++seen > letters) return text.substr(0, i) + "…";
  }
  return text;
}

struct TextStyle {
  int size = 12;
  const char* colour = kInk;
  const char* anchor = "start";
  bool bold = false;
};

/// Draws from the top down; later shapes cover earlier ones.
class Page {
 public:
  double y = 0;

  void text(double x, double at, const std::string& words, const TextStyle& style = {}) {
    body_ += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' font-family='DejaVu Sans, Helvetica, Arial, sans-serif' font-size='{}' "
        "font-weight='{}' fill='{}' text-anchor='{}'>{}</text>\n",
        x, at, style.size, style.bold ? "bold" : "normal", style.colour, style.anchor, escaped(words));
  }
  void name(double at, const std::string& words) {
    text(kLeft - 12, at, shortened(words, kLongestName), {.anchor = "end"});
  }
  void value(double at, const std::string& words) {
    text(kWidth - kRight + 12, at, words, {.size = 11, .colour = kQuiet});
  }
  void line(double x1, double y1, double x2, double y2, const char* colour, double width = 1) {
    body_ += fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='{}' stroke-width='{}'/>\n", x1,
                         y1, x2, y2, colour, width);
  }
  void box(double x, double top, double width, double height, const std::string& colour) {
    if (width <= 0) return;
    body_ += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>\n", x, top, width,
                         height, colour);
  }
  void dot(double x, double at, double radius, const char* fill, const char* edge) {
    body_ += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}' stroke='{}' stroke-width='2'/>\n", x, at,
                         radius, fill, edge);
  }
  [[nodiscard]] std::string svg() const {
    const double height = y + 20;
    return fmt::format(
               "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
               "height='{1:.0f}'>\n"
               "<rect width='{0:.0f}' height='{1:.0f}' fill='{2}'/>\n",
               kWidth, height, kPaper) +
           body_ + "</svg>\n";
  }

 private:
  std::string body_;
};

/// A step of 1, 2 or 5 times a power of ten, so that about five marks reach `highest`.
double step_of_axis(double highest) {
  const double decade = std::pow(10, std::floor(std::log10(highest / 5)));
  for (const double m : {1.0, 2.0, 5.0, 10.0}) {
    if (m * decade * 5 >= highest) return m * decade;
  }
  return 10 * decade;
}

/// Draws the parts of a whole side by side, each with its percentage if there is room.
struct Part {
  std::size_t count;
  std::string colour;
  const char* ink;
};
void stacked(Page& page, const std::vector<Part>& parts) {
  const std::size_t all = std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                                          [](std::size_t n, const Part& p) { return n + p.count; });
  double x = kLeft;
  for (const Part& part : parts) {
    if (part.count == 0) continue;
    const double width = kField * static_cast<double>(part.count) / static_cast<double>(all);
    page.box(x, page.y + 4, width - 1.5, kRow - 8, part.colour);
    if (width > 34)
      page.text(x + width / 2, page.y + 18, fmt::format("{:.0f} %", 100 * width / kField),
                {.size = 11, .colour = part.ink, .anchor = "middle"});
    x += width;
  }
}

void heading(Page& page, const std::string& words, const std::string& unit) {
  page.y += 14;
  if (!words.empty()) page.text(kLeft, page.y + 12, words, {.size = 11, .colour = kQuiet});
  page.text(kWidth - kRight + 12, page.y + 12, unit, {.size = 11, .colour = kQuiet});
  page.y += 20;
}

void draw_endings(Page& page, const ActivitySummary& a) {
  const std::size_t done = a.ended[static_cast<std::size_t>(VisitEnding::done)];
  const std::size_t left = a.ended[static_cast<std::size_t>(VisitEnding::left)];
  if (a.whole() == 0) return;
  heading(page, "", "errors a visit");
  double x = kLeft;
  for (const auto& [words, colour, room] :
       {std::tuple("done without help", kStrong, 138.0), std::tuple("done with a hint or other help", kMuted, 206.0),
        std::tuple("left before the end", kWarm, 0.0)}) {
    page.box(x, page.y - 17, 10, 10, colour);
    page.text(x + 15, page.y - 8, words, {.size = 11, .colour = kQuiet});
    x += room;
  }
  page.name(page.y + 18, "task done");
  stacked(
      page,
      {{a.done_alone, kStrong, kPaper}, {done - std::min(done, a.done_alone), kMuted, kInk}, {left, kWarm, kPaper}});
  page.value(page.y + 18, fmt::format("{:.2f}", a.mistakes_a_visit()));
  page.y += kRow;
}

void draw_axis(Page& page, double top, double highest) {
  const double step = step_of_axis(highest);
  for (int i = 0; i * step <= highest * 1.0001; ++i) {
    const double x = kLeft + kField * (i * step) / highest;
    page.line(x, top, x, page.y, kGrid);
    page.text(x, page.y + 16, fmt::format("{:g} s", i * step), {.size = 11, .colour = kQuiet, .anchor = "middle"});
  }
}

void draw_steps(Page& page, const ActivitySummary& a) {
  double highest = 0;
  for (const StepSummary& step : a.steps)
    highest = std::max(highest, step.time.p90_s);
  if (highest <= 0) return;
  highest *= 1.04;
  heading(page, "time in each step: the median, and up to where nine of ten were done", "hints, visits");
  const double top = page.y;
  page.y += kRow * static_cast<double>(a.steps.size());
  draw_axis(page, top, highest);
  page.y = top;  // the rows cover the axis
  for (const StepSummary& step : a.steps) {
    const double middle = page.y + kRow / 2;
    page.name(middle + 4, step.name);
    if (step.time.count > 0) {
      const double x = kLeft + kField * step.time.median_s / highest;
      const double far = kLeft + kField * step.time.p90_s / highest;
      page.box(x, middle - 4, far - x, 8, kMuted);
      page.line(far, middle - 7, far, middle + 7, kStrong, 2);
      page.dot(x, middle, 5, kStrong, kStrong);
    }
    page.value(middle + 4, fmt::format("{} hint{}, {} visit{}", step.hints, step.hints == 1 ? "" : "s", step.visits,
                                       step.visits == 1 ? "" : "s"));
    page.y += kRow;
  }
  page.y += kFootOfAxis;
}

/// From a warm colour at the lowest mark over grey to blue at the highest.
Part part_of_mark(std::size_t mark, std::size_t marks, std::size_t count) {
  struct Colour {
    double r, g, b;
  };
  constexpr std::array<Colour, 3> kStops{{{235, 104, 52}, {222, 219, 209}, {42, 120, 214}}};
  const double at = marks < 2 ? 2 : 2 * static_cast<double>(mark - 1) / static_cast<double>(marks - 1);
  const std::size_t i = at < 1 ? 0 : 1;
  const double t = at - static_cast<double>(i);
  const auto mix = [&](double Colour::*part) {
    return static_cast<int>(std::lround(kStops[i].*part * (1 - t) + kStops[i + 1].*part * t));
  };
  return {count, fmt::format("#{:02x}{:02x}{:02x}", mix(&Colour::r), mix(&Colour::g), mix(&Colour::b)),
          at > 1.6 ? kPaper : kInk};
}

void draw_scales(Page& page, const ActivitySummary& a) {
  const auto is_scale = [](const QuestionSummary& q) { return !q.at_mark.empty(); };
  if (std::ranges::none_of(a.questions, is_scale)) return;
  heading(page, "marks, from the lowest to the highest", "mean ± spread");
  for (const QuestionSummary& q : a.questions) {
    if (!is_scale(q)) continue;
    std::vector<Part> parts;
    for (std::size_t mark = 1; mark <= q.at_mark.size(); ++mark)
      parts.push_back(part_of_mark(mark, q.at_mark.size(), q.at_mark[mark - 1]));
    page.name(page.y + 18, q.when == AnswerTime::before ? q.name + " (before)" : q.name);
    stacked(page, parts);
    page.value(page.y + 18, fmt::format("{:.1f} ± {:.1f} of {}, n {}", q.mean, q.spread, q.at_mark.size(), q.answers));
    page.y += kRow;
  }
}

struct RightShares {
  const QuestionSummary* before = nullptr;
  const QuestionSummary* after = nullptr;
};

void draw_right_row(Page& page, const std::string& name, const RightShares& shares) {
  const double middle = page.y + kRow / 2;
  const auto x_of = [](const QuestionSummary& q) { return kLeft + kField * share_of(q.right, q.judged).value_or(0); };
  const auto percent = [](const QuestionSummary* q) {
    return q == nullptr ? std::string("–") : fmt::format("{:.0f}", 100 * share_of(q->right, q->judged).value_or(0));
  };
  page.name(middle + 4, name);
  if (shares.before != nullptr && shares.after != nullptr)
    page.line(x_of(*shares.before), middle, x_of(*shares.after), middle, kMuted, 4);
  if (shares.before != nullptr) page.dot(x_of(*shares.before), middle, 5, kPaper, kStrong);
  if (shares.after != nullptr) page.dot(x_of(*shares.after), middle, 5, kStrong, kStrong);
  page.value(middle + 4, fmt::format("{} → {} %", percent(shares.before), percent(shares.after)));
  page.y += kRow;
}

void draw_right(Page& page, const ActivitySummary& a) {
  std::map<std::string, RightShares> questions;
  for (const QuestionSummary& q : a.questions) {
    if (q.judged > 0) (q.when == AnswerTime::before ? questions[q.name].before : questions[q.name].after) = &q;
  }
  if (questions.empty()) return;
  heading(page, "right answers: before (ring) and after (dot) the visit", "before → after");
  const double bottom = page.y + kRow * static_cast<double>(questions.size());
  for (int percent = 0; percent <= 100; percent += 25) {
    const double x = kLeft + kField * percent / 100;
    page.line(x, page.y, x, bottom, kGrid);
    page.text(x, bottom + 16, fmt::format("{} %", percent), {.size = 11, .colour = kQuiet, .anchor = "middle"});
  }
  for (const auto& [name, shares] : questions)
    draw_right_row(page, name, shares);
  page.y += kFootOfAxis;
}

std::string subtitle_of(std::span<const ActivitySummary> activities) {
  std::size_t visits = 0;
  std::int64_t first = activities.front().first_minute;
  std::int64_t last = 0;
  for (const ActivitySummary& a : activities) {
    visits += a.visits;
    first = std::min(first, a.first_minute);
    last = std::max(last, a.last_minute);
  }
  std::string text = fmt::format("{} visit{}, {} to {}", visits, visits == 1 ? "" : "s",
                                 visits::minute_text(first).substr(0, 10), visits::minute_text(last).substr(0, 10));
  const Satisfaction all = satisfaction_of(activities);
  if (const auto share = share_of(all.satisfied, all.marks))
    text += fmt::format("; {:.0f} % of {} marks given afterwards lie above the middle", 100 * *share, all.marks);
  return text;
}

}  // namespace

std::string visits_svg(std::span<const ActivitySummary> activities) {
  Page page;
  page.text(24, 34, "What visitors did and said", {.size = 18, .bold = true});
  page.text(24, 56, activities.empty() ? "no visit yet" : subtitle_of(activities), {.colour = kQuiet});
  page.y = 76;
  for (const ActivitySummary& a : activities) {
    page.line(24, page.y, kWidth - 24, page.y, kGrid);
    page.text(24, page.y + 26, a.scenario + ", " + a.activity, {.size = 14, .bold = true});
    page.text(kWidth - 24, page.y + 26, fmt::format("{} visit{}", a.visits, a.visits == 1 ? "" : "s"),
              {.colour = kQuiet, .anchor = "end"});
    page.y += 34;
    draw_endings(page, a);
    draw_steps(page, a);
    draw_scales(page, a);
    draw_right(page, a);
    page.y += 22;
  }
  return page.svg();
}

}  // namespace mechane::cli
