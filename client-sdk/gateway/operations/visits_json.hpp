// Visits and their statistics as the operator's API tells of them: STREAM.md has the form.
#pragma once

#include <string>
#include <string_view>

#include "client-sdk/gateway/operations/visits_desk.hpp"

namespace mechane::gateway {

/// The newest visits that are told one by one.
inline constexpr std::size_t kVisitsTold = 100;

[[nodiscard]] std::string visits_json(const VisitsFound& found);
[[nodiscard]] std::string remarks_json(const visits::VisitRecord& record);
/// How far a visit's playback is. `state`: "preparing", "ready" or "failed".
[[nodiscard]] std::string playback_json(const visits::VisitRecord& record, std::string_view state, double share,
                                        const std::string& trouble);

}  // namespace mechane::gateway
