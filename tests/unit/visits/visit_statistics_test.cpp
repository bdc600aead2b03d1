#include "server/visits/visit_statistics.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <numeric>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "server/visits/visit_csv.hpp"
#include "tests/unit/visits/visit_record_samples.hpp"

namespace mechane::visits {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// Visits to few activities, with few steps, so that they meet.
std::vector<VisitRecord> any_visits() {
  const auto below = [](int n) { return *rc::gen::inRange(0, n); };
  std::vector<VisitRecord> records(static_cast<std::size_t>(below(30)));
  for (VisitRecord& record : records) {
    record = any_record();
    record.scenario = below(2) == 0 ? "screw" : "crane";
    record.activity = below(2) == 0 ? "use" : "assemble";
    record.language = below(2) == 0 ? "el" : "en";
    record.minute = 29'000'000 + below(10 * 24 * 60);
    for (RecordedStep& step : record.steps)
      step.name = std::string(1, static_cast<char>('a' + below(3)));
  }
  return records;
}

std::size_t sum_of(const auto& all, auto field) {
  return std::accumulate(all.begin(), all.end(), std::size_t{0},
                         [&](std::size_t sum, const auto& one) { return sum + std::invoke(field, one); });
}

RC_GTEST_PROP(VisitStatistics, CountEachVisitOnceWhateverTheOrder, ()) {
  const std::vector<VisitRecord> records = any_visits();
  std::vector<VisitRecord> turned(records.rbegin(), records.rend());
  const auto all = summarise(records), again = summarise(turned);
  RC_ASSERT(sum_of(all, &ActivitySummary::visits) == records.size());
  RC_ASSERT(all.size() == again.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    RC_ASSERT(all[i].ended == again[i].ended);
    RC_ASSERT(std::accumulate(all[i].ended.begin(), all[i].ended.end(), std::size_t{0}) == all[i].visits);
    RC_ASSERT(all[i].done_alone <= all[i].ended[static_cast<std::size_t>(VisitEnding::done)]);
    RC_ASSERT(all[i].time.median_s == again[i].time.median_s);
    RC_ASSERT(all[i].time.p90_s >= all[i].time.median_s);
  }
}

RC_GTEST_PROP(VisitStatistics, WhoLeftDidSoInOneStepThatWasReached, ()) {
  for (const ActivitySummary& activity : summarise(any_visits())) {
    std::size_t left = 0;
    for (const StepSummary& step : activity.steps) {
      RC_ASSERT(step.left <= step.visits);
      left += step.left;
    }
    RC_ASSERT(left <= activity.ended[static_cast<std::size_t>(VisitEnding::left)]);
  }
}

RC_GTEST_PROP(VisitStatistics, DaysAndWordsPartTheVisits, ()) {
  const std::vector<VisitRecord> records = any_visits();
  const auto days = count_days(records, 29'000'000, 29'000'000 + 10 * 24 * 60);
  RC_ASSERT(sum_of(days, &DayCount::visits) == records.size());
  for (std::size_t i = 1; i < days.size(); ++i)
    RC_ASSERT(*minute_of_text(days[i].day) - *minute_of_text(days[i - 1].day) == 24 * 60);
  for (const auto field : {&VisitRecord::scenario, &VisitRecord::language}) {
    const auto counts = count_by(records, field);
    RC_ASSERT(sum_of(counts, &EndingCount::visits) == records.size());
    for (const EndingCount& count : counts)
      RC_ASSERT(count.done + count.left <= count.visits && count.done_alone <= count.done);
  }
}

TEST(VisitStatistics, ADayIsOneOfTheMuseumsClock) {
  ::setenv("TZ", "Europe/Athens", 1);
  ::tzset();
  std::vector<VisitRecord> records(2);
  records[0].minute = *minute_of_text("2026-07-01 20:59");
  records[1].minute = *minute_of_text("2026-07-01 21:00");  // midnight in Athens
  const auto days = count_days(records, records[0].minute, records[1].minute);
  ::unsetenv("TZ");
  ::tzset();
  ASSERT_THAT(days, SizeIs(2));
  EXPECT_EQ(days[0].day, "2026-07-01");
  EXPECT_EQ(days[1].day, "2026-07-02");
  EXPECT_EQ(days[1].visits, 1);
}

/// Reads a line of RFC 4180; `at` is behind it then.
std::vector<std::string> fields_at(const std::string& csv, std::size_t& at) {
  std::vector<std::string> fields(1);
  for (bool quoted = false; at < csv.size(); ++at) {
    if (csv[at] == '"') {
      const bool twice = quoted && at + 1 < csv.size() && csv[at + 1] == '"';
      if (twice) fields.back() += csv[at++];
      if (!twice) quoted = !quoted;
    } else if (!quoted && csv[at] == ',') {
      fields.emplace_back();
    } else if (!quoted && csv.compare(at, 2, "\r\n") == 0) {
      at += 2;
      break;
    } else {
      fields.back() += csv[at];
    }
  }
  return fields;
}

RC_GTEST_PROP(VisitsCsv, IsReadBackLineByLineAndHasNoFormula, ()) {
  std::vector<VisitRecord> records = any_visits();
  for (VisitRecord& record : records)
    record.remarks = {{1, "=1+1", "eleni", {}}, {2, "\"quoted\", twice\r\n", "", {}}};
  const std::string csv = visits_csv(records);
  std::size_t at = 0, lines = 0;
  const std::size_t columns = fields_at(csv, at).size();
  while (at < csv.size()) {
    const std::vector<std::string> fields = fields_at(csv, at);
    RC_ASSERT(fields.size() == columns);
    for (const std::string& field : fields)
      RC_ASSERT(field.empty() || std::string("=+-@\t\r\n").find(field.front()) == std::string::npos);
    RC_ASSERT(fields[0] == records[lines++].number);
  }
  RC_ASSERT(lines == records.size());
}

VisitRecord a_visit() {
  VisitRecord record = plain_record();
  record.answers.clear();
  return record;
}

TEST(VisitStatistics, MedianAndNinetiethOfFewAndMany) {
  EXPECT_EQ(spread_of({}).count, 0U);
  EXPECT_DOUBLE_EQ(spread_of({7}).median_s, 7);
  EXPECT_DOUBLE_EQ(spread_of({7}).p90_s, 7);
  EXPECT_DOUBLE_EQ(spread_of({3, 1}).median_s, 2);
  EXPECT_DOUBLE_EQ(spread_of({3, 1}).p90_s, 3);
  std::vector<double> times(100);
  for (std::size_t i = 0; i < times.size(); ++i)
    times[i] = static_cast<double>(100 - i);
  EXPECT_DOUBLE_EQ(spread_of(times).median_s, 50.5);
  EXPECT_DOUBLE_EQ(spread_of(times).p90_s, 90);
}

TEST(VisitStatistics, SatisfiedIsAboveTheMiddleOfItsScale) {
  VisitRecord record = a_visit();
  for (const auto& [mark, marks] :
       {std::pair(3, 5), std::pair(4, 5), std::pair(2, 4), std::pair(3, 4), std::pair(1, 1)})
    record.answers.push_back(
        {std::to_string(mark) + " of " + std::to_string(marks), AnswerTime::after, "", mark, marks, {}});
  record.answers.push_back({"before", AnswerTime::before, "", 5, 5, {}});
  const std::vector<ActivitySummary> all = summarise(std::vector{record});
  EXPECT_EQ(satisfaction_of(all).marks, 5U);
  EXPECT_EQ(satisfaction_of(all).satisfied, 2U);
}

TEST(VisitStatistics, StepsStandInTheOrderInWhichVisitorsCameToThem) {
  VisitRecord record = a_visit();
  record.steps = {{"zeta", 1, StepEnding::done, false, true},
                  {"alpha", 1, StepEnding::unfinished, false, true},
                  {"zeta", 2, StepEnding::done, false, true},
                  {"alpha", 1, StepEnding::timed_out, true, true}};
  const auto all = summarise(std::vector{record});
  ASSERT_THAT(all[0].steps, SizeIs(2));
  EXPECT_EQ(all[0].steps[0].name, "zeta");
  EXPECT_EQ(all[0].steps[0].visits, 1U);
  EXPECT_EQ(all[0].steps[0].time.count, 2U);
  EXPECT_THAT(all[0].steps[1].ended, ElementsAre(1, 0, 1, 0));
}

TEST(VisitStatistics, AStepTellsHowManyLeftInIt) {
  VisitRecord done = a_visit(), left = a_visit(), running = a_visit();
  left.ending = VisitEnding::left;
  left.steps.back().ending = StepEnding::unfinished;
  running.ending = VisitEnding::running;
  const auto all = summarise(std::vector{done, left, running});
  ASSERT_THAT(all[0].steps, SizeIs(2));
  EXPECT_EQ(all[0].steps[0].left, 0U);
  EXPECT_EQ(all[0].steps[1].left, 1U);
}

TEST(VisitsCsv, AFieldIsNeverAFormula) {
  VisitRecord record = a_visit();
  record.kiosk = "=HYPERLINK(\"x\")";
  record.remarks = {{1, "one", "eleni", 35.2}, {2, "two", "", {}}};
  EXPECT_THAT(visits_csv(std::vector{record}),
              testing::AllOf(HasSubstr("\"'=HYPERLINK(\"\"x\"\")\""), HasSubstr("\"eleni, at 35 s: one\ntwo\"")));
}

}  // namespace
}  // namespace mechane::visits
