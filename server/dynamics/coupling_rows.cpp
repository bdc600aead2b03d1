#include "server/dynamics/coupling_rows.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mechane::dynamics {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

using state::Coupling;
using state::CouplingKind;

std::size_t index_of(BodyId body) {
  return body ? body.index() : kGround;
}

std::size_t most_rows_of(const Coupling& coupling) {
  switch (coupling.kind) {
    case CouplingKind::fixed:
      return 6;
    case CouplingKind::gear:
      return 2;
    case CouplingKind::intermittent:
    case CouplingKind::stop:
      return 1;
    case CouplingKind::rope:
      return coupling.node_count;
    case CouplingKind::watch:
      break;
  }
  return 0;
}

bool known(const Coupling& c, const state::WorldState& state) {
  const auto body = [&](BodyId id) { return !id || id.index() < state.bodies.size(); };
  const auto joint = [&](JointId id) { return id && id.index() < state.joints.size(); };
  switch (c.kind) {
    case CouplingKind::fixed:
      return body(c.body1) && c.body2 && body(c.body2) && c.body1 != c.body2;
    case CouplingKind::gear:
      return joint(c.joint1) && joint(c.joint2) && c.joint1 != c.joint2 && std::isfinite(c.ratio) && c.loss >= 0;
    case CouplingKind::intermittent:
      return joint(c.joint1) && joint(c.joint2) && c.joint1 != c.joint2 && c.window > 0 && c.window < 2 * kPi &&
             std::isfinite(c.step);
    case CouplingKind::stop:
    case CouplingKind::watch:
      return joint(c.joint1);
    case CouplingKind::rope:
      break;
  }
  const bool counted = c.node_count >= 2 && c.node_count <= c.nodes.size();
  return counted && (!c.drum || (joint(c.joint1) && body(c.body1))) &&
         std::all_of(c.nodes.begin(), c.nodes.begin() + c.node_count,
                     [&](const state::RopeNode& n) { return body(n.body) && n.radius_m >= 0 && n.efficiency > 0; });
}

}  // namespace

Expected<CouplingRows> CouplingRows::create(const state::WorldState& state) {
  CouplingRows out;
  for (std::size_t i = 0; i < state.couplings.size(); ++i) {
    if (!known(state.couplings[i], state))
      return fail(ErrorCode::invalid_value, "it ties a body or joint that does not exist, or has a number out of range",
                  "coupling " + std::to_string(i), "name bodies and joints of this world, and positive sizes");
    out.most_rows_ += most_rows_of(state.couplings[i]);
  }
  out.first_.resize(state.couplings.size());
  out.rows_.resize(state.couplings.size());
  return out;
}

void CouplingRows::gather(const state::WorldState& state, std::span<const Frame> frames,
                          std::span<const JointAxis> axes, double dt_s, Mechanism& mechanism) noexcept {
  frames_ = frames;
  axes_ = axes;
  dt_s_ = dt_s;
  mechanism_ = &mechanism;
  for (std::size_t i = 0; i < state.couplings.size(); ++i) {
    const Coupling& coupling = state.couplings[i];
    first_[i] = mechanism.size();
    if (coupling.enabled) {
      switch (coupling.kind) {
        case CouplingKind::fixed:
          add_fixed(coupling);
          break;
        case CouplingKind::gear:
          add_gear(coupling);
          break;
        case CouplingKind::intermittent:
          add_intermittent(coupling);
          break;
        case CouplingKind::stop:
          add_stop(coupling);
          break;
        case CouplingKind::rope:
          add_rope(state, coupling);
          break;
        case CouplingKind::watch:
          break;
      }
    }
    rows_[i] = mechanism.size() - first_[i];
  }
}

/// Adds `factor` times a joint's rate to the last row.
void CouplingRows::add_axis(std::size_t joint, double factor) noexcept {
  const JointAxis& axis = axes_[joint];
  mechanism_->add_terms(axis.row, axis.body1, axis.body2, factor, frames_);
}

void CouplingRows::add_fixed(const Coupling& tie) noexcept {
  const std::size_t b1 = index_of(tie.body1), b2 = index_of(tie.body2);
  const Frame ground;
  const Frame& frame1 = b1 == kGround ? ground : frames_[b1];
  const Pose X_WP = frame1.X_WB * tie.X_B1B2;
  const Pose& X_WB2 = frames_[b2].X_WB;
  const Vec3 shift_W = X_WB2.p - X_WP.p;
  const Vec3 turn_W = rotation_vector(X_WB2.R * X_WP.R.conjugate());
  for (int k = 0; k < 3; ++k) {
    Row row = linear_row(frame1, frames_[b2], X_WB2.p, Vec3::Unit(k));
    row.target = -correction(shift_W[k], dt_s_, kMaxLinearCorrection);
    mechanism_->add_row(row, b1, b2, frames_);
  }
  for (int k = 0; k < 3; ++k) {
    Row row = angular_row(Vec3::Unit(k));
    row.target = -correction(turn_W[k], dt_s_, kMaxAngularCorrection);
    mechanism_->add_row(row, b1, b2, frames_);
  }
}

/// The loss is friction in the teeth: it acts on joint1, in proportion to the force on the teeth.
void CouplingRows::add_gear(const Coupling& gear) noexcept {
  if (!axis_on(gear.joint1) || !axis_on(gear.joint2)) return;
  const std::size_t j1 = gear.joint1.index(), j2 = gear.joint2.index();
  const double error = gear.ratio * axes_[j1].now.position - axes_[j2].now.position - gear.offset;
  const double target = -correction(error, dt_s_, kMaxAngularCorrection);
  const bool rubs = gear.loss > 0;
  // A row that another follows must be among those with limits, even though it has none.
  const std::size_t teeth = mechanism_->add({target, rubs ? RowLimit::range : RowLimit::none, 0, -kEndless, kEndless});
  add_axis(j1, gear.ratio);
  add_axis(j2, -1);
  if (!rubs) return;
  mechanism_->add({0, RowLimit::friction, teeth, 0, gear.loss * std::abs(gear.ratio)});
  add_axis(j1, 1);
}

/// The ratio in this step is the mean slope of the stair over it, so that the joint stops at the corner of a window and not past it.
void CouplingRows::add_intermittent(const Coupling& gear) noexcept {
  if (!axis_on(gear.joint1) || !axis_on(gear.joint2)) return;
  const std::size_t j1 = gear.joint1.index(), j2 = gear.joint2.index();
  const JointMeasure& driver = axes_[j1].now;
  const double way = driver.velocity * dt_s_;
  const double now = intermittent_position(gear, driver.position);
  constexpr double kLeast = 1e-9;  // rad; for a smaller way take the slope at this place
  const double over = std::abs(way) > kLeast ? way : kLeast;
  const double ratio = (intermittent_position(gear, driver.position + over) - now) / over;
  if (ratio == 0 && !gear.lock) return;
  // A wheel that is not locked may stand anywhere when the tooth comes, and is taken along from there.
  const double error = gear.lock ? now - axes_[j2].now.position - gear.offset : 0;
  mechanism_->add({-correction(error, dt_s_, kMaxAngularCorrection)});
  if (ratio != 0) add_axis(j1, ratio);
  add_axis(j2, -1);
}

void CouplingRows::add_stop(const Coupling& stop) noexcept {
  if (!axis_on(stop.joint1)) return;
  const std::size_t j = stop.joint1.index();
  const double beyond = -stop.sign * (axes_[j].now.position - stop.offset);
  mechanism_->add({limit_speed(beyond, dt_s_, kMaxAngularCorrection), RowLimit::range, 0, 0, kEndless});
  add_axis(j, stop.sign);
}

/// Adds to the last row how fast part number `part`, from a node to the next, grows.
void CouplingRows::add_rope_part(const Coupling& rope, const state::RopePath& path, std::size_t part) noexcept {
  const Vec3& from = path.p_out_W[part];
  const Vec3& to = path.p_in_W[part + 1];
  const double length = (to - from).norm();
  if (length < 1e-9) return;
  const Vec3 u = (to - from) / length;
  const auto add = [&](const state::RopeNode& node, const Vec3& p, double sign) {
    if (!node.body) return;
    const std::size_t body = node.body.index();
    mechanism_->add_term(body, sign * u, sign * (p - frames_[body].p_WCm).cross(u), frames_);
  };
  add(rope.nodes[part], from, -1);
  add(rope.nodes[part + 1], to, 1);
}

/// One row for the whole rope, whose impulse is the first part's tension (negative: it pulls), and one for each sheave that brakes
/// it: that the rope stands still on the sheave, up to the friction that its efficiency allows.
void CouplingRows::add_rope(const state::WorldState& state, const Coupling& rope) noexcept {
  if (rope.drum && !axis_on(rope.joint1)) return;
  const state::RopePath path = rope_path(rope, state);
  const std::size_t parts = rope.node_count - 1;
  double too_long = path.length_m - rope.offset;
  if (rope.drum) {
    const state::RopeNode& drum = rope.nodes[0];
    too_long += drum.sense * drum.radius_m * (path.drum_angle_rad - axes_[rope.joint1.index()].now.position);
  }
  const std::size_t leader =
      mechanism_->add({-limit_speed(too_long, dt_s_, kMaxLinearCorrection), RowLimit::range, 0, -kEndless, 0});
  for (std::size_t part = 0; part < parts; ++part)
    add_rope_part(rope, path, part);
  for (std::size_t i = 1; i < parts; ++i) {
    const state::RopeNode& sheave = rope.nodes[i];
    const double wrap = std::max(0.0, path.wrap_rad[i]);
    const double efficiency = sheave.efficiency * std::exp(-sheave.friction_coefficient * wrap);
    if (efficiency >= 1) continue;
    mechanism_->add({0, RowLimit::sheave, leader, 1 - 1 / efficiency, 1 - efficiency});
    for (std::size_t part = i; part < parts; ++part)
      add_rope_part(rope, path, part);
  }
}

void CouplingRows::store(state::WorldState& state, std::span<const JointAxis> axes, const Mechanism& mechanism,
                         double dt_s) const noexcept {
  for (std::size_t i = 0; i < state.couplings.size(); ++i) {
    Coupling& to = state.couplings[i];
    to.forget_forces();
    if (to.kind == CouplingKind::rope) {
      const state::RopePath path = rope_path(to, state);
      double wound = 0;
      if (to.drum) wound = to.nodes[0].sense * to.nodes[0].radius_m * (path.drum_angle_rad - state[to.joint1].position);
      to.length_m = to.offset - wound;
      to.slack_m = std::max(0.0, to.length_m - path.length_m);
    }
    if (rows_[i] == 0) continue;
    const auto bore = [&](std::size_t row) { return mechanism.impulse_of(first_[i] + row) / dt_s; };
    switch (to.kind) {
      case CouplingKind::fixed:
        to.force_n = Vec3(bore(0), bore(1), bore(2)).norm();
        to.torque_nm = Vec3(bore(3), bore(4), bore(5)).norm();
        break;
      case CouplingKind::rope:
        to.force_n = to.end_force_n = -bore(0);
        for (std::size_t k = 1; k < rows_[i]; ++k)
          to.end_force_n -= bore(k);
        break;
      default: {
        const bool second = to.kind == CouplingKind::gear || to.kind == CouplingKind::intermittent;
        const JointAxis& axis = axes[(second ? to.joint2 : to.joint1).index()];
        (axis.row.n_W.isZero() ? to.torque_nm : to.force_n) = std::abs(bore(0));
      }
    }
  }
}

state::RopePath rope_path(const Coupling& rope, const state::WorldState& state) noexcept {
  std::array<Pose, state::kMaxRopeNodes> X_WN;
  for (std::size_t i = 0; i < rope.node_count; ++i) {
    if (rope.nodes[i].body) X_WN[i] = state[rope.nodes[i].body].X_WB;
  }
  return state::measure_rope(rope, X_WN, rope.body1 ? state[rope.body1].X_WB.R : Quat::Identity());
}

}  // namespace mechane::dynamics
