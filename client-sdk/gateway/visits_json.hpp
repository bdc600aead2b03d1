// Visits and their statistics as the operator's API tells of them: STREAM.md has the form.
#pragma once

#include <string>

#include "client-sdk/gateway/visits_desk.hpp"

namespace mechane::gateway {

/// The newest visits that are told one by one.
inline constexpr std::size_t kVisitsTold = 100;

[[nodiscard]] std::string visits_json(const VisitsFound& found);
[[nodiscard]] std::string remarks_json(const visits::VisitRecord& record);

}  // namespace mechane::gateway
