#include "server/agents/hand_effort.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::agents {
namespace {

Vec3 read_vector(const state::WorldState& state, const std::array<std::size_t, 3>& slots) {
  return {state.memory[slots[0]], state.memory[slots[1]], state.memory[slots[2]]};
}

void write_vector(state::WorldState& state, const std::array<std::size_t, 3>& slots, const Vec3& v) {
  for (std::size_t i = 0; i < slots.size(); ++i)
    state.memory[slots[i]] = v[static_cast<Eigen::Index>(i)];
}

}  // namespace

Expected<HandEffort> HandEffort::create(const Build& build, Effort effort) {
  const state::Parameters& p = build.parameters;
  if (!p.given("force") && !p.given("travel"))
    return fail(ErrorCode::missing, "neither force nor travel is given", build.place(), "write force, travel or both");
  HandEffort out;
  out.effort_ = effort;
  out.body_ = p.body("body");
  if (p.given("joint")) {
    const auto joint = build.hinge_or_slider("joint");
    if (!joint) return tl::unexpected(joint.error());
    out.joint_ = *joint;
  }
  const auto axis_B = build.direction("axis", Vec3::Zero());
  if (!axis_B) return tl::unexpected(axis_B.error());
  out.has_axis_ = p.given("axis");
  out.axis_B_ = *axis_B;
  out.sign_ = p.boolean("reverse") ? -1 : 1;
  out.asks_force_ = p.given("force");
  out.asks_travel_ = p.given("travel");
  out.least_n_ = p.number("force");
  out.least_travel_ = p.number("travel");
  out.time_s_ = p.number("time");
  out.force_ = build.slot("force");
  out.travel_ = build.slot("travel");
  out.on_ = build.slot("own.on");
  out.held_s_ = build.slot("own.held_s");
  for (std::size_t i = 0; i < 3; ++i) {
    out.start_[i] = build.slot("own.start" + std::to_string(i));
    out.way_[i] = build.slot("own.way" + std::to_string(i));
  }
  return out;
}

/// The force on a held body is what its grip bore in the last step; on a touched one it is what the device renders.
HandEffort::Now HandEffort::measure(const state::WorldState& state) const noexcept {
  Now now;
  Vec3 f_B_W = Vec3::Zero();
  for (const state::UserState& user : state.users) {
    if (!user.present) continue;
    const bool holds = user.holds(body_);
    if (effort_ == Effort::pull ? !holds : holds || !user.touches(body_)) continue;
    now.any = true;
    f_B_W -= effort_ == Effort::pull ? user.grasp.reaction_W.f : user.output.force_W.f;
  }
  now.force_n = has_axis_ ? f_B_W.dot(state[body_].X_WB.R * axis_B_) : f_B_W.norm();
  return now;
}

void HandEffort::note_start(state::WorldState& state) const noexcept {
  const state::BodyState& body = state[body_];
  write_vector(state, start_, joint_ ? Vec3(state[joint_].position, 0, 0) : body.X_WB.p);
  write_vector(state, way_, body.X_WB.R * axis_B_);
}

double HandEffort::travel(const state::WorldState& state) const noexcept {
  const Vec3 start = read_vector(state, start_);
  if (joint_) return sign_ * (state[joint_].position - start.x());
  const Vec3 moved = state[body_].X_WB.p - start;
  return has_axis_ ? moved.dot(read_vector(state, way_)) : moved.norm();
}

bool HandEffort::run(state::WorldState& state, bool enabled, double dt_s) const noexcept {
  const Now now = measure(state);
  const bool on = enabled && now.any;
  if (on && state.memory[on_] == 0) note_start(state);
  state.memory[on_] = on ? 1 : 0;
  state.memory[force_] = on ? now.force_n : 0;
  state.memory[travel_] = on ? travel(state) : 0;
  const bool enough = on && ((asks_force_ && state.memory[force_] >= least_n_) ||
                             (asks_travel_ && state.memory[travel_] >= least_travel_));
  state.memory[held_s_] = enough ? state.memory[held_s_] + dt_s : 0;
  return enough && state.memory[held_s_] + 0.5 * dt_s >= time_s_;
}

}  // namespace mechane::agents
