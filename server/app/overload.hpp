// OverloadWatch: finds out whether this machine is fast enough, from counters and outside the loops.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/base/clock.hpp"

namespace mechane::app {

/// Counts since the start. `longest_gap`: since the last look.
struct LoadCounts {
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;    ///< ticks that needed more than 1 ms of processor time
  std::uint64_t held_up = 0;     ///< ticks that were left out, or interrupted for so long that they took more than 1 ms
  std::uint64_t input_gaps = 0;  ///< how often a hand that was sending paused for 10 to 100 ms
  Duration longest_gap{0};
};

/// For one thread, not a loop's.
class OverloadWatch {
 public:
  static constexpr Duration kWindow = std::chrono::seconds(10);
  /// Share of the window's ticks: when more are late, visitors feel it. A machine that is fast enough has a few in an hour.
  static constexpr double kTolerated = 0.001;
  static constexpr std::uint64_t kToleratedGaps = 20;

  /// Call it several times in a window; each window is judged at its end. True when words() should be logged: when the cause has changed,
  /// and once a minute while it lasts.
  bool look(const LoadCounts& counts, TimePoint now);

  /// What the machine was too slow for in the last window, and what to do; empty: nothing.
  [[nodiscard]] const std::string& words() const { return words_; }
  /// The longest pause of a hand in the last window.
  [[nodiscard]] Duration longest_gap() const { return longest_gap_; }

 private:
  enum class Cause { none, worlds, machine, inputs };
  [[nodiscard]] Cause judge(const LoadCounts& counts);

  std::optional<LoadCounts> begin_;  // of the window
  TimePoint began_{};
  Duration gap_so_far_{0};  // the longest in this window
  Duration longest_gap_{0};
  Cause cause_ = Cause::none;
  TimePoint logged_{};
  std::string words_;
};

}  // namespace mechane::app
