// What the loops have counted, for the status topic and for a report file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "server/app/world_loop.hpp"
#include "server/base/error.hpp"

namespace mechane::app {

/// Over all loops. Times in microseconds: a tick's own CPU time, and how late the loop woke.
struct LoopSummary {
  std::uint64_t ticks = 0, overruns = 0, late_wakeups = 0, preemptions = 0, skipped = 0;
  double tick_us_median = 0, tick_us_p99 = 0, tick_us_p999 = 0, tick_us_max = 0;
  double wake_us_median = 0, wake_us_p99 = 0, wake_us_p999 = 0, wake_us_max = 0;
  bool realtime = false;
};

[[nodiscard]] LoopSummary summarise(const std::vector<std::unique_ptr<WorldLoop>>& loops);

/// Writes the summary, the phases and the time of a dds_write as JSON. Errors: the file cannot be written.
[[nodiscard]] Expected<void> write_report(const std::filesystem::path& file,
                                          const std::vector<std::unique_ptr<WorldLoop>>& loops,
                                          const realtime::LatencyHistogram& write_time);

}  // namespace mechane::app
