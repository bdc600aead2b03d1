// What the loop asks of dynamics: the same bits, no allocation, a resume from a state, and speed.
#include <chrono>
#include <cmath>
#include <iostream>

#include "server/state/snapshot.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/scene.hpp"

namespace mechane::dynamics::test {
namespace {

/// A crank on a hinge, a loose block, a sled and a bob: every kind of joint, and two users who grasp, turn and let go.
state::WorldDescription workshop() {
  state::WorldDescription out = wheel(0.05);
  out.bodies.push_back(body("BLOCK", 0.5, {0.001, 0.002, 0.003}));
  out.bodies.push_back(body("SLED", 2));
  out.bodies.push_back(body("BOB", 1, {0.002, 0.003, 0.004}));
  for (std::size_t i = 2; i < 5; ++i) {
    out.bodies[i].use_gravity = true;
    out.bodies[i].p_BCm = Vec3(0.01, -0.02, 0.03);
    out.bodies[i].X_WB.p = Vec3(1.0 * static_cast<double>(i), 0, 0);
  }
  state::JointDescription slider = joint(state::JointKind::slider, {Vec3(3, 0, 0), Quat::Identity()});
  slider.body2 = BodyId(3);
  state::JointDescription ball =
      joint(state::JointKind::ball, {Vec3(4, 0.2, 0), Quat::Identity()}, {Vec3(0, 0.2, 0), Quat::Identity()});
  ball.body1 = BodyId::none();
  ball.body2 = BodyId(4);
  out.joints.push_back(slider);
  out.joints.push_back(ball);
  return out;
}

/// What hands and machines ask of the workshop in tick n; the same every time.
void play(Scene& scene, int n) {
  state::WorldState& s = *scene.state;
  if (n % 2000 == 100) {
    hold(scene, 1, Vec3(0.25, 0, 0), 12, 0.05);
    s.users[1] = s.users[0];
    hold(scene, 2, Vec3(0.02, 0, 0), 15, 0.5);
    std::swap(s.users[0], s.users[1]);
  }
  if (n % 2000 == 1500) s.users[0].grasp = s.users[1].grasp = {};
  if (n % 3000 == 2500) s.joints[1].enabled = !s.joints[1].enabled;
  if (n % 700 == 0) s.bodies[4].movable = !s.bodies[4].movable;
  const double t = n * 1e-3;
  for (state::UserState& user : s.users) {
    user.V_WH = {Vec3(std::cos(3 * t), std::sin(2 * t), 0.1), Vec3(0.2, 0, std::cos(t))};
    user.X_WH.p += user.V_WH.v * 1e-3;
  }
  s.joints[0].friction = 0.1;
  s.joints[0].resistance = 0.05;
  s.joints[0].max_position = 30;
  s.joints[0].min_position = -3;
  s.joints[1].load = std::sin(5 * t);
  s.bodies[4].load_W.f = Vec3(0.1, 0, std::cos(t));
}

TEST(Loop, SameInputsGiveTheSameBits) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  Scene a(workshop()), b(workshop());
  for (int n = 0; n < 10000; ++n) {
    for (Scene* scene : {&a, &b}) {
      play(*scene, n);
      scene->world->step(*scene->state, kStep);
    }
    if (n % 100 == 99) {
      ASSERT_EQ(state::state_hash(*a.state), state::state_hash(*b.state)) << "tick " << n;
    }
  }
  EXPECT_TRUE(a.at(1).X_WB.R.coeffs().allFinite());
  EXPECT_GT(std::abs(a.state->joints[0].position), 0.1) << "the play moves the crank";
}

TEST(Loop, AWorldMadeFromASnapshotGoesOnWithTheSameBits) {
  Scene live(workshop()), resumed(workshop());
  std::vector<std::byte> bytes;
  for (int n = 0; n < 3000; ++n) {
    play(live, n);
    live.world->step(*live.state, kStep);
    if (n == 1234) {
      state::write_snapshot(*live.state, bytes);
      ASSERT_TRUE(state::read_snapshot(bytes, *resumed.state));
    } else if (n > 1234) {
      play(resumed, n);
      resumed.world->step(*resumed.state, kStep);
    }
  }
  EXPECT_EQ(state::state_hash(*live.state), state::state_hash(*resumed.state));
}

TEST(Loop, AStepAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Scene scene(workshop());
  const mechane::test::AllocationGuard guard;
  for (int n = 0; n < 5000; ++n) {
    play(scene, n);
    scene.world->step(*scene.state, kStep);
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
}

TEST(Loop, TheGuardSeesAnAllocation) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  const mechane::test::AllocationGuard guard;
  std::vector<int> numbers(100);
  EXPECT_GE(guard.allocations(), 1u) << numbers.size();
}

TEST(Loop, TimeOfAStepWithOneHingeAndOneGrasp) {
  Scene scene(wheel(0.05));
  scene.hinge().friction = 0.1;
  hold(scene, 1, Vec3(0.25, 0, 0), 12, 0.05);
  constexpr int kTicks = 20000;
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < kTicks; ++n) {
    const double angle = 5e-3 * n;
    scene.state->users[0].X_WH.p = 0.25 * Vec3(std::cos(angle), std::sin(angle), 0);
    scene.state->users[0].V_WH.v = 1.25 * Vec3(-std::sin(angle), std::cos(angle), 0);
    scene.world->step(*scene.state, kStep);
  }
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
  RecordProperty("ns_per_step", static_cast<int>(spent.count() / kTicks));
  std::cout << "DynamicsWorld::step, one hinge and one grasp: " << spent.count() / kTicks << " ns\n";
  EXPECT_LT(spent.count() / kTicks, 1e6) << "a step must fit into its tick many times over";
}

}  // namespace
}  // namespace mechane::dynamics::test
