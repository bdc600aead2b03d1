// The output of `mechane visits`: records of visits and their statistics, for people and for programs.
#pragma once

#include <span>
#include <string>

#include "server/visits/visit_record.hpp"
#include "server/visits/visit_statistics.hpp"

namespace mechane::cli {

/// Tables for each activity: how many were done, times step by step, errors, answers.
[[nodiscard]] std::string visits_report(std::span<const visits::ActivitySummary> activities);
/// One line per visit, and a last line with their number.
[[nodiscard]] std::string visits_list(std::span<const visits::VisitRecord> records);
/// The whole content of one record.
[[nodiscard]] std::string visit_page(const visits::VisitRecord& record);

[[nodiscard]] std::string report_json(std::span<const visits::ActivitySummary> activities);
[[nodiscard]] std::string visits_json(std::span<const visits::VisitRecord> records);

}  // namespace mechane::cli
