#include "server/world/inputs.hpp"

#include <algorithm>

#include "server/hand/freshness.hpp"
#include "server/hand/friction_spring.hpp"

namespace mechane::world {
namespace {

using state::EventKind;
using state::UserInput;
using state::UserState;

// Faster than any hand: a fist in a boxing match reaches some 9 m/s.
constexpr double kHandSpeedLimit = 10.0;
constexpr double kHandTurnLimit = 50.0;
// Quantisation and jitter of samples that arrive in bursts.
constexpr double kJumpSlackM = 0.02;

void let_go(state::WorldState& state, UserState& user, std::uint32_t index) {
  if (!user.grasp.active) return;
  state.emit(EventKind::released, index, static_cast<std::uint32_t>(user.grasp.body.index()));
  user.grasp = state::Grasp{};
}

void leave(state::WorldState& state, UserState& user, std::uint32_t index) {
  if (!user.present) return;
  let_go(state, user, index);
  user = UserState{};
  state.emit(EventKind::user_left, index);
}

void take_sample(state::WorldState& state, UserState& user, const UserInput& input, std::uint32_t index) {
  // How far the hand can have moved since the last new sample, which is one tick older than `age` was in the last tick.
  const double elapsed_s = to_seconds(user.age + kTickPeriod);
  const double moved_m = (input.sample.X_WH.p - user.X_WH.p).norm();
  user.jumped = moved_m > kHandSpeedLimit * elapsed_s + kJumpSlackM;
  if (user.jumped) let_go(state, user, index);
  user.sample = input.sample;
  user.X_WH = input.sample.X_WH;
  user.V_WH.v = hand::at_most(input.sample.V_WH.v, kHandSpeedLimit);
  user.V_WH.w = hand::at_most(input.sample.V_WH.w, kHandTurnLimit);
}

void take_user(state::WorldState& state, UserState& user, const UserInput& input, std::uint32_t index) {
  if (!input.present) return leave(state, user, index);
  const bool same_session = user.present && (!input.fresh || user.sample.session == input.sample.session);
  if (!same_session) {
    leave(state, user, index);
    // A hand appears with its first sample; before that it has no pose.
    if (!input.fresh) return;
    user.present = true;
    user.X_WH = input.sample.X_WH;
    state.emit(EventKind::user_joined, index);
  }
  user.jumped = false;
  if (input.fresh) take_sample(state, user, input, index);
  user.age = input.age;
  user.freshness = hand::freshness(input.age);
  const bool was_stale = user.stale;
  user.stale = user.freshness < 1.0;
  if (user.stale) user.V_WH = Twist{};
  if (user.stale != was_stale) state.emit(user.stale ? EventKind::input_stale : EventKind::input_back, index);
}

}  // namespace

void begin_tick(state::WorldState& state) noexcept {
  ++state.tick;
  state.event_count = 0;
}

void take_inputs(const state::TickInputs& inputs, state::WorldState& state) noexcept {
  for (std::size_t i = 0; i < state.users.size(); ++i) {
    take_user(state, state.users[i], inputs.users[i], static_cast<std::uint32_t>(i));
  }
}

void move_hands(const haptics::HandModel& hand, state::WorldState& state) noexcept {
  for (UserState& user : state.users) {
    if (user.present) hand.place(user.sample, user.X_WH, user.X_WS);
  }
}

}  // namespace mechane::world
