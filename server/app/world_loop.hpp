// One loop thread and the worlds that it steps.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "server/realtime/histogram.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/realtime/ring.hpp"
#include "server/record/recorder.hpp"
#include "server/transport/world_port.hpp"
#include "server/visits/visit_feed.hpp"
#include "server/world/step.hpp"

namespace mechane::app {

/// A world on a loop: what it is stepped with. Made by the main thread, then the loop's until the loop gives it back.
struct RunningWorld {
  std::unique_ptr<world::World> world;
  transport::WorldPort* port = nullptr;           ///< lives in the transport
  std::optional<record::WorldRecorder> recorder;  ///< none: nothing is kept
  visits::VisitFeed* visits = nullptr;            ///< lives with the world; null: no visitor's sheet is kept
  /// Hands the state to the recorder, which there must be. Whoever the world belongs to at the moment.
  void keep_snapshot() noexcept;

  StepId step;                     ///< where the visit was after the last tick; the loop's
  std::atomic<StepId> sends_on{};  ///< a step that opens another scenario has begun; the main thread takes it
  std::atomic<bool> leave{false};  ///< the main thread asks the loop to give the world back
  std::atomic<bool> left{false};   ///< the loop has; the main thread may take it apart
};

struct LoopConfig {
  realtime::PeriodicConfig thread;
  std::size_t max_worlds = 64;
};

/// Owns one thread, which steps its worlds one after another every millisecond. add() and the like are called by the main thread.
class WorldLoop {
 public:
  WorldLoop(const LoopConfig& config, Clock& clock);
  ~WorldLoop();

  [[nodiscard]] Expected<void> start();
  void stop() { thread_.stop(); }

  /// Hands a world to the loop; it takes it at its next tick. False when the loop is full. The world must live until `left`.
  [[nodiscard]] bool add(RunningWorld& world);
  [[nodiscard]] std::size_t size() const { return assigned_; }
  /// The main thread has seen that a world of this loop has left.
  void forget_one() { --assigned_; }

  [[nodiscard]] const realtime::PeriodicThread& thread() const { return thread_; }
  [[nodiscard]] const std::array<realtime::LatencyHistogram, world::kPhases>& phases() const { return phases_; }
  /// Own CPU time of ticks that had a world to step: those without would only flatter the median.
  [[nodiscard]] const realtime::LatencyHistogram& busy_time() const { return busy_time_; }

 private:
  void tick(const realtime::TickTiming& timing) noexcept;
  void take_new_worlds() noexcept;
  void give_back_leaving() noexcept;
  void step(RunningWorld& running, TimePoint now) noexcept;

  std::size_t assigned_ = 0;  // the main thread's count
  std::size_t max_worlds_;
  realtime::Ring<RunningWorld*> arriving_;
  std::vector<RunningWorld*> worlds_;  // the loop's; reserved, never grows in a tick
  Clock& clock_;
  world::PhaseTimer timer_;
  std::array<realtime::LatencyHistogram, world::kPhases> phases_;
  realtime::LatencyHistogram busy_time_;
  realtime::PeriodicThread thread_;  // last: its thread ends before what it uses does
};

}  // namespace mechane::app
