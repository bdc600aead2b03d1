// How `mechane visits` writes sheets and what they say together, for people, for a spreadsheet and for programs.
#pragma once

#include <span>
#include <string>

#include "client-sdk/cli/visit_statistics.hpp"
#include "server/visits/visit_sheet.hpp"

namespace mechane::cli {

/// Tables: of each activity how many were done, times step by step, errors, answers.
[[nodiscard]] std::string visits_report(std::span<const ActivitySummary> activities);
/// A line a visit, and a last line that counts.
[[nodiscard]] std::string visits_list(std::span<const visits::VisitSheet> sheets);
/// All that one sheet says.
[[nodiscard]] std::string visit_page(const visits::VisitSheet& sheet);

/// A line a visit, under a head; a column a step and a question. RFC 4180, UTF-8; what a spreadsheet would take for a formula has a '
/// in front.
[[nodiscard]] std::string visits_csv(std::span<const visits::VisitSheet> sheets);

[[nodiscard]] std::string report_json(std::span<const ActivitySummary> activities);
[[nodiscard]] std::string sheets_json(std::span<const visits::VisitSheet> sheets);

}  // namespace mechane::cli
