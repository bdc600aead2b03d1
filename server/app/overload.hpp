// OverloadWatch: does this machine do what is asked of it? Judged from what is counted anyway, outside the loops.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/base/clock.hpp"

namespace mechane::app {

/// Counts since the start; `longest_gap` since the last look.
struct LoadCounts {
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;    ///< ticks that needed over 1 ms of a processor themselves
  std::uint64_t held_up = 0;     ///< ticks left out, or interrupted for so long that they took over 1 ms
  std::uint64_t input_gaps = 0;  ///< times that a hand which was sending paused for 10 to 500 ms
  Duration longest_gap{0};
};

/// One thread.
class OverloadWatch {
 public:
  static constexpr Duration kWindow = std::chrono::seconds(10);
  /// Of the window's ticks: more are felt. A machine that keeps up has a few in an hour.
  static constexpr double kTolerated = 0.001;
  static constexpr std::uint64_t kToleratedGaps = 20;

  /// Judges the last window when it is over; call it more often. True when what words() says has changed, or is to be said again: once a
  /// minute while it lasts.
  bool look(const LoadCounts& counts, TimePoint now);

  /// What is too much, and what to do; empty: nothing.
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  enum class Cause { none, worlds, machine, inputs };
  [[nodiscard]] Cause judge(const LoadCounts& counts, Duration longest_gap);

  std::optional<LoadCounts> begin_;  // of the window
  TimePoint began_{};
  Duration longest_gap_{0};
  Cause cause_ = Cause::none;
  TimePoint told_{};
  std::string words_;
};

}  // namespace mechane::app
