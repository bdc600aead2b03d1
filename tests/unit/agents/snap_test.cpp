#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::EventKind;

constexpr double kTolerance_m = 0.05, kTolerance_rad = 0.2;

/// PART goes to (0, 0.5, 0) in CRANK, turned by 90 degrees about y.
state::WorldDescription with_snap(bool with_axis = false) {
  state::WorldDescription world = stage_world();
  world.bodies[2].X_WB = {Vec3(0.2, 0, 0.1), Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX()))};
  world.agents = {{"SNAP",
                   "geometry.snap",
                   {{"object", text({"PART"})},
                    {"into", text({"CRANK"})},
                    {"position", number({0, 0.5, 0})},
                    {"rotation", number({0, 1, 0, kPi / 2})},
                    {"tolerance", number({kTolerance_m, kTolerance_rad})}},
                   3}};
  if (with_axis) world.agents[0].parameters["axis"] = number({0, 0, 2});
  return world;
}

Pose place_in(const Stage& stage) {
  return stage.state->bodies[2].X_WB * Pose{Vec3(0, 0.5, 0), Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()))};
}

state::BodyState& part(Stage& stage) {
  return stage.state->bodies[1];
}

RC_GTEST_PROP(Snap, TakesTheBodyWithinBothTolerancesAndOnlyThen, ()) {
  Stage stage(with_snap());
  const auto unit = [] { return 0.01 * *rc::gen::inRange(-100, 101); };
  const Vec3 off = 0.06 * Vec3(unit(), unit(), unit());
  const Vec3 turn = 0.2 * Vec3(unit(), unit(), unit());
  RC_PRE(std::abs(off.norm() - kTolerance_m) > 1e-6 && std::abs(turn.norm() - kTolerance_rad) > 1e-6);
  const Pose X_WT = place_in(stage);
  part(stage).X_WB = {X_WT.p + off, quat_from_rotation_vector(turn) * X_WT.R};
  stage.tick();
  RC_ASSERT(std::abs(stage.value("SNAP.distance") - off.norm()) < 1e-9);
  RC_ASSERT(std::abs(stage.value("SNAP.angle") - turn.norm()) < 1e-9);
  const bool close = off.norm() < kTolerance_m && turn.norm() < kTolerance_rad;
  RC_ASSERT(part(stage).movable == !close);
  stage.run(0.3);
  RC_ASSERT((stage.value("SNAP.placed") == 1) == close);
  if (!close) return;
  RC_ASSERT((part(stage).X_WB.p - X_WT.p).norm() < 1e-12);
  RC_ASSERT(rotation_vector(part(stage).X_WB.R * X_WT.R.conjugate()).norm() < 1e-9);
}

TEST(Snap, LeadsTheBodyHomeSmoothlyAndTakesItOutOfBothHands) {
  Stage stage(with_snap());
  const Pose X_WT = place_in(stage);
  part(stage).X_WB = {X_WT.p + Vec3(0.04, 0, 0), X_WT.R};
  for (const std::size_t u : {0U, 1U}) {
    stage.appear(u, hand::HandKind::one_point, part(stage).X_WB.p);
    stage.user(u).grasp.active = true;
    stage.user(u).grasp.body = BodyId(1);
  }
  stage.tick();
  EXPECT_FALSE(stage.user(0).grasp.active || stage.user(1).grasp.active);
  EXPECT_EQ(stage.count(EventKind::released), 2);
  Vec3 last = part(stage).X_WB.p;
  double fastest = 0;
  for (int n = 0; n < 200; ++n) {
    stage.tick();
    fastest = std::max(fastest, (part(stage).X_WB.p - last).norm() / kStep);
    last = part(stage).X_WB.p;
  }
  EXPECT_EQ(stage.value("SNAP.placed"), 1);
  EXPECT_LE(fastest, 1.5 * 0.04 / 0.2 + 1e-3) << "a smooth step's greatest speed";
}

TEST(Snap, WithAnAxisAnyRotationAboutItIsRight) {
  Stage stage(with_snap(true));
  const Pose X_WT = place_in(stage);
  const Quat about_own_z = X_WT.R * Quat(Eigen::AngleAxisd(2.3, Vec3::UnitZ()));
  part(stage).X_WB = {X_WT.p + Vec3(0, 0.01, 0), quat_from_rotation_vector(Vec3(0.05, 0.05, 0)) * about_own_z};
  stage.run(0.3);
  EXPECT_EQ(stage.value("SNAP.placed"), 1);
  EXPECT_LT(stage.value("SNAP.angle"), 1e-9);
  EXPECT_LT((part(stage).X_WB.rotate(Vec3::UnitZ()) - X_WT.rotate(Vec3::UnitZ())).norm(), 1e-9);
  EXPECT_LT(rotation_vector(part(stage).X_WB.R * about_own_z.conjugate()).norm(), 0.1)
      << "it keeps the turn that it had";
}

TEST(Snap, WhileOffTakesNothing) {
  Stage stage(with_snap());
  stage.state->agent_enabled[0] = 0;
  part(stage).X_WB = place_in(stage);
  stage.run(0.3);
  EXPECT_EQ(stage.value("SNAP.placed"), 0);
  EXPECT_TRUE(part(stage).movable);
}

TEST(Snap, LosesABodyThatIsFreedAndTakenAway) {
  Stage stage(with_snap());
  part(stage).X_WB = place_in(stage);
  stage.run(0.3);
  ASSERT_EQ(stage.value("SNAP.placed"), 1);
  part(stage).movable = true;
  stage.run(0.3);
  EXPECT_EQ(stage.value("SNAP.placed"), 1) << "still in its place";
  part(stage).X_WB.p += Vec3(0.2, 0, 0);
  stage.tick();
  EXPECT_EQ(stage.value("SNAP.placed"), 0);
  EXPECT_TRUE(part(stage).movable);
}

constexpr double kPull_n = 2, kPullFrom_m = 0.2;

/// The same with a pull, and PART in a hand. Nothing moves it but the test.
struct PullStage : Stage {
  PullStage() : Stage(pulling()) {
    appear(0, hand::HandKind::one_point);
    user().grasp.active = true;
    user().grasp.body = BodyId(1);
  }
  static state::WorldDescription pulling() {
    state::WorldDescription world = with_snap();
    world.agents[0].parameters["pull"] = number({kPull_n});
    world.agents[0].parameters["pullFrom"] = number({kPullFrom_m});
    return world;
  }
  /// The force of a tick in which PART is so far from its place, and turned too far for the snap to take it.
  Vec3 force_W(const Vec3& off_W) {
    for (state::BodyState& body : state->bodies)
      body.load_W = {};
    const Pose X_WT = place_in(*this);
    part(*this).X_WB = {X_WT.p + off_W, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitX())) * X_WT.R};
    tick();
    return part(*this).load_W.f;
  }
};

RC_GTEST_PROP(Pull, IsTheGradientOfAPotentialWithinItsReachAndItsLimit, ()) {
  PullStage stage;
  const auto potential_j = [](const Vec3& off_W) {
    const double left = std::max(0.0, 1 - off_W.squaredNorm() / (kPullFrom_m * kPullFrom_m));
    return -25 * std::sqrt(5.0) / 96 * kPull_n * kPullFrom_m * left * left * left;
  };
  const auto part_of_reach = [] { return 0.0015 * *rc::gen::inRange(-100, 101); };
  const Vec3 off_W(part_of_reach(), part_of_reach(), part_of_reach());
  const Vec3 f_W = stage.force_W(off_W);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step_W = 1e-6 * Vec3::Unit(axis);
    const double slope_n = (potential_j(off_W + step_W) - potential_j(off_W - step_W)) / 2e-6;
    RC_ASSERT(std::abs(f_W[axis] + slope_n) < 1e-5);
  }
  RC_ASSERT(f_W.norm() <= kPull_n + 1e-12);
  RC_ASSERT((f_W.norm() > 0) == (off_W.norm() > 0 && off_W.norm() < kPullFrom_m));
  // The other body gets the opposite, and the pair turns nothing.
  const Wrench& on_crank = stage.state->bodies[2].load_W;
  const Wrench& on_part = part(stage).load_W;
  const Vec3 arm_W = part(stage).X_WB.p - stage.state->bodies[2].X_WB.p;
  RC_ASSERT((on_crank.f + on_part.f).norm() == 0);
  RC_ASSERT((on_crank.t + on_part.t + arm_W.cross(on_part.f)).norm() < 1e-12);
}

TEST(Pull, IsAsStrongAsTheAuthorSaysAndActsOnWhatAHandCarriesAlone) {
  const Vec3 strongest_W(kPullFrom_m / std::sqrt(5.0), 0, 0);
  PullStage stage;
  EXPECT_NEAR(stage.force_W(strongest_W).x(), -kPull_n, 1e-9);
  stage.state->agent_enabled[0] = 0;
  EXPECT_EQ(stage.force_W(strongest_W).norm(), 0) << "the snap is off";
  stage.state->agent_enabled[0] = 1;
  part(stage).movable = false;
  EXPECT_EQ(stage.force_W(strongest_W).norm(), 0) << "the step holds it still";
  part(stage).movable = true;
  stage.user().grasp.active = false;
  EXPECT_EQ(stage.force_W(strongest_W).norm(), 0) << "nobody holds it";
}

TEST(Pull, RefusesWhatWouldShakeOrNeverBegin) {
  state::WorldDescription world = PullStage::pulling();
  world.bodies[1].effort_scale = 1e-4;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("pull"), {"'PART'", "too light"}));
  const Error error = error_of(world);
  const double advised_n = std::stod(error.remedy.substr(error.remedy.find_first_of("0123456789")));
  world.agents[0].parameters["pull"] = number({advised_n});
  EXPECT_TRUE(error_of(world).remedy.empty()) << error.remedy;
  world = PullStage::pulling();
  world.agents[0].parameters["pullFrom"] = number({kTolerance_m});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("pullFrom"), {"tolerance"}));
}

TEST(Snap, RefusesWhatCannotBe) {
  state::WorldDescription world = with_snap();
  world.agents[0].parameters["object"] = text({"FRAME"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("object"), {"'FRAME'"}));
  world = with_snap();
  world.agents[0].parameters["into"] = text({"PART"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("into"), {"'object'", "'into'"}));
  world = with_snap();
  world.agents[0].parameters["rotation"] = number({0, 0, 0, 1});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("rotation")));
  world = with_snap();
  world.agents[0].parameters.erase("tolerance");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, world.agents[0].line, {"'tolerance'"}));
}

}  // namespace
}  // namespace mechane::agents::test
