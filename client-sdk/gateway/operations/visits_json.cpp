#include "client-sdk/gateway/operations/visits_json.hpp"

#include <algorithm>
#include <span>

#include <nlohmann/json.hpp>

#include "server/visits/visit_statistics.hpp"

namespace mechane::gateway {
namespace {

using VisitsJson = nlohmann::json;
using visits::StepEnding;
using visits::VisitEnding;
using visits::VisitRecord;

std::size_t ended_as(const auto& summary, auto ending) {
  return summary.ended[static_cast<std::size_t>(ending)];
}

VisitsJson time_json(const visits::TimeSpread& time) {
  return {{"count", time.count}, {"medianS", time.median_s}, {"p90S", time.p90_s}};
}

VisitsJson step_json(const visits::StepSummary& step) {
  return {{"step", step.name},
          {"visits", step.visits},
          {"done", ended_as(step, StepEnding::done)},
          {"timedOut", ended_as(step, StepEnding::timed_out)},
          {"skipped", ended_as(step, StepEnding::skipped)},
          {"left", step.left},
          {"hints", step.hints},
          {"time", time_json(step.time)}};
}

VisitsJson question_json(const visits::QuestionSummary& q) {
  VisitsJson json{{"question", q.name}, {"asked", visits::word_of(q.when)}, {"answers", q.answers}};
  if (q.at_mark.empty()) {
    json["chose"] = q.chose;
  } else {
    json.update({{"atMark", q.at_mark}, {"mean", q.mean}, {"spread", q.spread}, {"satisfied", q.satisfied}});
  }
  if (q.judged > 0) json.update({{"judged", q.judged}, {"right", q.right}});
  return json;
}

VisitsJson activity_json(const visits::ActivitySummary& a) {
  VisitsJson steps = VisitsJson::array(), questions = VisitsJson::array(), mistakes = VisitsJson::object();
  for (const visits::StepSummary& step : a.steps)
    steps.push_back(step_json(step));
  for (const visits::QuestionSummary& question : a.questions)
    questions.push_back(question_json(question));
  for (std::size_t k = 0; k < a.mistakes.size(); ++k)
    mistakes[std::string(visits::word_of(static_cast<visits::MistakeKind>(k)))] = a.mistakes[k];
  return {{"scenario", a.scenario},
          {"activity", a.activity},
          {"visits", a.visits},
          {"done", ended_as(a, VisitEnding::done)},
          {"doneAlone", a.done_alone},
          {"left", ended_as(a, VisitEnding::left)},
          {"cut", ended_as(a, VisitEnding::cut)},
          {"running", ended_as(a, VisitEnding::running)},
          {"incomplete", a.incomplete},
          {"time", time_json(a.time)},
          {"mistakes", mistakes},
          {"mistakesAVisit", a.mistakes_a_visit()},
          {"hints", a.hints},
          {"remarks", a.remarks},
          {"steps", steps},
          {"questions", questions}};
}

VisitsJson counts_json(const std::vector<visits::EndingCount>& counts) {
  VisitsJson list = VisitsJson::array();
  for (const visits::EndingCount& count : counts)
    list.push_back({{"name", count.name},
                    {"visits", count.visits},
                    {"done", count.done},
                    {"doneAlone", count.done_alone},
                    {"left", count.left}});
  return list;
}

VisitsJson remark_list(const VisitRecord& record) {
  VisitsJson list = VisitsJson::array();
  for (const visits::RecordedRemark& remark : record.remarks) {
    list.push_back({{"when", visits::minute_text(remark.minute)}, {"author", remark.author}, {"text", remark.text}});
    if (remark.at_s) list.back()["at"] = *remark.at_s;
  }
  return list;
}

VisitsJson visit_json(const VisitRecord& record) {
  VisitsJson steps = VisitsJson::array();
  for (const visits::RecordedStep& step : record.steps)
    steps.push_back({{"step", step.name},
                     {"durationS", step.duration_s},
                     {"ending", word_of(step.ending)},
                     {"hint", step.hint_shown}});
  return {{"visit", record.number},
          {"began", visits::minute_text(record.minute)},
          {"kiosk", record.kiosk},
          {"scenario", record.scenario},
          {"activity", record.activity},
          {"language", record.language},
          {"ending", word_of(record.ending)},
          {"doneAlone", record.done_alone()},
          {"durationS", record.duration_s},
          {"steps", steps},
          {"remarks", remark_list(record)}};
}

std::string dumped(const VisitsJson& json) {
  return json.dump(-1, ' ', false, VisitsJson::error_handler_t::replace);
}

}  // namespace

std::string visits_json(const VisitsFound& found) {
  const std::vector<visits::ActivitySummary> activities = visits::summarise(found.records);
  const visits::Satisfaction satisfaction = visits::satisfaction_of(activities);
  VisitsJson list = VisitsJson::array(), days = VisitsJson::array(), recent = VisitsJson::array();
  for (const visits::ActivitySummary& activity : activities)
    list.push_back(activity_json(activity));
  for (const visits::DayCount& day : visits::count_days(found.records, found.since, found.now))
    days.push_back({{"day", day.day}, {"visits", day.visits}, {"done", day.done}});
  const std::size_t told = std::min(found.records.size(), kVisitsTold);
  for (const VisitRecord& record : std::span(found.records).last(told))
    recent.insert(recent.begin(), visit_json(record));
  return dumped({{"days", found.query.days},
                 {"visits", found.records.size()},
                 {"cut", found.cut},
                 {"exhibitNames", found.exhibits},
                 {"languageNames", found.languages},
                 {"satisfaction", {{"marks", satisfaction.marks}, {"satisfied", satisfaction.satisfied}}},
                 {"exhibits", counts_json(visits::count_by(found.records, &VisitRecord::scenario))},
                 {"languages", counts_json(visits::count_by(found.records, &VisitRecord::language))},
                 {"perDay", days},
                 {"activities", list},
                 {"recent", recent}});
}

std::string remarks_json(const VisitRecord& record) {
  return dumped({{"visit", record.number}, {"remarks", remark_list(record)}});
}

std::string playback_json(const VisitRecord& record, std::string_view state, double share, const std::string& trouble) {
  return dumped({{"state", state}, {"share", share}, {"trouble", trouble}, {"visit", visit_json(record)}});
}

}  // namespace mechane::gateway
