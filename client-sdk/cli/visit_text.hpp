// The output of `mechane visits`: records of visits and their statistics, for people, for a spreadsheet and for
// programs.
#pragma once

#include <span>
#include <string>

#include "client-sdk/cli/visit_statistics.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::cli {

/// Tables for each activity: how many were done, times step by step, errors, answers.
[[nodiscard]] std::string visits_report(std::span<const ActivitySummary> activities);
/// One line per visit, and a last line with their number.
[[nodiscard]] std::string visits_list(std::span<const visits::VisitRecord> records);
/// The whole content of one record.
[[nodiscard]] std::string visit_page(const visits::VisitRecord& record);

/// A header and one line per visit, with a column for each step and question. RFC 4180, UTF-8; a field that a
/// spreadsheet would treat as a formula gets a ' in front.
[[nodiscard]] std::string visits_csv(std::span<const visits::VisitRecord> records);

[[nodiscard]] std::string report_json(std::span<const ActivitySummary> activities);
[[nodiscard]] std::string visits_json(std::span<const visits::VisitRecord> records);

}  // namespace mechane::cli
