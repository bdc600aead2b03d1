// The summary for programs, with the same content as the table and the page.
#pragma once

#include <string>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/summary.hpp"

namespace mechane::fit {

/// A JSON object; names carry their units, a figure that was not measured is null.
[[nodiscard]] std::string summary_json(const FittedObject& fitted, const Summary& summary);

}  // namespace mechane::fit
