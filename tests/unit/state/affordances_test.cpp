#include "server/state/affordances.hpp"

#include <gtest/gtest.h>

namespace mechane::state {
namespace {

using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

WorldDescription workshop() {
  WorldDescription world;
  world.bodies.resize(3);
  world.bodies[0].name = "FRAME";
  world.bodies[0].fixed = true;
  world.bodies[1].name = "CRANK";
  world.bodies[2].name = "TORCH";
  JointDescription axle;
  axle.name = "AXLE";
  axle.body1 = BodyId(0);
  axle.body2 = BodyId(1);
  axle.X_B1J.p = {0, 1, 0};
  world.joints = {axle};
  world.agents.resize(3);
  world.agents[0] = {"HOLD", "simulation.grasp", {{"bodies", Texts{"CRANK", "FRAME", "NOBODY"}}}, 1};
  world.agents[1] = {"SEAT",
                     "geometry.snap",
                     {{"object", Texts{"CRANK"}},
                      {"into", Texts{"FRAME"}},
                      {"position", Numbers{0, 2, 0}},
                      {"rotation", Numbers{0, 3, 0, 0.5}}},
                     2};
  world.agents[2] = {
      "CATCH", "simulation.lit", {{"body", Texts{"TORCH"}}, {"at", Numbers{0, 0, -0.3}}, {"flame", Texts{"FRAME"}}}, 3};
  return world;
}

TEST(Ways, JointsGraspsPlacesAndFires) {
  const std::vector<Affordance> affordances = affordances_of(workshop());
  ASSERT_EQ(affordances.size(), 4U) << "fixed bodies and unknown names are left out";
  EXPECT_EQ(affordances[0].kind, Affordance::Kind::turns);
  EXPECT_EQ(affordances[0].object, BodyId(1));
  EXPECT_EQ(affordances[0].base, BodyId(0));
  EXPECT_EQ(affordances[0].X_AJ.p, Vec3(0, 1, 0));
  EXPECT_FALSE(affordances[0].agent);
  EXPECT_EQ(affordances[1].kind, Affordance::Kind::taken);
  EXPECT_EQ(affordances[1].object, BodyId(1));
  EXPECT_EQ(affordances[1].agent, AgentId(0));
  EXPECT_EQ(affordances[2].kind, Affordance::Kind::placed);
  EXPECT_EQ(affordances[2].X_AJ.p, Vec3(0, 2, 0));
  EXPECT_NEAR((rotation_vector(affordances[2].X_AJ.R) - Vec3(0, 0.5, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(affordances[3].kind, Affordance::Kind::brought) << "the fire is fixed: the torch comes to it";
  EXPECT_EQ(affordances[3].object, BodyId(2));
  EXPECT_EQ(affordances[3].base, BodyId(0));
  EXPECT_EQ(affordances[3].X_BJ.p, Vec3(0, 0, -0.3));
}

TEST(Ways, WithoutNamesAGraspTakesAllThatMoves) {
  WorldDescription world = workshop();
  world.agents = {{"ANY", "simulation.grasp", {}, 1}};
  const std::vector<Affordance> affordances = affordances_of(world);
  ASSERT_EQ(affordances.size(), 3U);
  EXPECT_EQ(affordances[1].object, BodyId(1));
  EXPECT_EQ(affordances[2].object, BodyId(2));
  world.bodies.resize(6000);
  EXPECT_EQ(affordances_of(world).size(), kMaxAffordances);
}

}  // namespace
}  // namespace mechane::state
