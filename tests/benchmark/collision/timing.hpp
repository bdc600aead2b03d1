// How long a method takes, step by step, each pass kept.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "tests/benchmark/collision/method.hpp"

namespace mechane::benchmark {

inline constexpr std::size_t kWarmUpSteps = 50;  ///< before each pass, untimed

struct StepTimes {
  std::vector<std::vector<float>> rounds_us;  ///< [round][step], single passes
  /// Steps from which the system took the core: that says nothing of the method, so they were timed again, at once. Leaving them out
  /// would leave out the long ones.
  std::size_t preempted = 0;
  std::vector<float> cold_us;  ///< of some steps, all caches walked over before each

  [[nodiscard]] std::vector<float> all_passes_us() const;
};

/// Quantiles of plain numbers, for Report::distribution.
class Quantiles {
 public:
  explicit Quantiles(std::vector<float> us);
  /// The one of rank ceil(share * n); 0 when there is none.
  [[nodiscard]] double quantile_us(double share) const;
  [[nodiscard]] std::size_t size() const { return us_.size(); }

 private:
  std::vector<float> us_;
};

struct TimingConfig {
  std::size_t rounds = 5;
  std::size_t cold_steps = 100;
};

/// Pins the calling thread to the last core that it may use. False when the system refuses.
bool pin_to_one_core();

/// All methods take turns, in each round in another order, so that a slow minute of the machine falls on all of them. The hand's points
/// are made anew before each step, untimed: a tick has just moved them, too.
[[nodiscard]] std::vector<StepTimes> time_methods(const Scene& scene, const std::vector<MethodPtr>& methods,
                                                  const TimingConfig& config);

}  // namespace mechane::benchmark
