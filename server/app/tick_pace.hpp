// TickPace: whether a loop's worlds run a tick now, where somebody wants their time slower than ours, or standing still.
#pragma once

#include <cstdint>

#include "server/realtime/ring.hpp"
#include "server/transport/world_port.hpp"

namespace mechane::app {

inline constexpr std::uint32_t kMostSteps = 10'000;  ///< ticks of one order

/// What is asked for: a pace, or some ticks while time stands still.
struct PaceOrder {
  double pace = 1;          ///< of real time, 0 .. 1; counts where `ticks` is 0
  std::uint32_t ticks = 0;  ///< 0 .. kMostSteps
};

/// What a loop does with one period.
struct PacedTick {
  bool runs = true;  ///< false: the worlds stand still in this period
  transport::WorldPort::Passage passage;
};

/// Devices get forces at pace 1 only: in a slower world a hand would feel walls that lag behind it. Before the pace leaves 1 or comes back
/// to it, hands are taken out until the governor has ramped all forces to zero, about 100 ticks at full pace. Pausing a slower world takes
/// one tick. Between 0 and 1 hands go on working without force.
class TickPace {
 public:
  /// Main thread. False: the loop has not taken the former orders yet, and this one is lost.
  [[nodiscard]] bool order(const PaceOrder& order) noexcept { return orders_.push(order); }

  /// Loop thread, once a period; wait-free. `at_rest`: in all of its worlds hands are gone, and the last forces that were sent are zero.
  [[nodiscard]] PacedTick next(bool at_rest) noexcept;

 private:
  void take(const PaceOrder& order) noexcept;
  void begin(double pace) noexcept;

  realtime::Ring<PaceOrder> orders_{64};
  // For the loop.
  double pace_ = 1;
  double next_pace_ = 1;     ///< that follows once hands have let go
  bool letting_go_ = false;  ///< on the way to it
  bool gone_ = false;        ///< while letting go: hands were gone in a tick
  double due_ = 0;           ///< how much of the next tick is due
  std::uint64_t steps_ = 0;  ///< that are left, while paused
};

}  // namespace mechane::app
