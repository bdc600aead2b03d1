#include "server/state/ways.hpp"

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
  const std::vector<Way> ways = ways_of(workshop());
  ASSERT_EQ(ways.size(), 4U) << "what is fixed is not taken, what is not there neither";
  EXPECT_EQ(ways[0].kind, Way::Kind::turns);
  EXPECT_EQ(ways[0].object, BodyId(1));
  EXPECT_EQ(ways[0].base, BodyId(0));
  EXPECT_EQ(ways[0].X_AJ.p, Vec3(0, 1, 0));
  EXPECT_FALSE(ways[0].agent);
  EXPECT_EQ(ways[1].kind, Way::Kind::taken);
  EXPECT_EQ(ways[1].object, BodyId(1));
  EXPECT_EQ(ways[1].agent, AgentId(0));
  EXPECT_EQ(ways[2].kind, Way::Kind::placed);
  EXPECT_EQ(ways[2].X_AJ.p, Vec3(0, 2, 0));
  EXPECT_NEAR((rotation_vector(ways[2].X_AJ.R) - Vec3(0, 0.5, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(ways[3].kind, Way::Kind::brought) << "the fire is fixed: the torch comes to it";
  EXPECT_EQ(ways[3].object, BodyId(2));
  EXPECT_EQ(ways[3].base, BodyId(0));
  EXPECT_EQ(ways[3].X_BJ.p, Vec3(0, 0, -0.3));
}

TEST(Ways, WithoutNamesAGraspTakesAllThatMoves) {
  WorldDescription world = workshop();
  world.agents = {{"ANY", "simulation.grasp", {}, 1}};
  const std::vector<Way> ways = ways_of(world);
  ASSERT_EQ(ways.size(), 3U);
  EXPECT_EQ(ways[1].object, BodyId(1));
  EXPECT_EQ(ways[2].object, BodyId(2));
  world.bodies.resize(6000);
  EXPECT_EQ(ways_of(world).size(), kMaxWays);
}

}  // namespace
}  // namespace mechane::state
