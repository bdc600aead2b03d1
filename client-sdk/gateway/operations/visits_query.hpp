// What a browser asks of the visits: decoders of its query and of a remark's JSON.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::gateway {

/// Which visits. An empty text fits every visit.
struct VisitsQuery {
  std::int64_t days = 7;  ///< those of the last so many days, 1 to kMostDays
  std::string exhibit{};  ///< the id of a scenario
  std::string language{};

  static constexpr std::int64_t kMostDays = 3660;
  [[nodiscard]] bool fits(const visits::VisitRecord& record) const;
};

/// Of "?days=7&exhibit=archimedes-screw&language=el". Errors: invalid_value.
[[nodiscard]] Expected<VisitsQuery> parse_visits_query(const std::map<std::string, std::string>& query);

/// Of {"text": "laughed aloud", "at": 35.5}, where `at` (seconds since the visit began) may be missing. Author and minute are the caller's.
/// Errors: invalid_value, too_large.
[[nodiscard]] Expected<visits::RecordedRemark> parse_remark(std::string_view body, const std::string& author);

}  // namespace mechane::gateway
