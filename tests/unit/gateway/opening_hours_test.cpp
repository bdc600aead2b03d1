// Opening hours: read from JSON, and the state at a time. Times are of Athens, whose clock is set on the last Sundays of March
// and October.
#include "client-sdk/gateway/operations/opening_hours.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::gateway {
namespace {

using test::is_error;

class OpeningHoursTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ::setenv("TZ", "Europe/Athens", 1);
    ::tzset();
  }
};

std::int64_t athens(int year, int month, int day, int hour, int minute = 0) {
  std::tm wanted{};
  wanted.tm_year = year - 1900;
  wanted.tm_mon = month - 1;
  wanted.tm_mday = day;
  wanted.tm_hour = hour;
  wanted.tm_min = minute;
  wanted.tm_isdst = -1;
  return std::mktime(&wanted);
}

HoursPlan plan_from(const std::string& plan) {
  const auto hours = parse_hours(R"({"museum":)" + plan + "}");
  EXPECT_TRUE(hours) << hours.error().to_string();
  return hours && hours->museum ? *hours->museum : HoursPlan{};
}

const char* const kPlan =
    R"({"week":{"wednesday":["09:00-13:00","17:00-24:00"],"thursday":["00:00-02:00","10:00-18:00"]},
        "exceptions":{"2026-12-24":[],"2026-12-26":["11:00-12:30"]}})";

TEST_F(OpeningHoursTest, FollowTheWeekAndItsExceptions) {
  const HoursPlan plan = plan_from(kPlan);
  EXPECT_FALSE(is_open(plan, athens(2026, 12, 2, 8, 59)));
  EXPECT_TRUE(is_open(plan, athens(2026, 12, 2, 9)));
  EXPECT_FALSE(is_open(plan, athens(2026, 12, 2, 13)));
  EXPECT_TRUE(is_open(plan, athens(2026, 12, 2, 23, 59)));
  EXPECT_TRUE(is_open(plan, athens(2026, 12, 3, 1, 59))) << "past midnight";
  EXPECT_FALSE(is_open(plan, athens(2026, 12, 24, 10))) << "a closed Thursday";
  EXPECT_TRUE(is_open(plan, athens(2026, 12, 26, 11))) << "an open Saturday";
  EXPECT_EQ(next_change(plan, athens(2026, 12, 2, 18)), athens(2026, 12, 3, 2)) << "midnight changes nothing";
  EXPECT_EQ(next_change(plan, athens(2026, 12, 23, 18)), athens(2026, 12, 24, 0));
  EXPECT_EQ(next_change(HoursPlan{}, athens(2026, 12, 2, 18)), std::nullopt) << "always closed";
}

TEST_F(OpeningHoursTest, AreOfTheClockOnTheWallWhenItIsSet) {
  const HoursPlan plan = plan_from(R"({"week":{"sunday":["03:30-05:00"]}})");
  // 2026-03-29: 3:00 becomes 4:00. 2026-10-25: 4:00 becomes 3:00.
  EXPECT_EQ(*next_change(plan, athens(2026, 3, 28, 12)), athens(2026, 3, 29, 4)) << "there is no half past three";
  EXPECT_EQ(athens(2026, 3, 29, 5) - athens(2026, 3, 29, 4), 3600);
  const std::int64_t begins = *next_change(plan, athens(2026, 10, 24, 12));
  EXPECT_TRUE(is_open(plan, begins));
  EXPECT_FALSE(is_open(plan, begins + 1800)) << "three o'clock once more";
  EXPECT_EQ(next_change(plan, begins), begins + 1800);
  EXPECT_TRUE(is_open(plan, begins + 3600));
}

TEST_F(OpeningHoursTest, SayWhatIsWrongAndWhere) {
  const auto wrong = [](const std::string& json) {
    const auto hours = parse_hours(json);
    return hours ? Error{} : hours.error();
  };
  EXPECT_THAT(wrong("[]"), is_error(ErrorCode::invalid_value, 0, {}));
  EXPECT_THAT(wrong(R"({"museum":{}})"), is_error(ErrorCode::invalid_value, 0, {"museum", "week"}));
  EXPECT_THAT(wrong(R"({"museum":{"week":{"funday":[]}}})"),
              is_error(ErrorCode::invalid_value, 0, {"monday to sunday"}));
  for (const char* span : {"18:00-10:00", "10:00-24:01", "10-12", "10:00-10:00", "aa:00-12:00"})
    EXPECT_THAT(wrong(std::string(R"({"museum":{"week":{"monday":[")") + span + "\"]}}}"),
                is_error(ErrorCode::invalid_value, 0, {"museum.week.monday"}))
        << span;
  EXPECT_THAT(wrong(R"({"museum":{"week":{"monday":["10:00-12:00","11:00-13:00"]}}})"),
              is_error(ErrorCode::invalid_value, 0, {"overlap"}));
  EXPECT_THAT(wrong(R"({"museum":{"week":{},"exceptions":{"2026-02-29":[]}}})"),
              is_error(ErrorCode::invalid_value, 0, {"date"}));
  EXPECT_THAT(wrong(R"({"wake":{"kiosk-1":"02:00:5e:10:00"}})"), is_error(ErrorCode::invalid_value, 0, {"MAC"}));
  EXPECT_THAT(wrong(R"({"kiosks":{"../x":{"week":{}}}})"), is_error(ErrorCode::invalid_value, 0, {}));
}

TEST_F(OpeningHoursTest, OfAKioskStandInsteadOfTheMuseums) {
  const auto hours = parse_hours(R"({"museum":{"week":{}},"kiosks":{"kiosk-2":{"week":{"monday":["00:00-24:00"]}}}})");
  ASSERT_TRUE(hours) << hours.error().to_string();
  EXPECT_TRUE(plan_of(*hours, "kiosk-2")->week[0].size() == 1);
  EXPECT_TRUE(plan_of(*hours, "kiosk-1")->week[0].empty());
  EXPECT_EQ(plan_of(OpeningHours{}, "kiosk-1"), nullptr) << "always open";
}

/// Any plan that can be written.
HoursPlan any_plan() {
  const auto any_day = [] {
    auto marks = *rc::gen::unique<std::vector<int>>(*rc::gen::inRange(0, 4) * 2, rc::gen::inRange(0, 1441));
    std::sort(marks.begin(), marks.end());
    DayHours day;
    for (std::size_t i = 0; i + 1 < marks.size(); i += 2)
      day.push_back({marks[i], marks[i + 1]});
    return day;
  };
  HoursPlan plan;
  for (DayHours& day : plan.week)
    day = any_day();
  for (const char* date : {"2026-03-29", "2026-10-25", "2026-12-25"})
    if (*rc::gen::arbitrary<bool>()) plan.exceptions[date] = any_day();
  return plan;
}

RC_GTEST_FIXTURE_PROP(OpeningHoursTest, StayAsTheyAreUntilTheNextChange, ()) {
  const HoursPlan plan = any_plan();
  const std::int64_t at = athens(2026, 1, 1, 0) + *rc::gen::inRange<std::int64_t>(0, 365LL * 86400);
  const auto change = next_change(plan, at);
  const std::int64_t end = change ? *change : at + 8LL * 86400;
  RC_ASSERT(end > at);
  const std::int64_t between = at + *rc::gen::inRange<std::int64_t>(0, end - at);
  RC_ASSERT(is_open(plan, between) == is_open(plan, at));
  if (change) RC_ASSERT(is_open(plan, *change) != is_open(plan, at));
}

RC_GTEST_FIXTURE_PROP(OpeningHoursTest, AreReadAsTheyWereWritten, ()) {
  OpeningHours hours;
  if (*rc::gen::arbitrary<bool>()) hours.museum = any_plan();
  hours.kiosks["kiosk-2"] = any_plan();
  hours.wake["kiosk-1"] = "02:00:5e:10:00:01";
  const auto again = parse_hours(hours_text(hours));
  RC_ASSERT(again.has_value());
  RC_ASSERT(*again == hours);
}

RC_GTEST_FIXTURE_PROP(OpeningHoursTest, TheNextTimeIsWithinADayAndShownByTheClock, ()) {
  const std::int64_t at = athens(2026, 1, 1, 0) + *rc::gen::inRange<std::int64_t>(0, 365LL * 86400);
  const int minutes = *rc::gen::inRange(4 * 60, 1440);  // no clock is set then
  const std::time_t next = next_at(minutes, at);
  std::tm local{};
  ::localtime_r(&next, &local);
  RC_ASSERT(next > at && next <= at + 25 * 3600);
  RC_ASSERT(60 * local.tm_hour + local.tm_min == minutes);
}

}  // namespace
}  // namespace mechane::gateway
