// Worlds with couplings for the tests of dynamics, and what their energy is.
#pragma once

#include <utility>
#include <vector>

#include "tests/unit/dynamics/scene.hpp"

namespace mechane::dynamics::test {

inline constexpr double kGravity = 9.81;

/// A scene whose couplings are on from the start.
struct Coupled : Scene {
  Coupled(state::WorldDescription from, std::vector<state::Coupling> couplings) : Scene(std::move(from)) {
    for (state::Coupling& coupling : couplings)
      coupling.enabled = true;
    state->couplings = std::move(couplings);
    auto made = DynamicsWorld::create(description, *state);
    if (!made) throw std::runtime_error(made.error().to_string());
    world = std::move(*made);
  }
  [[nodiscard]] state::Coupling& coupling(std::size_t i = 0) { return state->couplings[i]; }
  [[nodiscard]] state::JointState& joint_at(std::size_t i) { return state->joints[i]; }
};

/// Of every body that can move, with the height's share, J.
inline double energy_of(const Scene& scene) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.description.bodies.size(); ++i) {
    const state::BodyDescription& body = scene.description.bodies[i];
    if (body.fixed) continue;
    const state::BodyState& at = scene.state->bodies[i];
    const Vec3 arm_W = at.X_WB.rotate(body.p_BCm);
    const Vec3 v = at.V_WB.at(arm_W);
    const Vec3 w_B = at.X_WB.R.conjugate() * at.V_WB.w;
    sum += 0.5 * body.mass_kg * v.squaredNorm() + 0.5 * w_B.dot(body.inertia_kg_m2 * w_B);
    if (body.use_gravity) sum -= body.mass_kg * scene.description.gravity_W.dot(at.X_WB.p + arm_W);
  }
  return sum;
}

/// Wheels on hinges about W's z, 1 m apart along x, borne by body 0, which is fixed. Wheel i is body i + 1 and joint i.
inline state::WorldDescription wheels(const std::vector<double>& inertias_kg_m2) {
  state::WorldDescription out;
  out.bodies = {fixed_body("FRAME")};
  for (const double inertia : inertias_kg_m2) {
    const std::size_t i = out.bodies.size();
    out.bodies.push_back(body("WHEEL" + std::to_string(i), 2, {inertia, inertia, inertia}));
    out.bodies.back().X_WB.p = Vec3(static_cast<double>(i), 0, 0);
    out.joints.push_back(joint(state::JointKind::hinge, {out.bodies.back().X_WB.p, Quat::Identity()}));
    out.joints.back().body2 = BodyId(i);
  }
  return out;
}

/// A weight on a vertical slider that hangs on the world; its joint's position is its height.
inline void add_weight(state::WorldDescription& world, double mass_kg, const Vec3& p) {
  world.bodies.push_back(body("WEIGHT" + std::to_string(world.bodies.size()), mass_kg));
  world.bodies.back().use_gravity = true;
  world.bodies.back().X_WB.p = p;
  state::JointDescription guide =
      joint(state::JointKind::slider, {p, Quat::FromTwoVectors(Vec3::UnitX(), Vec3::UnitY())},
            {Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitX(), Vec3::UnitY())});
  guide.body1 = BodyId::none();
  guide.body2 = BodyId(world.bodies.size() - 1);
  world.joints.push_back(guide);
}

inline state::Coupling gear(std::size_t joint1, std::size_t joint2, double ratio, double efficiency = 1) {
  state::Coupling out;
  out.kind = state::CouplingKind::gear;
  out.joint1 = JointId(joint1);
  out.joint2 = JointId(joint2);
  out.ratio = ratio;
  out.loss = 1 / efficiency - 1;
  return out;
}

inline state::Coupling stop(std::size_t joint, double at, double sign = 1) {
  state::Coupling out;
  out.kind = state::CouplingKind::stop;
  out.joint1 = JointId(joint);
  out.offset = at;
  out.sign = sign;
  return out;
}

/// One tooth at `phase` of joint1.
inline state::Coupling one_tooth(std::size_t joint1, std::size_t joint2, double step, double window = 0.5) {
  state::Coupling out;
  out.kind = state::CouplingKind::intermittent;
  out.joint1 = JointId(joint1);
  out.joint2 = JointId(joint2);
  out.step = step;
  out.window = window;
  out.phase = kPi;
  return out;
}

/// Over points; `length` as the way is at the start if it is not given. Use node() to make the nodes.
inline state::Coupling rope(const Scene& scene, const std::vector<state::RopeNode>& nodes, double length = 0) {
  state::Coupling out;
  out.kind = state::CouplingKind::rope;
  std::array<Pose, state::kMaxRopeNodes> X_WN;
  for (const state::RopeNode& node : nodes) {
    if (node.body) X_WN[out.node_count] = scene.state->bodies[node.body.index()].X_WB;
    out.nodes[out.node_count++] = node;
  }
  out.offset = length > 0 ? length : state::measure_rope(out, X_WN, Quat::Identity()).length_m;
  return out;
}

inline state::RopeNode node(BodyId body, const Vec3& p_BC, double radius_m = 0, double sense = 1,
                            double efficiency = 1) {
  state::RopeNode out;
  out.body = body;
  out.p_BC = p_BC;
  out.radius_m = radius_m;
  out.sense = sense;
  out.efficiency = efficiency;
  return out;
}

}  // namespace mechane::dynamics::test
