// Statistics of the records of many visits, for each activity. `mechane visits` and the operator's console show them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/visits/visit_record.hpp"

namespace mechane::visits {

/// Median and 90th percentile of times in seconds; both 0 if there are none.
struct TimeSpread {
  std::size_t count = 0;
  double median_s = 0;
  double p90_s = 0;  ///< nine of ten were at most this long (nearest rank)
};
[[nodiscard]] TimeSpread spread_of(std::vector<double> times_s);

struct StepSummary {
  std::string name;
  std::size_t visits = 0;              ///< that reached it
  std::array<std::size_t, 4> ended{};  ///< by StepEnding; a repeated step counts twice
  std::size_t left = 0;                ///< visits that were left in it
  std::size_t hints = 0;
  TimeSpread time;  ///< of those that were done, and seen from their beginning
};

struct QuestionSummary {
  std::string name;
  AnswerTime when = AnswerTime::after;
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
  std::size_t done_alone = 0;          ///< of those done: without hint, time-out or skipped step
  TimeSpread time;                     ///< of the done that were seen from the activity's start
  std::array<std::size_t, kMistakeKinds> mistakes{};
  std::size_t hints = 0;
  std::size_t remarks = 0;
  std::size_t incomplete = 0;  ///< visits that the server could not record completely
  std::int64_t first_minute = 0;
  std::int64_t last_minute = 0;
  std::vector<StepSummary> steps;          ///< in the order in which visitors came to them
  std::vector<QuestionSummary> questions;  ///< before, then after

  /// Complete visits: neither still running nor cut off by a server's stop.
  [[nodiscard]] std::size_t whole() const;
  [[nodiscard]] double mistakes_a_visit() const;
};

/// By scenario, then by activity.
[[nodiscard]] std::vector<ActivitySummary> summarise(std::span<const VisitRecord> records);

/// Visits with the same word in one of a record's fields.
struct EndingCount {
  std::string name;
  std::size_t visits = 0;
  std::size_t done = 0;
  std::size_t done_alone = 0;
  std::size_t left = 0;
};
/// By scenario, kiosk or language: for each word that `field` has, in the order of words.
[[nodiscard]] std::vector<EndingCount> count_by(std::span<const VisitRecord> records, std::string VisitRecord::*field);

struct DayCount {
  std::string day;  ///< "2026-11-29"
  std::size_t visits = 0;
  std::size_t done = 0;
};
/// Each day of this machine's time zone from that of the first minute to that of the last one, those without a visit too. Visits outside
/// do not count.
[[nodiscard]] std::vector<DayCount> count_days(std::span<const VisitRecord> records, std::int64_t first_minute,
                                               std::int64_t last_minute);

/// Of all scale questions after visits: the published evaluation reports the share of satisfied visitors (section 6:
/// over 95 %).
struct Satisfaction {
  std::size_t marks = 0;
  std::size_t satisfied = 0;
};
[[nodiscard]] Satisfaction satisfaction_of(std::span<const ActivitySummary> activities);

/// None if `all` is 0.
[[nodiscard]] std::optional<double> share_of(std::size_t part, std::size_t all);

}  // namespace mechane::visits
