#include "server/app/world_loop.hpp"

#include <algorithm>
#include <bit>

#include "server/state/snapshot.hpp"

namespace mechane::app {
namespace {

constexpr std::uint64_t kSnapshotInterval = 1000;  // ticks: a killed server loses no more of a visit

/// Sends a tick's result to the network and to the journal.
class TickOutput final : public world::Publisher {
 public:
  explicit TickOutput(RunningWorld& running) : running_(running) {}

  void publish_forces(const state::WorldState& state) noexcept override { running_.port->publish_forces(state); }

  void publish(const state::WorldState& state) noexcept override {
    if (transport::WorldPort::shows(state.tick)) running_.shown.follow(*running_.world->hand, state);
    running_.port->publish(state, running_.shown.out_W());
    if (running_.visits != nullptr) running_.visits->push(running_.port->description(), state, running_.inputs);
    if (!running_.recorder) return;
    record::TickRecord record;
    record.tick = state.tick;
    record.inputs = &running_.inputs;
    record.events = state.event_span();
    if (state.tick % record::kHashInterval == 0) record.hash = state::state_hash(state);
    running_.recorder->push(record);
    if (state.tick % kSnapshotInterval != 0) return;
    running_.keep_snapshot();
  }

 private:
  RunningWorld& running_;
};

}  // namespace

void RunningWorld::keep_snapshot() noexcept {
  state::write_snapshot(world->state, recorder->snapshot_buffer());
  recorder->commit_snapshot(world->state.tick);
}

WorldLoop::WorldLoop(const LoopConfig& config, Clock& clock)
    : max_worlds_(config.max_worlds),
      arriving_(std::bit_ceil(config.max_worlds)),
      clock_(clock),
      timer_(clock),
      thread_(config.thread, clock) {
  worlds_.reserve(config.max_worlds);
}

WorldLoop::~WorldLoop() {
  stop();
}

Expected<void> WorldLoop::start() {
  return thread_.start([this](const realtime::TickTiming& timing) { tick(timing); });
}

bool WorldLoop::add(RunningWorld& world) {
  if (assigned_ >= max_worlds_ || !arriving_.push(&world)) return false;
  ++assigned_;
  return true;
}

void WorldLoop::tick(const realtime::TickTiming& timing) noexcept {
  take_new_worlds();
  const PacedTick paced = pace_.next(hands_at_rest());
  for (RunningWorld* running : worlds_)
    running->port->let_through(paced.passage);
  if (paced.runs) {
    run(timing.woke);
  } else {
    for (RunningWorld* running : worlds_)
      running->port->hold(running->world->state, timing.woke, running->shown.out_W());
  }
  give_back_leaving();
}

bool WorldLoop::hands_at_rest() const noexcept {
  return std::all_of(worlds_.begin(), worlds_.end(),
                     [](const RunningWorld* running) { return running->port->forces_are_zero(); });
}

void WorldLoop::run(TimePoint now) noexcept {
  const Duration before = clock_.thread_cpu_time();
  for (RunningWorld* running : worlds_)
    feel(*running, now);
  for (RunningWorld* running : worlds_)
    move(*running);
  if (!worlds_.empty()) busy_time_.record(clock_.thread_cpu_time() - before);
}

void WorldLoop::take_new_worlds() noexcept {
  RunningWorld* world = nullptr;
  while (worlds_.size() < max_worlds_ && arriving_.pop(world))
    worlds_.push_back(world);
}

void WorldLoop::give_back_leaving() noexcept {
  const auto end = std::remove_if(worlds_.begin(), worlds_.end(), [](RunningWorld* running) {
    if (!running->leave.load(std::memory_order_acquire)) return false;
    running->left.store(true, std::memory_order_release);
    return true;
  });
  worlds_.erase(end, worlds_.end());
}

void WorldLoop::feel(RunningWorld& running, TimePoint now) noexcept {
  running.port->gather(running.inputs, now);
  TickOutput output(running);
  world::feel(*running.world, running.inputs, output, timer_);
  record_phases(0, world::kPhasesOfFeel);
}

void WorldLoop::move(RunningWorld& running) noexcept {
  TickOutput output(running);
  world::move(*running.world, output, timer_);
  record_phases(world::kPhasesOfFeel, world::kPhases);
  const StepId step = running.world->state.progress.step;
  if (step == running.step) return;
  running.step = step;
  if (step && !running.port->description().steps[step.index()].opens.empty()) running.sends_on.store(step);
}

void WorldLoop::record_phases(std::size_t first, std::size_t end) noexcept {
  for (std::size_t i = first; i < end; ++i)
    phases_[i].record(timer_.took()[i]);
}

}  // namespace mechane::app
