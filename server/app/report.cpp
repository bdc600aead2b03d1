#include "server/app/report.hpp"

#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include "server/app/version.hpp"
#include "server/collision/kernels.hpp"

namespace mechane::app {
namespace {

double us(Duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

nlohmann::json quantiles(const realtime::LatencyHistogram& h) {
  return {{"median", us(h.quantile(0.5))},
          {"p99", us(h.quantile(0.99))},
          {"p999", us(h.quantile(0.999))},
          {"max", us(h.max())}};
}

}  // namespace

LoopSummary summarise(const std::vector<std::unique_ptr<WorldLoop>>& loops) {
  LoopSummary out;
  out.realtime = !loops.empty();
  realtime::LatencyHistogram tick;
  realtime::LatencyHistogram wake;
  for (const auto& loop : loops) {
    const realtime::PeriodicReport report = loop->thread().report();
    out.ticks += report.ticks;
    out.overruns += report.overruns;
    out.late_wakeups += report.late_wakeups;
    out.preemptions += report.preemptions;
    out.skipped += report.skipped;
    out.realtime = out.realtime && report.fifo_granted;
    tick.merge(loop->busy_time());
    wake.merge(loop->thread().wake_latency());
  }
  out.tick_us_median = us(tick.quantile(0.5));
  out.tick_us_p99 = us(tick.quantile(0.99));
  out.tick_us_p999 = us(tick.quantile(0.999));
  out.tick_us_max = us(tick.max());
  out.wake_us_median = us(wake.quantile(0.5));
  out.wake_us_p99 = us(wake.quantile(0.99));
  out.wake_us_p999 = us(wake.quantile(0.999));
  out.wake_us_max = us(wake.max());
  return out;
}

Expected<void> write_report(const std::filesystem::path& file, const std::vector<std::unique_ptr<WorldLoop>>& loops,
                            const realtime::LatencyHistogram& write_time) {
  const LoopSummary s = summarise(loops);
  nlohmann::json phases = nlohmann::json::object();
  for (std::size_t p = 0; p < world::kPhases; ++p) {
    realtime::LatencyHistogram merged;
    for (const auto& loop : loops)
      merged.merge(loop->phases()[p]);
    phases[std::string(world::kPhaseNames[p])] = quantiles(merged);
  }
  const nlohmann::json json = {
      {"version", kVersion},
      {"simd", collision::best_kernels().name},
      {"ticks", s.ticks},
      {"overruns", s.overruns},
      {"late_wakeups", s.late_wakeups},
      {"preemptions", s.preemptions},
      {"skipped", s.skipped},
      {"realtime", s.realtime},
      {"tick_us",
       {{"median", s.tick_us_median}, {"p99", s.tick_us_p99}, {"p999", s.tick_us_p999}, {"max", s.tick_us_max}}},
      {"wake_us",
       {{"median", s.wake_us_median}, {"p99", s.wake_us_p99}, {"p999", s.wake_us_p999}, {"max", s.wake_us_max}}},
      {"phase_us", std::move(phases)},
      {"dds_write_us", quantiles(write_time)}};
  std::ofstream out(file);
  out << json.dump(2) << "\n";
  out.flush();
  if (!out) return fail("the report could not be written", file.string(), "check the folder and the free space");
  return {};
}

}  // namespace mechane::app
