// When a museum and its kiosks are open: a week with exceptions, in the machine's time zone. Pure but for that zone: the
// same plan at the same time has the same state.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::gateway {

/// Of a day, by its clock: minutes from its beginning, 0 .. 1440; open from the first one, closed from the second one on.
struct OpenSpan {
  int from_min = 0;
  int to_min = 0;
  friend bool operator==(const OpenSpan&, const OpenSpan&) = default;
};
/// In order, without overlaps; none: closed all day.
using DayHours = std::vector<OpenSpan>;

struct HoursPlan {
  std::array<DayHours, 7> week{};                ///< from Monday on
  std::map<std::string, DayHours> exceptions{};  ///< by date, "2026-12-25": instead of the week's
  friend bool operator==(const HoursPlan&, const HoursPlan&) = default;
};

struct OpeningHours {
  static constexpr std::size_t kMostSpans = 4;         ///< of a day
  static constexpr std::size_t kMostExceptions = 400;  ///< of a plan
  static constexpr std::size_t kMostKiosks = 100;
  std::optional<HoursPlan> museum{};          ///< none: always open
  std::map<std::string, HoursPlan> kiosks{};  ///< instead of the museum's
  std::map<std::string, std::string>
      wake{};  ///< MAC addresses of kiosks that are woken at opening: "02:00:5e:10:00:01"
  friend bool operator==(const OpeningHours&, const OpeningHours&) = default;
};

/// Reads {"museum": plan or null, "kiosks": {name: plan}, "wake": {name: MAC}}, where a plan is {"week": {"monday":
/// ["10:00-18:00"]}, "exceptions": {"2026-12-25": []}}. Errors: invalid_value and too_large, with the field and a remedy.
[[nodiscard]] Expected<OpeningHours> parse_hours(std::string_view json);
/// The same text again, days in order.
[[nodiscard]] std::string hours_text(const OpeningHours& hours);

/// The plan that counts for a kiosk; null: always open.
[[nodiscard]] const HoursPlan* plan_of(const OpeningHours& hours, const std::string& kiosk);

/// `at`: seconds since 1970. By the clock on the wall: where it is set back, an hour counts twice.
[[nodiscard]] bool is_open(const HoursPlan& plan, std::int64_t at);
/// The first time after `at` at which is_open() changes; none within a year and a week.
[[nodiscard]] std::optional<std::int64_t> next_change(const HoursPlan& plan, std::int64_t at);

/// "18:30" as minutes of the day; "24:00" is its end. None: no such time.
[[nodiscard]] std::optional<int> minutes_of_day(std::string_view text);
/// The next time after `at` at which the clock on the wall shows these minutes of the day.
[[nodiscard]] std::int64_t next_at(int minutes, std::int64_t at);

}  // namespace mechane::gateway
