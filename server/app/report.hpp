// The loops' counters, for the server's status and for a report file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "server/app/world_loop.hpp"
#include "server/base/error.hpp"
#include "server/transport/server_transport.hpp"

namespace mechane::app {

[[nodiscard]] transport::LoopFigures summarise(const std::vector<std::unique_ptr<WorldLoop>>& loops);

/// Writes the summary, the phases and the time of a dds_write as JSON; of a time that was not measured, no quantiles.
/// Errors: io_failure.
[[nodiscard]] Expected<void> write_report(const std::filesystem::path& file,
                                          const std::vector<std::unique_ptr<WorldLoop>>& loops,
                                          const realtime::LatencyHistogram& write_time);

}  // namespace mechane::app
