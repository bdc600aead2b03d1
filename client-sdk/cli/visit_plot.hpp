// What visitors did and answered, as one picture for a wall or a report.
#pragma once

#include <span>
#include <string>

#include "server/visits/visit_statistics.hpp"

namespace mechane::cli {

/// Self-contained SVG 1.1 without scripts: for each activity how visits ended, how long each step took, the marks, and
/// the right answers before and after.
[[nodiscard]] std::string visits_svg(std::span<const visits::ActivitySummary> activities);

}  // namespace mechane::cli
