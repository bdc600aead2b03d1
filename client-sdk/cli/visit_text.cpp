#include "client-sdk/cli/visit_text.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "client-sdk/cli/content_text.hpp"

namespace mechane::cli {
namespace {

using visits::MistakeKind;
using visits::SheetAnswer;
using visits::SheetMistake;
using visits::SheetStep;
using visits::StepEnding;
using visits::VisitEnding;
using visits::VisitSheet;
using Json = nlohmann::ordered_json;

std::size_t at(auto ending) {
  return static_cast<std::size_t>(ending);
}

/// Letters, not bytes: fmt pads so too.
std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0U) != 0x80U; }));
}

/// Columns as wide as they must be: the first to the left, the others to the right.
class Columns {
 public:
  explicit Columns(std::vector<std::string> head) { rows_.push_back(std::move(head)); }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  [[nodiscard]] bool is_empty() const { return rows_.size() == 1; }
  [[nodiscard]] std::string text(const std::string& indent, std::size_t to_the_left = 1) const {
    std::vector<std::size_t> widths(rows_.front().size());
    for (const auto& row : rows_) {
      for (std::size_t i = 0; i < row.size(); ++i)
        widths[i] = std::max(widths[i], letters_of(row[i]));
    }
    std::string out;
    for (const auto& row : rows_) {
      std::string line = indent;
      for (std::size_t i = 0; i < row.size(); ++i)
        line +=
            i < to_the_left ? fmt::format("{:<{}}  ", row[i], widths[i]) : fmt::format("{:>{}}  ", row[i], widths[i]);
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + "\n";
    }
    return out;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string count_text(std::size_t n, const char* one, const char* more) {
  return fmt::format("{} {}", n, n == 1 ? one : more);
}

std::string percent(std::size_t part, std::size_t all) {
  const auto share = share_of(part, all);
  return share ? fmt::format("{:.0f} %", 100 * *share) : std::string("-");
}

std::string seconds_text(const TimeSpread& time, double value_s) {
  return time.count == 0 ? std::string("-") : fmt::format("{:.1f}", value_s);
}

std::string named_or_dash(const std::string& text) {
  return text.empty() ? std::string("-") : shown(text);
}

std::string days(std::int64_t first, std::int64_t last) {
  const std::string from = visits::minute_text(first).substr(0, 10);
  const std::string to = visits::minute_text(last).substr(0, 10);
  return from == to ? "on " + from : "from " + from + " to " + to;
}

std::string endings_line(const ActivitySummary& a) {
  const std::size_t done = a.ended[at(VisitEnding::done)];
  std::string line =
      fmt::format("  done {} of {} ({}), {} without help ({}), {} left", done, a.whole(), percent(done, a.whole()),
                  a.done_alone, percent(a.done_alone, a.whole()), a.ended[at(VisitEnding::left)]);
  if (const std::size_t cut = a.ended[at(VisitEnding::cut)]; cut > 0)
    line += fmt::format("; {} cut off by a stop of the server", cut);
  if (const std::size_t running = a.ended[at(VisitEnding::running)]; running > 0)
    line += fmt::format("; {} not over", running);
  return line + "\n";
}

std::string mistakes_line(const ActivitySummary& a) {
  std::vector<std::string> kinds;
  for (std::size_t k = 0; k < a.mistakes.size(); ++k) {
    if (a.mistakes[k] > 0)
      kinds.push_back(fmt::format("{} {}", visits::word_of(static_cast<MistakeKind>(k)), a.mistakes[k]));
  }
  std::string line = fmt::format("  errors a visit {:.2f}{}; {}", a.mistakes_a_visit(),
                                 kinds.empty() ? "" : fmt::format(" ({})", fmt::join(kinds, ", ")),
                                 count_text(a.hints, "hint", "hints"));
  if (a.remarks > 0) line += "; " + count_text(a.remarks, "remark of an observer", "remarks of observers");
  return line + "\n";
}

std::string steps_table(const ActivitySummary& a) {
  Columns table({"step", "visits", "done", "median s", "p90 s", "hints", "timed out", "skipped"});
  for (const StepSummary& step : a.steps) {
    table.add({shown(step.name), fmt::format("{}", step.visits), fmt::format("{}", step.ended[at(StepEnding::done)]),
               seconds_text(step.time, step.time.median_s), seconds_text(step.time, step.time.p90_s),
               fmt::format("{}", step.hints), fmt::format("{}", step.ended[at(StepEnding::timed_out)]),
               fmt::format("{}", step.ended[at(StepEnding::skipped)])});
  }
  return table.is_empty() ? "" : "\n" + table.text("  ");
}

std::string questions_table(const ActivitySummary& a) {
  Columns table({"question", "asked", "answers", "mean", "spread", "satisfied", "right"});
  for (const QuestionSummary& q : a.questions) {
    const bool scale = !q.at_mark.empty();
    table.add({shown(q.name), std::string(visits::word_of(q.when)), fmt::format("{}", q.answers),
               scale ? fmt::format("{:.2f} of {}", q.mean, q.at_mark.size()) : "-",
               scale ? fmt::format("{:.2f}", q.spread) : "-", scale ? percent(q.satisfied, q.answers) : "-",
               percent(q.right, q.judged)});
  }
  return table.is_empty() ? "" : "\n" + table.text("  ", 2);
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// One field of a CSV line.
std::string field(std::string text) {
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos) text.insert(0, "'");
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string answer_value(const SheetAnswer& answer) {
  return answer.marks > 0 ? fmt::format("{}", answer.mark) : answer.value;
}

/// Columns that not every visit has: by what they are called.
using Cells = std::map<std::string, std::string>;

Cells cells_of(const VisitSheet& sheet) {
  Cells cells;
  std::map<std::string, double> times;
  for (const SheetStep& step : sheet.steps)
    times[step.name] += step.duration_s;
  for (const auto& [name, time_s] : times)
    cells[fmt::format("{} {} s", sheet.activity, name)] = fmt::format("{:.3f}", time_s);
  for (const SheetAnswer& answer : sheet.answers)
    cells[fmt::format("{} {}: {}", sheet.activity, visits::word_of(answer.when), answer.question)] =
        answer_value(answer);
  return cells;
}

std::vector<std::string> fixed_cells(const VisitSheet& sheet) {
  const auto steps = [&](const auto& fits) { return fmt::format("{}", std::ranges::count_if(sheet.steps, fits)); };
  std::vector<std::string> cells{sheet.number,
                                 visits::minute_text(sheet.minute),
                                 sheet.kiosk,
                                 sheet.scenario,
                                 sheet.scenario_hash,
                                 sheet.activity,
                                 sheet.language,
                                 std::string(word_of(sheet.ending)),
                                 sheet.done_alone() ? "yes" : "no",
                                 sheet.from_start ? "yes" : "no",
                                 fmt::format("{:.3f}", sheet.duration_s),
                                 fmt::format("{}", sheet.hands),
                                 sheet.went_on_to,
                                 steps([](const SheetStep& s) { return s.hint_shown; }),
                                 steps([](const SheetStep& s) { return s.ending == StepEnding::timed_out; }),
                                 steps([](const SheetStep& s) { return s.ending == StepEnding::skipped; })};
  for (std::size_t k = 0; k < visits::kMistakeKinds; ++k)
    cells.push_back(fmt::format("{}", sheet.count_of(static_cast<MistakeKind>(k))));
  std::vector<std::string> remarks;
  for (const visits::SheetRemark& remark : sheet.remarks)
    remarks.push_back(remark.text);
  cells.push_back(fmt::format("{}", fmt::join(remarks, "\n")));
  return cells;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells)
    line += (&cell == cells.data() ? "" : ",") + field(cell);
  return line + "\r\n";
}

Json json_of(const TimeSpread& time) {
  if (time.count == 0) return {{"count", 0}};
  return {{"count", time.count}, {"median_s", time.median_s}, {"p90_s", time.p90_s}};
}

Json json_of(const QuestionSummary& q) {
  Json json{{"question", q.name}, {"asked", visits::word_of(q.when)}, {"answers", q.answers}};
  if (!q.at_mark.empty()) {
    json.update({{"at_mark", q.at_mark}, {"mean", q.mean}, {"spread", q.spread}, {"satisfied", q.satisfied}});
  } else {
    json["chose"] = q.chose;
  }
  if (q.judged > 0) json.update({{"judged", q.judged}, {"right", q.right}});
  return json;
}

Json json_of(const ActivitySummary& a) {
  Json steps = Json::array();
  for (const StepSummary& s : a.steps) {
    steps.push_back({{"step", s.name},
                     {"visits", s.visits},
                     {"done", s.ended[at(StepEnding::done)]},
                     {"timed_out", s.ended[at(StepEnding::timed_out)]},
                     {"skipped", s.ended[at(StepEnding::skipped)]},
                     {"unfinished", s.ended[at(StepEnding::unfinished)]},
                     {"hints", s.hints},
                     {"time", json_of(s.time)}});
  }
  Json questions = Json::array();
  for (const QuestionSummary& q : a.questions)
    questions.push_back(json_of(q));
  Json mistakes = Json::object();
  for (std::size_t k = 0; k < a.mistakes.size(); ++k)
    mistakes[std::string(visits::word_of(static_cast<MistakeKind>(k)))] = a.mistakes[k];
  return {{"scenario", a.scenario},
          {"activity", a.activity},
          {"visits", a.visits},
          {"done", a.ended[at(VisitEnding::done)]},
          {"done_alone", a.done_alone},
          {"left", a.ended[at(VisitEnding::left)]},
          {"cut", a.ended[at(VisitEnding::cut)]},
          {"running", a.ended[at(VisitEnding::running)]},
          {"incomplete", a.incomplete},
          {"time", json_of(a.time)},
          {"mistakes", mistakes},
          {"mistakes_a_visit", a.mistakes_a_visit()},
          {"hints", a.hints},
          {"remarks", a.remarks},
          {"steps", steps},
          {"questions", questions}};
}

Json json_of(const SheetAnswer& answer) {
  Json json{{"question", answer.question}, {"asked", visits::word_of(answer.when)}};
  if (answer.marks > 0) {
    json.update({{"mark", answer.mark}, {"marks", answer.marks}});
  } else {
    json["answer"] = answer.value;
  }
  if (answer.right) json["right"] = *answer.right;
  return json;
}

Json json_of(const VisitSheet& sheet) {
  Json steps = Json::array();
  for (const SheetStep& s : sheet.steps) {
    steps.push_back({{"step", s.name},
                     {"duration_s", s.duration_s},
                     {"ending", word_of(s.ending)},
                     {"hint_shown", s.hint_shown},
                     {"whole", s.whole}});
  }
  Json mistakes = Json::array();
  for (const SheetMistake& m : sheet.mistakes)
    mistakes.push_back({{"kind", word_of(m.kind)}, {"subject", m.subject}, {"count", m.count}});
  Json answers = Json::array();
  for (const SheetAnswer& answer : sheet.answers)
    answers.push_back(json_of(answer));
  Json remarks = Json::array();
  for (const visits::SheetRemark& remark : sheet.remarks)
    remarks.push_back({{"when", visits::minute_text(remark.minute)}, {"text", remark.text}});
  return {{"visit", sheet.number},
          {"began", visits::minute_text(sheet.minute)},
          {"kiosk", sheet.kiosk},
          {"scenario", sheet.scenario},
          {"scenario_hash", sheet.scenario_hash},
          {"activity", sheet.activity},
          {"language", sheet.language},
          {"ending", word_of(sheet.ending)},
          {"done_alone", sheet.done_alone()},
          {"from_start", sheet.from_start},
          {"duration_s", sheet.duration_s},
          {"hands", sheet.hands},
          {"went_on_to", sheet.went_on_to},
          {"notes_lost", sheet.notes_lost},
          {"steps", steps},
          {"mistakes", mistakes},
          {"answers", answers},
          {"remarks", remarks}};
}

}  // namespace

std::string visits_report(std::span<const ActivitySummary> activities) {
  std::string text;
  std::size_t visits = 0;
  for (const ActivitySummary& a : activities) {
    visits += a.visits;
    text += fmt::format("{}, {}: {} {}\n", shown(a.scenario), shown(a.activity),
                        count_text(a.visits, "visit", "visits"), days(a.first_minute, a.last_minute));
    text += endings_line(a);
    if (a.time.count > 0)
      text += fmt::format("  from start to end: median {:.1f} s, nine of ten within {:.1f} s\n", a.time.median_s,
                          a.time.p90_s);
    text += mistakes_line(a);
    if (a.incomplete > 0)
      text +=
          fmt::format("  {} not noted in full, for the server was busy\n", count_text(a.incomplete, "visit", "visits"));
    text += steps_table(a) + questions_table(a) + "\n";
  }
  const Satisfaction all = satisfaction_of(activities);
  text += count_text(visits, "visit", "visits");
  if (all.marks > 0)
    text += fmt::format("; satisfied: {} ({} of {} marks given afterwards lie above the middle)",
                        percent(all.satisfied, all.marks), all.satisfied, all.marks);
  return text + "\n";
}

std::string visits_list(std::span<const VisitSheet> sheets) {
  Columns table({"visit", "began (UTC)", "kiosk", "scenario", "activity", "ending", "time s", "errors", "hints",
                 "answers", "remarks"});
  for (const VisitSheet& sheet : sheets) {
    std::uint32_t mistakes = 0;
    for (const SheetMistake& mistake : sheet.mistakes)
      mistakes += mistake.count;
    const auto hints = std::ranges::count_if(sheet.steps, [](const SheetStep& step) { return step.hint_shown; });
    table.add({sheet.number, visits::minute_text(sheet.minute), shown(sheet.kiosk), shown(sheet.scenario),
               shown(sheet.activity), std::string(word_of(sheet.ending)), fmt::format("{:.1f}", sheet.duration_s),
               fmt::format("{}", mistakes), fmt::format("{}", hints), fmt::format("{}", sheet.answers.size()),
               fmt::format("{}", sheet.remarks.size())});
  }
  return (table.is_empty() ? "" : table.text("", 6)) + count_text(sheets.size(), "visit", "visits") + "\n";
}

std::string visit_page(const VisitSheet& sheet) {
  std::string page = fmt::format("{}: {}, {}\n", sheet.number, shown(sheet.scenario), shown(sheet.activity));
  const auto line = [&](const char* what, const std::string& text) { page += fmt::format("  {:<9} {}\n", what, text); };
  line("began", visits::minute_text(sheet.minute) + " UTC, at " + shown(sheet.kiosk));
  line("language", named_or_dash(sheet.language));
  line("hands", fmt::format("{}", sheet.hands));
  line("ending", fmt::format("{} after {:.1f} s{}{}", word_of(sheet.ending), sheet.duration_s,
                             sheet.from_start ? "" : ", begun in the midst",
                             sheet.went_on_to.empty() ? "" : ", went on to " + shown(sheet.went_on_to)));
  for (const SheetStep& step : sheet.steps)
    line("step", fmt::format("{}: {}, {:.1f} s{}{}", shown(step.name), word_of(step.ending), step.duration_s,
                             step.hint_shown ? ", with a hint" : "", step.whole ? "" : ", seen in part"));
  for (const SheetMistake& mistake : sheet.mistakes)
    line("error", fmt::format("{}{}, {}", word_of(mistake.kind),
                              mistake.subject.empty() ? "" : " (" + shown(mistake.subject) + ")",
                              count_text(mistake.count, "time", "times")));
  for (const SheetAnswer& answer : sheet.answers) {
    const std::string value =
        answer.marks > 0 ? fmt::format("{} of {}", answer.mark, answer.marks) : shown(answer.value);
    line("answer", fmt::format("{}, {}: {}{}", shown(answer.question), visits::word_of(answer.when), value,
                               !answer.right ? "" : (*answer.right ? ", right" : ", wrong")));
  }
  for (const visits::SheetRemark& remark : sheet.remarks)
    line("remark", fmt::format("{}: {}", visits::minute_text(remark.minute), shown(remark.text)));
  return page;
}

std::string visits_csv(std::span<const VisitSheet> sheets) {
  std::vector<std::string> head{"visit",      "began (UTC)", "kiosk",      "scenario",   "scenario hash", "activity",
                                "language",   "ending",      "done alone", "from start", "duration s",    "hands",
                                "went on to", "hints",       "timed out",  "skipped"};
  for (std::size_t k = 0; k < visits::kMistakeKinds; ++k)
    head.emplace_back(word_of(static_cast<MistakeKind>(k)));
  head.emplace_back("remarks");
  Cells columns;
  for (const VisitSheet& sheet : sheets)
    columns.merge(cells_of(sheet));
  for (const auto& [name, unused] : columns)
    head.push_back(name);
  std::string csv = csv_line(head);
  for (const VisitSheet& sheet : sheets) {
    std::vector<std::string> line = fixed_cells(sheet);
    const Cells cells = cells_of(sheet);
    for (const auto& [name, unused] : columns) {
      const auto cell = cells.find(name);
      line.push_back(cell == cells.end() ? "" : cell->second);
    }
    csv += csv_line(line);
  }
  return csv;
}

std::string report_json(std::span<const ActivitySummary> activities) {
  Json list = Json::array();
  std::size_t visits = 0;
  for (const ActivitySummary& activity : activities) {
    list.push_back(json_of(activity));
    visits += activity.visits;
  }
  const Satisfaction all = satisfaction_of(activities);
  return dumped({{"visits", visits},
                 {"satisfaction", {{"marks", all.marks}, {"satisfied", all.satisfied}}},
                 {"activities", list}});
}

std::string sheets_json(std::span<const VisitSheet> sheets) {
  Json list = Json::array();
  for (const VisitSheet& sheet : sheets)
    list.push_back(json_of(sheet));
  return dumped(list);
}

}  // namespace mechane::cli
