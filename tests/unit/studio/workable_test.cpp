// Where a hand has something to do: around what it can work, as it lies, and nothing else.
#include "client-sdk/studio/view/workable.hpp"

#include <gtest/gtest.h>

#include "server/collision/superquadric_object.hpp"

namespace mechane::studio {
namespace {

/// A table, and a ball of radius 0.1 that hands may take.
struct Table {
  state::WorldDescription world;
  SeenWorld seen;
  Table() {
    for (const char* name : {"TABLE", "BALL"}) {
      state::BodyDescription& body = world.bodies.emplace_back();
      body.name = name;
      geometry::Superquadric ball;
      ball.a = Vec3::Constant(0.1);
      body.object = std::make_shared<collision::Object>(collision::make_superquadric_object(ball, 0.02));
    }
    world.bodies[0].fixed = true;
    world.bodies[1].graspable = true;
    state::ComponentDescription& hold = world.agents.emplace_back();
    hold.name = "HOLD";
    hold.type = "simulation.grasp";
    seen.X_WB = {Pose{}, Pose{Vec3(1, 2, 3)}};
    seen.visible = {1, 1};
  }
};

TEST(Workable, IsAroundWhatAHandCanTakeWhereItLies) {
  Table table;
  const auto all = workable_bodies(table.world, table.seen);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].def, "BALL");
  EXPECT_TRUE(all[0].box_W.center().isApprox(Vec3(1, 2, 3), 0.01));
  EXPECT_TRUE(all[0].box_W.sizes().isApprox(Vec3::Constant(0.2), 0.05));
}

TEST(Workable, LeavesOutWhatIsNotSeenOrNotTouched) {
  Table hidden;
  hidden.seen.visible[1] = 0;
  EXPECT_TRUE(workable_bodies(hidden.world, hidden.seen).empty());
  Table ghost;
  ghost.world.bodies[1].object = nullptr;
  EXPECT_TRUE(workable_bodies(ghost.world, ghost.seen).empty());
  Table unheard;
  unheard.seen.X_WB.clear();
  EXPECT_TRUE(workable_bodies(unheard.world, unheard.seen).empty()) << "no frame has come yet";
}

}  // namespace
}  // namespace mechane::studio
