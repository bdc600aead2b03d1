#include "server/visits/visit_statistics.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numeric>
#include <tuple>

namespace mechane::visits {
namespace {

/// A summary under construction.
class ActivityCount {
 public:
  void add(const VisitRecord& record) {
    if (out_.visits == 0 || record.minute < out_.first_minute) out_.first_minute = record.minute;
    out_.last_minute = std::max(out_.last_minute, record.minute);
    ++out_.visits;
    ++out_.ended[static_cast<std::size_t>(record.ending)];
    out_.remarks += record.remarks.size();
    out_.incomplete += record.notes_lost > 0 ? 1 : 0;
    add_steps(record);
    if (record.ending == VisitEnding::left && !record.steps.empty()) ++steps_[record.steps.back().name].out.left;
    for (const RecordedAnswer& answer : record.answers)
      add_answer(answer);
    if (record.ending != VisitEnding::done && record.ending != VisitEnding::left) return;
    out_.done_alone += record.done_alone() ? 1 : 0;
    if (record.ending == VisitEnding::done && record.from_start) times_.push_back(record.duration_s);
    for (const RecordedMistake& mistake : record.mistakes)
      out_.mistakes[static_cast<std::size_t>(mistake.kind)] += mistake.count;
  }

  ActivitySummary finish() {
    out_.time = spread_of(std::move(times_));
    std::vector<std::pair<double, StepSummary>> in_order;
    for (auto& [name, step] : steps_) {
      step.out.time = spread_of(std::move(step.times));
      in_order.emplace_back(step.places / static_cast<double>(step.out.visits), std::move(step.out));
    }
    std::ranges::stable_sort(in_order, {}, [](const auto& step) { return step.first; });
    for (auto& [place, step] : in_order)
      out_.steps.push_back(std::move(step));
    for (auto& [key, question] : questions_)
      out_.questions.push_back(finished(std::move(question)));
    return std::move(out_);
  }

 private:
  struct StepCount {
    StepSummary out;
    std::vector<double> times;
    double places = 0;  // sum over visits of the step's place in the order
  };

  void add_steps(const VisitRecord& record) {
    for (std::size_t i = 0; i < record.steps.size(); ++i) {
      const RecordedStep& step = record.steps[i];
      StepCount& count = steps_[step.name];
      count.out.name = step.name;
      const bool first = std::none_of(record.steps.begin(), record.steps.begin() + static_cast<std::ptrdiff_t>(i),
                                      [&](const RecordedStep& earlier) { return earlier.name == step.name; });
      count.out.visits += first ? 1 : 0;
      count.places += first ? static_cast<double>(i) : 0;
      ++count.out.ended[static_cast<std::size_t>(step.ending)];
      count.out.hints += step.hint_shown ? 1 : 0;
      out_.hints += step.hint_shown ? 1 : 0;
      if (step.ending == StepEnding::done && step.whole) count.times.push_back(step.duration_s);
    }
  }

  void add_answer(const RecordedAnswer& answer) {
    QuestionSummary& question = questions_[{answer.when, answer.question}];
    question.name = answer.question;
    question.when = answer.when;
    ++question.answers;
    if (answer.marks > 0) {
      // An older version of the scenario may have used another scale for the same question.
      question.at_mark.resize(std::max(question.at_mark.size(), static_cast<std::size_t>(answer.marks)));
      ++question.at_mark[static_cast<std::size_t>(answer.mark - 1)];
      question.satisfied += 2 * answer.mark > answer.marks + 1 ? 1 : 0;
    } else {
      ++question.chose[answer.value];
    }
    question.judged += answer.right ? 1 : 0;
    question.right += answer.right.value_or(false) ? 1 : 0;
  }

  static QuestionSummary finished(QuestionSummary question) {
    double sum = 0;
    double squares = 0;
    double count = 0;
    for (std::size_t i = 0; i < question.at_mark.size(); ++i) {
      const auto n = static_cast<double>(question.at_mark[i]);
      const auto mark = static_cast<double>(i + 1);
      count += n;
      sum += n * mark;
      squares += n * mark * mark;
    }
    if (count > 0) question.mean = sum / count;
    if (count > 1) question.spread = std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)));
    return question;
  }

  ActivitySummary out_;
  std::vector<double> times_;
  std::map<std::string, StepCount> steps_;
  std::map<std::pair<AnswerTime, std::string>, QuestionSummary> questions_;
};

}  // namespace

TimeSpread spread_of(std::vector<double> times_s) {
  if (times_s.empty()) return {};
  std::ranges::sort(times_s);
  const std::size_t n = times_s.size();
  const double median = n % 2 == 1 ? times_s[n / 2] : (times_s[n / 2 - 1] + times_s[n / 2]) / 2;
  return {n, median, times_s[(9 * n + 9) / 10 - 1]};
}

std::size_t ActivitySummary::whole() const {
  return ended[static_cast<std::size_t>(VisitEnding::done)] + ended[static_cast<std::size_t>(VisitEnding::left)];
}

double ActivitySummary::mistakes_a_visit() const {
  const auto sum = std::accumulate(mistakes.begin(), mistakes.end(), std::size_t{0});
  return whole() == 0 ? 0 : static_cast<double>(sum) / static_cast<double>(whole());
}

std::vector<ActivitySummary> summarise(std::span<const VisitRecord> records) {
  std::map<std::pair<std::string, std::string>, ActivityCount> counts;
  for (const VisitRecord& record : records)
    counts[{record.scenario, record.activity}].add(record);
  std::vector<ActivitySummary> activities;
  for (auto& [key, count] : counts) {
    activities.push_back(count.finish());
    std::tie(activities.back().scenario, activities.back().activity) = key;
  }
  return activities;
}

std::vector<EndingCount> count_by(std::span<const VisitRecord> records, std::string VisitRecord::*field) {
  std::map<std::string, EndingCount> counts;
  for (const VisitRecord& record : records) {
    EndingCount& count = counts[record.*field];
    count.name = record.*field;
    ++count.visits;
    count.done += record.ending == VisitEnding::done ? 1 : 0;
    count.done_alone += record.done_alone() ? 1 : 0;
    count.left += record.ending == VisitEnding::left ? 1 : 0;
  }
  std::vector<EndingCount> sorted;
  sorted.reserve(counts.size());
  for (auto& [name, count] : counts)
    sorted.push_back(std::move(count));
  return sorted;
}

namespace {

std::chrono::sys_days local_day(std::int64_t minute) {
  const std::time_t seconds = minute * 60;
  std::tm local{};
  ::localtime_r(&seconds, &local);
  return std::chrono::year(local.tm_year + 1900) / (local.tm_mon + 1) / local.tm_mday;
}

}  // namespace

std::vector<DayCount> count_days(std::span<const VisitRecord> records, std::int64_t first_minute,
                                 std::int64_t last_minute) {
  const std::chrono::sys_days first = local_day(first_minute), last = local_day(last_minute);
  std::vector<DayCount> days;
  for (auto day = first; day <= last; day += std::chrono::days(1))
    days.push_back({.day = minute_text(std::chrono::minutes(day.time_since_epoch()).count()).substr(0, 10)});
  for (const VisitRecord& record : records) {
    const std::int64_t place = (local_day(record.minute) - first).count();
    if (place < 0 || place >= static_cast<std::int64_t>(days.size())) continue;
    DayCount& day = days[static_cast<std::size_t>(place)];
    ++day.visits;
    day.done += record.ending == VisitEnding::done ? 1 : 0;
  }
  return days;
}

Satisfaction satisfaction_of(std::span<const ActivitySummary> activities) {
  Satisfaction sum;
  for (const ActivitySummary& activity : activities) {
    for (const QuestionSummary& question : activity.questions) {
      if (question.at_mark.empty() || question.when != AnswerTime::after) continue;
      sum.marks += std::accumulate(question.at_mark.begin(), question.at_mark.end(), std::size_t{0});
      sum.satisfied += question.satisfied;
    }
  }
  return sum;
}

std::optional<double> share_of(std::size_t part, std::size_t all) {
  if (all == 0) return {};
  return static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace mechane::visits
