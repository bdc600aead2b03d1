// What many visits' sheets say together, activity by activity.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/visits/visit_sheet.hpp"

namespace mechane::cli {

/// Of times in seconds. Without any, both are 0.
struct TimeSpread {
  std::size_t count = 0;
  double median_s = 0;
  double p90_s = 0;  ///< nine of ten were at most this long (nearest rank)
};
[[nodiscard]] TimeSpread spread_of(std::vector<double> times_s);

struct StepSummary {
  std::string name;
  std::size_t visits = 0;              ///< that came to it
  std::array<std::size_t, 4> ended{};  ///< by StepEnding; a step gone through twice counts twice
  std::size_t hints = 0;
  TimeSpread time;  ///< of those that were done, and seen from their beginning
};

struct QuestionSummary {
  std::string name;
  visits::AnswerTime when = visits::AnswerTime::after;
  std::size_t answers = 0;
  std::vector<std::size_t> at_mark;          ///< scale: how many gave each mark, 1 first; choice: empty
  double mean = 0;                           ///< scale
  double spread = 0;                         ///< scale: standard deviation of a sample; one answer: 0
  std::size_t satisfied = 0;                 ///< scale: marks above the middle
  std::map<std::string, std::size_t> chose;  ///< choice
  std::size_t judged = 0;                    ///< choice: of questions with a right answer
  std::size_t right = 0;
};

struct ActivitySummary {
  std::string scenario;
  std::string activity;
  std::size_t visits = 0;
  std::array<std::size_t, 4> ended{};  ///< by VisitEnding
  std::size_t done_alone = 0;          ///< of the done: without hint, time-out or skipped step
  TimeSpread time;                     ///< of the done that were seen from the activity's start
  std::array<std::size_t, visits::kMistakeKinds> mistakes{};
  std::size_t hints = 0;
  std::size_t remarks = 0;
  std::size_t incomplete = 0;  ///< visits of which the server could not note all
  std::int64_t first_minute = 0;
  std::int64_t last_minute = 0;
  std::vector<StepSummary> steps;          ///< in the order in which visitors came to them
  std::vector<QuestionSummary> questions;  ///< before, then after

  /// Visits that show what a visitor could do: neither still running nor cut off by a server's stop.
  [[nodiscard]] std::size_t whole() const;
  [[nodiscard]] double mistakes_a_visit() const;
};

/// By scenario, then by activity.
[[nodiscard]] std::vector<ActivitySummary> summarise(std::span<const visits::VisitSheet> sheets);

/// Of all scale questions after visits: the published evaluation reports the share of satisfied visitors (section 6: over 95 %).
struct Satisfaction {
  std::size_t marks = 0;
  std::size_t satisfied = 0;
};
[[nodiscard]] Satisfaction satisfaction_of(std::span<const ActivitySummary> activities);

/// None of nothing.
[[nodiscard]] std::optional<double> share_of(std::size_t part, std::size_t all);

}  // namespace mechane::cli
