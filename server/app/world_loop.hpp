// One loop thread and the worlds that it steps.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include "server/app/tick_pace.hpp"
#include "server/haptics/shown_hands.hpp"
#include "server/realtime/histogram.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/realtime/ring.hpp"
#include "server/record/recorder.hpp"
#include "server/transport/world_port.hpp"
#include "server/visits/visit_feed.hpp"
#include "server/world/step.hpp"

namespace mechane::app {

/// A world on a loop, with all that the loop needs for it. Made by the main thread; then only the loop uses it, until it gives it back.
struct RunningWorld {
  std::unique_ptr<world::World> world;
  transport::WorldPort* port = nullptr;           ///< lives in the transport
  std::optional<record::WorldRecorder> recorder;  ///< none: nothing is recorded
  visits::VisitFeed* visits = nullptr;            ///< lives with the world; null: visits are not recorded
  /// Gives the state to the recorder, which must exist. For the thread that uses the world at the moment.
  void keep_snapshot() noexcept;

  state::TickInputs inputs;        ///< of this tick; for the loop only
  haptics::ShownHands shown;       ///< for the loop only
  StepId step;                     ///< where the visit was after the last tick; for the loop only
  std::atomic<StepId> sends_on{};  ///< a step that opens another scenario has begun; the main thread takes it
  std::atomic<bool> leave{false};  ///< the main thread asks the loop to give the world back
  std::atomic<bool> left{false};   ///< the loop has given it back; the main thread may take it apart
};

struct LoopConfig {
  realtime::PeriodicConfig thread;
  std::size_t max_worlds = 64;
};

/// Owns one thread, which steps its worlds every millisecond: first the forces of all, one world after another, then the bodies of all, so
/// that a heavy world does not delay another's hands. The other functions are for the main thread.
class WorldLoop {
 public:
  WorldLoop(const LoopConfig& config, Clock& clock);
  ~WorldLoop();

  [[nodiscard]] Expected<void> start();
  void stop() { thread_.stop(); }

  /// Gives a world to the loop, which takes it at its next tick. False when the loop is full. The world must live until `left` is set.
  [[nodiscard]] bool add(RunningWorld& world);
  /// Asks for another pace of its worlds, or for single ticks. False: too many orders at a time.
  [[nodiscard]] bool order(const PaceOrder& order) { return pace_.order(order); }
  [[nodiscard]] std::size_t size() const { return assigned_; }
  /// To be called when a world of this loop has left.
  void forget_one() { --assigned_; }

  [[nodiscard]] const realtime::PeriodicThread& thread() const { return thread_; }
  [[nodiscard]] const std::array<realtime::LatencyHistogram, world::kPhases>& phases() const { return phases_; }
  /// Own CPU time of ticks. Those without a world do not count: they would make the median look better than it is.
  [[nodiscard]] const realtime::LatencyHistogram& busy_time() const { return busy_time_; }

 private:
  void tick(const realtime::TickTiming& timing) noexcept;
  void take_new_worlds() noexcept;
  void give_back_leaving() noexcept;
  [[nodiscard]] bool hands_at_rest() const noexcept;
  void run(TimePoint now) noexcept;
  void feel(RunningWorld& running, TimePoint now) noexcept;
  void move(RunningWorld& running) noexcept;
  void record_phases(std::size_t first, std::size_t end) noexcept;

  std::size_t assigned_ = 0;  // for the main thread
  std::size_t max_worlds_;
  realtime::Ring<RunningWorld*> arriving_;
  TickPace pace_;
  std::vector<RunningWorld*> worlds_;  // for the loop; reserved, so that a tick allocates nothing
  Clock& clock_;
  world::PhaseTimer timer_;
  std::array<realtime::LatencyHistogram, world::kPhases> phases_;
  realtime::LatencyHistogram busy_time_;
  realtime::PeriodicThread thread_;  // last: its thread ends before the members that it uses
};

}  // namespace mechane::app
