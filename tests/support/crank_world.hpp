// A small world for tests: a crank with a round handle on a hinge, one grasp agent, one activity.
#pragma once

#include <memory>

#include "server/collision/samples.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/state/description.hpp"
#include "server/world/world.hpp"

namespace mechane::test {

inline constexpr double kCrankRadiusM = 0.25;
inline constexpr double kGripRadiusM = 0.017;

/// The handle, a rounded cylinder along z, and nothing else of the crank can be touched. Its frame is the crank body's, moved to the
/// handle.
inline std::shared_ptr<const collision::Object> make_grip() {
  geometry::Superquadric shape;
  shape.a = Vec3(kGripRadiusM, kGripRadiusM, 0.065);
  shape.e1 = 0.3;
  shape.e2 = 1.0;
  collision::Object object = collision::make_superquadric_object(shape, 0.004);
  const Vec3 shift(kCrankRadiusM, 0, 0);
  for (auto& part : object.parts) {
    part.X_OQ.p += shift;
    part.bound_O.center += shift;
  }
  for (auto& cluster : object.clusters) {
    cluster.bound_O.center += shift;
    for (std::size_t lane = 0; lane < collision::kLanes; ++lane)
      cluster.samples_O.x[lane] += static_cast<float>(kCrankRadiusM);
  }
  collision::close_clusters(object);
  return std::make_shared<const collision::Object>(std::move(object));
}

/// The hinge's axis is W's z through the origin; the handle starts at (0.25, 0, 0).
inline std::shared_ptr<state::WorldDescription> make_crank_description(double stiffness_n_per_m = 600) {
  auto world = std::make_shared<state::WorldDescription>();
  world->id = "crank";
  world->content_hash = "test";
  state::BodyDescription frame;
  frame.name = "FRAME";
  frame.fixed = true;
  state::BodyDescription crank;
  crank.name = "CRANK";
  crank.mass_kg = 2;
  crank.inertia_kg_m2 = Vec3(0.05, 0.05, 0.05).asDiagonal();
  crank.use_gravity = false;
  crank.graspable = true;
  crank.object = make_grip();
  crank.haptic.stiffness_n_per_m = stiffness_n_per_m;
  if (stiffness_n_per_m == 0) crank.haptic.damping_ns_per_m = 0;
  world->bodies = {frame, crank};
  state::JointDescription hinge;
  hinge.name = "AXLE";
  hinge.body1 = BodyId(0);
  hinge.body2 = BodyId(1);
  world->joints = {hinge};
  world->agents = {{"HINGE",
                    "geometry.hinge",
                    {{"joint", std::vector<std::string>{"AXLE"}}, {"frictionTorque", std::vector<double>{0.02}}},
                    0},
                   {"GRASP",
                    "simulation.grasp",
                    {{"bodies", std::vector<std::string>{"CRANK"}}, {"forceLimit", std::vector<double>{6}}},
                    0}};
  world->quantities = {{"turns", "AXLE.turns", ""}, {"held", "GRASP.active", ""}};
  state::StepDescription step;
  step.name = "turn";
  step.activity = ActivityId(0);
  step.triggers = {{QuantityId(0), state::Comparison::greater, 2.0, 1e-6, 0, StepId::none()}};
  world->steps = {step};
  world->activities = {{"use", StepId(0), {}}};
  return world;
}

/// Made once for a test program: building the hand's shapes takes a while.
inline std::shared_ptr<const haptics::HandModel> shared_hand() {
  static const auto kHand = [] {
    auto hand = haptics::HandModel::create(haptics::HandSize{});
    return std::make_shared<const haptics::HandModel>(std::move(hand.value()));
  }();
  return kHand;
}

}  // namespace mechane::test
