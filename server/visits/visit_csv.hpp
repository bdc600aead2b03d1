// Single visits for a spreadsheet.
#pragma once

#include <span>
#include <string>

#include "server/visits/visit_record.hpp"

namespace mechane::visits {

/// A header and one line per visit, with a column for each step and question. RFC 4180, UTF-8; a field that a spreadsheet would treat as a
/// formula gets a ' in front.
[[nodiscard]] std::string visits_csv(std::span<const VisitRecord> records);

}  // namespace mechane::visits
