// X3D's TimeSensor, and the nodes that turn yes and no into each other and into times.
#include <algorithm>
#include <cmath>

#include "server/agents/event_node.hpp"

namespace mechane::agents {
namespace {

constexpr double kSlack_s = 1e-9;  // ticks are sums of milliseconds, which doubles do not hold exactly

/// A clock that runs in cycles. As X3D has it, a start, a cycle's length and a stop before the start are not obeyed while it runs.
///
/// Times in a file are counted from the activity's beginning, and a start of 0, X3D's default, is past: without `loop` it starts nothing.
class TimeSensor final : public EventNode {
 public:
  explicit TimeSensor(const EventBuild& build)
      : cycle_(build.port("cycleInterval")),
        enabled_(build.port("enabled")),
        loop_(build.port("loop")),
        start_(build.port("startTime")),
        stop_(build.port("stopTime")),
        pause_(build.port("pauseTime")),
        resume_(build.port("resumeTime")),
        active_(build.port("isActive")),
        paused_(build.port("isPaused")),
        elapsed_(build.port("elapsedTime")),
        cycle_time_(build.port("cycleTime")),
        fraction_(build.port("fraction_changed")),
        time_(build.port("time")),
        held_s_(build.slot("held_s")),
        cycle_number_(build.slot("cycle")) {}

  void begin(Instant& i) const noexcept override {
    if (i.flag(paused_)) i.state.memory[held_s_] += i.dt_s;
    look(i);
  }

  [[nodiscard]] bool accepts(const Instant& i, Port port, const double* value) const noexcept override {
    if (!std::isfinite(*value) || (port.id == cycle_.id && *value <= 0)) return false;
    if (!i.flag(active_)) return true;
    return port.id != start_.id && port.id != cycle_.id && (port.id != stop_.id || *value > i.number(start_));
  }

  void receive(Instant& i, Port /*port*/) const noexcept override { look(i); }

 private:
  void look(Instant& i) const noexcept {
    if (!i.flag(active_)) {
      if (!i.had_event(active_) && is_due(i)) start(i);
    } else if (!i.flag(enabled_)) {
      finish(i);
    }
    if (i.flag(active_) && (stops(i) || !rests(i))) go_on(i);
  }

  [[nodiscard]] bool stops(const Instant& i) const noexcept {
    return i.number(stop_) > i.number(start_) && i.now_s + kSlack_s >= i.number(stop_);
  }

  [[nodiscard]] bool is_due(const Instant& i) const noexcept {
    const double start_s = i.number(start_), end_s = start_s + i.number(cycle_);
    return i.flag(enabled_) && i.now_s + kSlack_s >= start_s && !stops(i) &&
           (i.flag(loop_) || (start_s > 0 && i.now_s + kSlack_s < end_s));
  }

  void start(Instant& i) const noexcept {
    i.send(active_, 1.0);
    i.state.memory[held_s_] = 0;
    i.state.memory[cycle_number_] = std::floor((i.now_s - i.number(start_)) / i.number(cycle_) + kSlack_s);
    i.send(cycle_time_, i.now_s);
  }

  void finish(Instant& i) const noexcept {
    if (i.flag(paused_)) i.send(paused_, 0.0);
    i.send(active_, 0.0);
  }

  /// Whether it pauses.
  [[nodiscard]] bool rests(Instant& i) const noexcept {
    const double pause_s = i.number(pause_), resume_s = i.number(resume_);
    const bool was = i.flag(paused_);
    const bool now = was ? resume_s <= pause_s || i.now_s + kSlack_s < resume_s
                         : pause_s > resume_s && i.now_s + kSlack_s >= pause_s;
    if (now != was) i.send(paused_, now ? 1.0 : 0.0);
    return now;
  }

  void go_on(Instant& i) const noexcept {
    if (i.had_event(fraction_)) return;
    const double cycle_s = i.number(cycle_), begun_s = i.number(start_) + i.state.memory[held_s_];
    bool done = stops(i);
    double at_s = done ? i.number(stop_) : i.now_s;
    double& cycle_number = i.state.memory[cycle_number_];
    const double next = std::floor((at_s - begun_s) / cycle_s + kSlack_s);
    if (next > cycle_number && !i.flag(loop_)) {
      done = true;
      at_s = begun_s + (cycle_number + 1) * cycle_s;
    } else if (next > cycle_number) {
      cycle_number = next;
      i.send(cycle_time_, i.now_s);
    }
    const double cycles = (at_s - begun_s) / cycle_s, fraction = cycles - std::floor(cycles + kSlack_s);
    // X3D: where one cycle ends and the next begins, it is 1.
    i.send(fraction_, fraction > kSlack_s || cycles < kSlack_s ? std::max(0.0, fraction) : 1.0);
    i.send(elapsed_, at_s - begun_s);
    i.send(time_, at_s);
    if (done) finish(i);
  }

  Port cycle_, enabled_, loop_, start_, stop_, pause_, resume_, active_, paused_, elapsed_, cycle_time_, fraction_,
      time_;
  std::size_t held_s_;
  std::size_t cycle_number_;
};

class BooleanFilter final : public EventNode {
 public:
  explicit BooleanFilter(const EventBuild& build)
      : set_(build.port("set_boolean")),
        if_false_(build.port("inputFalse")),
        negated_(build.port("inputNegate")),
        if_true_(build.port("inputTrue")) {}

  void receive(Instant& i, Port /*port*/) const noexcept override {
    const bool yes = i.flag(set_);
    i.send(yes ? if_true_ : if_false_, yes ? 1.0 : 0.0);
    i.send(negated_, yes ? 0.0 : 1.0);
  }

 private:
  Port set_, if_false_, negated_, if_true_;
};

class BooleanToggle final : public EventNode {
 public:
  explicit BooleanToggle(const EventBuild& build) : set_(build.port("set_boolean")), toggle_(build.port("toggle")) {}

  void receive(Instant& i, Port port) const noexcept override {
    if (port.id == set_.id && i.flag(set_)) i.send(toggle_, i.flag(toggle_) ? 0.0 : 1.0);
  }

 private:
  Port set_, toggle_;
};

/// Sends one thing whenever anything comes: TRUE, or the time.
class Trigger final : public EventNode {
 public:
  Trigger(Port out, bool sends_time) : out_(out), sends_time_(sends_time) {}

  void receive(Instant& i, Port /*port*/) const noexcept override { i.send(out_, sends_time_ ? i.now_s : 1.0); }

 private:
  Port out_;
  bool sends_time_;
};

}  // namespace

std::unique_ptr<EventNode> make_time_sensor(const EventBuild& build) {
  return std::make_unique<TimeSensor>(build);
}
std::unique_ptr<EventNode> make_boolean_filter(const EventBuild& build) {
  return std::make_unique<BooleanFilter>(build);
}
std::unique_ptr<EventNode> make_boolean_toggle(const EventBuild& build) {
  return std::make_unique<BooleanToggle>(build);
}
std::unique_ptr<EventNode> make_boolean_trigger(const EventBuild& build) {
  return std::make_unique<Trigger>(build.port("triggerTrue"), false);
}
std::unique_ptr<EventNode> make_time_trigger(const EventBuild& build) {
  return std::make_unique<Trigger>(build.port("triggerTime"), true);
}

}  // namespace mechane::agents
