#include "server/app/report.hpp"

#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "server/app/version.hpp"
#include "server/base/whole_file.hpp"
#include "server/collision/kernels.hpp"
#include "server/realtime/quantiles_json.hpp"

namespace mechane::app {
namespace {

/// `of` each loop, together.
template <class Of>
realtime::LatencyHistogram merged(const std::vector<std::unique_ptr<WorldLoop>>& loops, const Of& of) {
  realtime::LatencyHistogram all;
  for (const auto& loop : loops)
    all.merge(of(*loop));
  return all;
}

const realtime::LatencyHistogram& busy_of(const WorldLoop& loop) {
  return loop.busy_time();
}
const realtime::LatencyHistogram& wake_of(const WorldLoop& loop) {
  return loop.thread().wake_latency();
}

}  // namespace

transport::LoopFigures summarise(const std::vector<std::unique_ptr<WorldLoop>>& loops) {
  transport::LoopFigures out;
  out.realtime = !loops.empty();
  for (const auto& loop : loops) {
    const realtime::PeriodicReport report = loop->thread().report();
    out.ticks += report.ticks;
    out.overruns += report.overruns;
    out.late_wakeups += report.late_wakeups;
    out.preemptions += report.preemptions;
    out.skipped += report.skipped;
    out.realtime = out.realtime && report.fifo_granted;
  }
  const realtime::LatencyHistogram tick = merged(loops, busy_of);
  const realtime::LatencyHistogram wake = merged(loops, wake_of);
  out.tick_us_median = to_us(tick.quantile(0.5));
  out.tick_us_p99 = to_us(tick.quantile(0.99));
  out.tick_us_p999 = to_us(tick.quantile(0.999));
  out.tick_us_max = to_us(tick.max());
  out.wake_us_p99 = to_us(wake.quantile(0.99));
  out.wake_us_max = to_us(wake.max());
  return out;
}

Expected<void> write_report(const std::filesystem::path& file, const std::vector<std::unique_ptr<WorldLoop>>& loops,
                            const realtime::LatencyHistogram& write_time) {
  const transport::LoopFigures s = summarise(loops);
  nlohmann::json phases = nlohmann::json::object();
  for (std::size_t p = 0; p < world::kPhases; ++p) {
    phases[std::string(world::kPhaseNames[p])] =
        realtime::quantiles_json(merged(loops, [p](const WorldLoop& loop) { return loop.phases()[p]; }));
  }
  const nlohmann::json json = {{"version", kVersion},
                               {"simd", collision::best_kernels().name},
                               {"ticks", s.ticks},
                               {"overruns", s.overruns},
                               {"late_wakeups", s.late_wakeups},
                               {"preemptions", s.preemptions},
                               {"skipped", s.skipped},
                               {"realtime", s.realtime},
                               {"tick_us", realtime::quantiles_json(merged(loops, busy_of))},
                               {"wake_us", realtime::quantiles_json(merged(loops, wake_of))},
                               {"phase_us", std::move(phases)},
                               {"dds_write_us", realtime::quantiles_json(write_time)}};
  const std::string text = json.dump(2) + "\n";
  return write_whole(file, std::as_bytes(std::span(text)), WholeFile::document);
}

}  // namespace mechane::app
