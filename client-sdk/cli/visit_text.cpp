#include "client-sdk/cli/visit_text.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "client-sdk/cli/columns.hpp"
#include "client-sdk/cli/content_text.hpp"

namespace mechane::cli {
namespace {

using visits::ActivitySummary;
using visits::MistakeKind;
using visits::QuestionSummary;
using visits::RecordedAnswer;
using visits::RecordedMistake;
using visits::RecordedStep;
using visits::Satisfaction;
using visits::StepEnding;
using visits::StepSummary;
using visits::TimeSpread;
using visits::VisitEnding;
using visits::VisitRecord;
using Json = nlohmann::ordered_json;

std::size_t at(auto ending) {
  return static_cast<std::size_t>(ending);
}

std::string percent(std::size_t part, std::size_t all) {
  const auto share = share_of(part, all);
  return share ? fmt::format("{:.0f} %", 100 * *share) : std::string("-");
}

std::string seconds_text(const TimeSpread& time, double value_s) {
  return time.count == 0 ? std::string("-") : fmt::format("{:.1f}", value_s);
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
  Columns table({"step", "visits", "done", "median s", "p90 s", "hints", "timed out", "skipped"}, "<>");
  for (const StepSummary& step : a.steps) {
    table.add({shown(step.name), fmt::format("{}", step.visits), fmt::format("{}", step.ended[at(StepEnding::done)]),
               seconds_text(step.time, step.time.median_s), seconds_text(step.time, step.time.p90_s),
               fmt::format("{}", step.hints), fmt::format("{}", step.ended[at(StepEnding::timed_out)]),
               fmt::format("{}", step.ended[at(StepEnding::skipped)])});
  }
  return table.is_empty() ? "" : fmt::format("\n{}", table.text("  "));
}

std::string questions_table(const ActivitySummary& a) {
  Columns table({"question", "asked", "answers", "mean", "spread", "satisfied", "right"}, "<<>");
  for (const QuestionSummary& q : a.questions) {
    const bool scale = !q.at_mark.empty();
    table.add({shown(q.name), std::string(visits::word_of(q.when)), fmt::format("{}", q.answers),
               scale ? fmt::format("{:.2f} of {}", q.mean, q.at_mark.size()) : "-",
               scale ? fmt::format("{:.2f}", q.spread) : "-", scale ? percent(q.satisfied, q.answers) : "-",
               percent(q.right, q.judged)});
  }
  return table.is_empty() ? "" : fmt::format("\n{}", table.text("  "));
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
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

Json json_of(const RecordedAnswer& answer) {
  Json json{{"question", answer.question}, {"asked", visits::word_of(answer.when)}};
  if (answer.marks > 0) {
    json.update({{"mark", answer.mark}, {"marks", answer.marks}});
  } else {
    json["answer"] = answer.value;
  }
  if (answer.right) json["right"] = *answer.right;
  return json;
}

Json json_of(const visits::RecordedRemark& remark) {
  Json json{{"when", visits::minute_text(remark.minute)}, {"text", remark.text}};
  if (!remark.author.empty()) json["author"] = remark.author;
  if (remark.at_s) json["at_s"] = *remark.at_s;
  return json;
}

Json json_of(const VisitRecord& record) {
  Json steps = Json::array();
  for (const RecordedStep& s : record.steps) {
    steps.push_back({{"step", s.name},
                     {"duration_s", s.duration_s},
                     {"ending", word_of(s.ending)},
                     {"hint_shown", s.hint_shown},
                     {"whole", s.whole}});
  }
  Json mistakes = Json::array();
  for (const RecordedMistake& m : record.mistakes)
    mistakes.push_back({{"kind", word_of(m.kind)}, {"subject", m.subject}, {"count", m.count}});
  Json answers = Json::array();
  for (const RecordedAnswer& answer : record.answers)
    answers.push_back(json_of(answer));
  Json remarks = Json::array();
  for (const visits::RecordedRemark& remark : record.remarks)
    remarks.push_back(json_of(remark));
  return {{"visit", record.number},
          {"began", visits::minute_text(record.minute)},
          {"kiosk", record.kiosk},
          {"scenario", record.scenario},
          {"scenario_hash", record.scenario_hash},
          {"activity", record.activity},
          {"language", record.language},
          {"ending", word_of(record.ending)},
          {"done_alone", record.done_alone()},
          {"from_start", record.from_start},
          {"duration_s", record.duration_s},
          {"hands", record.hands},
          {"went_on_to", record.went_on_to},
          {"notes_lost", record.notes_lost},
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

std::string visits_list(std::span<const VisitRecord> records) {
  Columns table({"visit", "began (UTC)", "kiosk", "scenario", "activity", "ending", "time s", "errors", "hints",
                 "answers", "remarks"},
                "<<<<<<>");
  for (const VisitRecord& record : records) {
    std::uint32_t mistakes = 0;
    for (const RecordedMistake& mistake : record.mistakes)
      mistakes += mistake.count;
    const auto hints = std::ranges::count_if(record.steps, [](const RecordedStep& step) { return step.hint_shown; });
    table.add({record.number, visits::minute_text(record.minute), shown(record.kiosk), shown(record.scenario),
               shown(record.activity), std::string(word_of(record.ending)), fmt::format("{:.1f}", record.duration_s),
               fmt::format("{}", mistakes), fmt::format("{}", hints), fmt::format("{}", record.answers.size()),
               fmt::format("{}", record.remarks.size())});
  }
  return (table.is_empty() ? "" : table.text()) + count_text(records.size(), "visit", "visits") + "\n";
}

std::string visit_page(const VisitRecord& record) {
  std::string page = fmt::format("{}: {}, {}\n", record.number, shown(record.scenario), shown(record.activity));
  const auto line = [&](const char* what, const std::string& text) { page += fmt::format("  {:<9} {}\n", what, text); };
  line("began", visits::minute_text(record.minute) + " UTC, at " + shown(record.kiosk));
  line("language", or_dash(record.language));
  line("hands", fmt::format("{}", record.hands));
  line("ending", fmt::format("{} after {:.1f} s{}{}", word_of(record.ending), record.duration_s,
                             record.from_start ? "" : ", begun in the midst",
                             record.went_on_to.empty() ? "" : ", went on to " + shown(record.went_on_to)));
  for (const RecordedStep& step : record.steps)
    line("step", fmt::format("{}: {}, {:.1f} s{}{}", shown(step.name), word_of(step.ending), step.duration_s,
                             step.hint_shown ? ", with a hint" : "", step.whole ? "" : ", seen in part"));
  for (const RecordedMistake& mistake : record.mistakes)
    line("error", fmt::format("{}{}, {}", word_of(mistake.kind),
                              mistake.subject.empty() ? "" : " (" + shown(mistake.subject) + ")",
                              count_text(mistake.count, "time", "times")));
  for (const RecordedAnswer& answer : record.answers) {
    const std::string value =
        answer.marks > 0 ? fmt::format("{} of {}", answer.mark, answer.marks) : shown(answer.value);
    line("answer", fmt::format("{}, {}: {}{}", shown(answer.question), visits::word_of(answer.when), value,
                               !answer.right ? "" : (*answer.right ? ", right" : ", wrong")));
  }
  for (const visits::RecordedRemark& remark : record.remarks)
    line("remark", fmt::format("{}: {}", visits::minute_text(remark.minute), shown(remark_line(remark))));
  return page;
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

std::string visits_json(std::span<const VisitRecord> records) {
  Json list = Json::array();
  for (const VisitRecord& record : records)
    list.push_back(json_of(record));
  return dumped(list);
}

}  // namespace mechane::cli
