// What the loop asks of collisions: the same bits, a resume from a state, no allocation.
#include "server/state/snapshot.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/blocks.hpp"

namespace mechane::dynamics::test {
namespace {

const Vec3 kBrickHalf_m(0.03, 0.02, 0.025);

/// `count` bricks in five piles, a little askew; dropped from `gap_m` above each other.
state::WorldDescription piles(std::size_t count, double gap_m) {
  std::vector<state::BodyDescription> bodies{table()};
  for (std::size_t i = 0; i < count; ++i) {
    const auto pile = static_cast<double>(i % 5), layer = static_cast<double>(i / 5);
    const Vec3 p(-0.2 + 0.1 * pile, 0.02 + (0.04 + gap_m) * layer + gap_m, 0.003 * static_cast<double>(i % 3));
    const Quat R = quat_from_rotation_vector({0, 0.1 * static_cast<double>(i), 0});
    bodies.push_back(block("BRICK", kBrickHalf_m, {p, R}));
  }
  return world_of(std::move(bodies));
}

/// Bricks fall, one is hit by a hand that holds another, one is frozen and freed, one is hidden and shown.
void stir(Scene& scene, int n) {
  state::WorldState& s = *scene.state;
  if (n == 200) hold(scene, 2, Vec3(0.01, 0, 0), 15, 0.5);
  if (n >= 200 && n < 900) s.users[0].V_WH.v = Vec3(-0.3, 0, 0.1 * std::cos(0.01 * n));
  if (n >= 200 && n < 900) s.users[0].X_WH.p += s.users[0].V_WH.v * kStep;
  if (n == 900) s.users[0].grasp = {};
  if (n % 300 == 100) s.bodies[5].movable = !s.bodies[5].movable;
  if (n % 400 == 150) s.bodies[4].visible = !s.bodies[4].visible;
}

TEST(CollisionLoop, SameInputsGiveTheSameBitsAlsoFromASnapshot) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  const state::WorldDescription world = piles(10, 0.01);
  Scene one(world), two(world), resumed(world);
  std::vector<std::byte> bytes;
  for (int n = 0; n < 1500; ++n) {
    for (Scene* scene : {&one, &two}) {
      stir(*scene, n);
      scene->world->step(*scene->state, kStep);
    }
    if (n == 457) {  // in the middle of the brawl
      state::write_snapshot(*one.state, bytes);
      ASSERT_TRUE(state::read_snapshot(bytes, *resumed.state));
    } else if (n > 457) {
      stir(resumed, n);
      resumed.world->step(*resumed.state, kStep);
    }
    if (n % 50 == 49) {
      ASSERT_EQ(state::state_hash(*one.state), state::state_hash(*two.state)) << "tick " << n;
    }
  }
  EXPECT_EQ(state::state_hash(*one.state), state::state_hash(*resumed.state));
  EXPECT_GT((one.at(2).X_WB.p - world.bodies[2].X_WB.p).norm(), 0.05) << "the hand must have moved something";
  for (std::size_t i = 1; i < one.state->bodies.size(); ++i)
    EXPECT_TRUE(one.at(i).X_WB.p.allFinite());
}

TEST(CollisionLoop, AStepAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Scene scene(piles(20, 0.01));
  const mechane::test::AllocationGuard guard;
  for (int n = 0; n < 1500; ++n) {
    stir(scene, n);
    scene.world->step(*scene.state, kStep);
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
}

/// All in one place: every pair touches at once, more than a step takes.
TEST(CollisionLoop, AHeapOfAllInOnePlaceAllocatesNothingAndIsNotShotApart) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  state::WorldDescription world = piles(26, 0);
  for (std::size_t i = 1; i < world.bodies.size(); ++i)
    world.bodies[i].X_WB.p = Vec3(1e-3 * static_cast<double>(i % 5), 0.05, 1e-3 * static_cast<double>(i % 7));
  Scene scene(world);
  std::size_t allocations = 0;
  {
    const mechane::test::AllocationGuard guard;
    scene.run(0.03);
    allocations = guard.allocations();
  }
  if (mechane::test::AllocationGuard::available()) {
    EXPECT_EQ(allocations, 0u);
  }
  for (std::size_t i = 1; i < world.bodies.size(); ++i)
    EXPECT_LT(scene.at(i).V_WB.v.norm(), 1.0) << "pushed apart, but with no speed that stays";
}

}  // namespace
}  // namespace mechane::dynamics::test
