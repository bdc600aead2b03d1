// What visitors did and said, as one picture for a wall or a report.
#pragma once

#include <span>
#include <string>

#include "client-sdk/cli/visit_statistics.hpp"

namespace mechane::cli {

/// SVG 1.1, no script, no file but itself: of each activity how visits ended, how long each step took, what the marks were, and right
/// answers before and after.
[[nodiscard]] std::string visits_svg(std::span<const ActivitySummary> activities);

}  // namespace mechane::cli
