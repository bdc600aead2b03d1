#include "tests/benchmark/collision/timing.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace mechane::benchmark {
namespace {

/// How often the system has taken the core from this thread. A system call: asked for between steps alone.
long preemptions() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nivcsw;
}

struct Asked {
  HandStep hand;
  Hits hits;
  long preempted = 0;  // so far
};

float time_step_once(const Scene& scene, std::size_t step, Method& method, Asked& asked) {
  scene.fill(step, asked.hand);
  asked.hits.count = 0;
  const auto began = std::chrono::steady_clock::now();
  method.step(asked.hand, asked.hits);
  const auto ended = std::chrono::steady_clock::now();
  return std::chrono::duration<float, std::micro>(ended - began).count();
}

/// The first try that was not disturbed; of kTries, the fastest.
float time_step(const Scene& scene, std::size_t step, Method& method, Asked& asked, std::size_t& preempted) {
  constexpr int kTries = 10;
  float fastest = std::numeric_limits<float>::infinity();
  for (int i = 0; i < kTries; ++i) {
    const float us = time_step_once(scene, step, method, asked);
    const long before = std::exchange(asked.preempted, preemptions());
    if (asked.preempted == before) return us;
    preempted += i == 0 ? 1 : 0;
    fastest = std::min(fastest, us);
  }
  return fastest;
}

/// Larger than every cache; walking over it leaves nothing else in them.
class CacheFlush {
 public:
  CacheFlush() : bytes_(2 * largest_cache()) {}
  void walk() {
    ++value_;
    for (std::size_t i = 0; i < bytes_.size(); i += kLine)
      bytes_[i] = value_;
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }

 private:
  static constexpr std::size_t kLine = 64;
  static std::size_t largest_cache() {
    const long size = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return std::max<std::size_t>(size > 0 ? static_cast<std::size_t>(size) : 0, std::size_t{32} << 20U);
  }
  std::vector<std::uint8_t> bytes_;
  std::uint8_t value_ = 0;
};

void time_cold(const Scene& scene, const std::vector<MethodPtr>& methods, std::size_t count, Asked& asked,
               std::vector<StepTimes>& times) {
  CacheFlush flush;
  count = std::min(count, scene.steps.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t step = (2 * i + 1) * scene.steps.size() / (2 * count);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      scene.fill(step, asked.hand);
      asked.hits.count = 0;
      flush.walk();
      const auto began = std::chrono::steady_clock::now();
      methods[m]->step(asked.hand, asked.hits);
      const auto ended = std::chrono::steady_clock::now();
      times[m].cold_us.push_back(std::chrono::duration<float, std::micro>(ended - began).count());
    }
  }
}

}  // namespace

std::vector<float> StepTimes::all_passes_us() const {
  std::vector<float> all;
  for (const auto& round : rounds_us)
    all.insert(all.end(), round.begin(), round.end());
  return all;
}

Quantiles::Quantiles(std::vector<float> us) : us_(std::move(us)) {
  std::sort(us_.begin(), us_.end());
}

double Quantiles::quantile_us(double share) const {
  if (us_.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(us_.size())));
  return static_cast<double>(us_[std::clamp<std::size_t>(rank, 1, us_.size()) - 1]);
}

bool pin_to_one_core() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return false;
  for (int cpu = CPU_SETSIZE - 1; cpu >= 0; --cpu) {
    if (!CPU_ISSET(cpu, &allowed)) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(cpu, &one);
    return sched_setaffinity(0, sizeof(one), &one) == 0;
  }
  return false;
}

std::vector<StepTimes> time_methods(const Scene& scene, const std::vector<MethodPtr>& methods,
                                    const TimingConfig& config) {
  std::vector<StepTimes> times(methods.size());
  const auto asked = std::make_unique<Asked>();
  for (std::size_t round = 0; round < config.rounds; ++round) {
    for (std::size_t turn = 0; turn < methods.size(); ++turn) {
      const std::size_t m = (turn + round) % methods.size();
      auto& us = times[m].rounds_us.emplace_back(scene.steps.size());
      for (std::size_t step = 0; step < std::min(kWarmUpSteps, scene.steps.size()); ++step)
        (void)time_step_once(scene, step, *methods[m], *asked);
      asked->preempted = preemptions();
      for (std::size_t step = 0; step < scene.steps.size(); ++step)
        us[step] = time_step(scene, step, *methods[m], *asked, times[m].preempted);
    }
  }
  time_cold(scene, methods, config.cold_steps, *asked, times);
  return times;
}

}  // namespace mechane::benchmark
