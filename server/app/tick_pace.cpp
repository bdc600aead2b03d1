#include "server/app/tick_pace.hpp"

namespace mechane::app {

PacedTick TickPace::next(bool at_rest) noexcept {
  const bool felt = pace_ == 1 || next_pace_ == 1;
  if (letting_go_ && gone_ && (at_rest || !felt)) {
    letting_go_ = false;
    begin(next_pace_);
  }
  PaceOrder order;
  while (!letting_go_ && orders_.pop(order))
    take(order);
  if (letting_go_) {
    gone_ = true;
    return {true, {.hands = false, .forces = pace_ == 1}};
  }
  if (pace_ == 1) return {};
  if (pace_ == 0) {
    const bool runs = steps_ > 0;
    steps_ -= runs ? 1 : 0;
    return {runs, {.hands = false, .forces = false}};
  }
  due_ += pace_;
  const bool runs = due_ >= 1;
  due_ -= runs ? 1 : 0;
  return {runs, {.hands = true, .forces = false}};
}

void TickPace::take(const PaceOrder& order) noexcept {
  if (order.ticks > 0) {
    steps_ += pace_ == 0 ? order.ticks : 0;
    return;
  }
  if (order.pace == pace_) return;
  if (order.pace != 0 && order.pace != 1 && pace_ != 1) return begin(order.pace);
  letting_go_ = true;
  gone_ = false;
  next_pace_ = order.pace;
}

void TickPace::begin(double pace) noexcept {
  pace_ = pace;
  due_ = 0;
  steps_ = 0;
}

}  // namespace mechane::app
