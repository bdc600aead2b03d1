// The phases of a tick by name, and a clock that times them.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "server/base/clock.hpp"

namespace mechane::world {

enum class Phase {
  take_inputs,
  move_hands,
  find_contacts,
  run_agents,
  render_forces,
  run_machines,
  step_dynamics,
  publish
};

inline constexpr std::size_t kPhases = 8;
inline constexpr std::size_t kPhasesOfFeel = 5;  ///< the first half of a tick; see step.hpp
inline constexpr std::array<std::string_view, kPhases> kPhaseNames{"take_inputs",   "move_hands",    "find_contacts",
                                                                   "run_agents",    "render_forces", "run_machines",
                                                                   "step_dynamics", "publish"};

/// Notes how long each phase of a tick took; each half starts it anew. Called by the tick; reads a clock, nothing else.
class PhaseTimer {
 public:
  explicit PhaseTimer(Clock& clock) : clock_(clock) {}
  void start() noexcept { last_ = clock_.now(); }
  void ended(Phase phase) noexcept {
    const TimePoint now = clock_.now();
    took_[static_cast<std::size_t>(phase)] = now - last_;
    last_ = now;
  }
  /// By Phase, of the last tick.
  [[nodiscard]] const std::array<Duration, kPhases>& took() const noexcept { return took_; }

 private:
  Clock& clock_;
  TimePoint last_{};
  std::array<Duration, kPhases> took_{};
};

}  // namespace mechane::world
