// X3D's TimeSensor, interpolators, dampers, sensors and ROUTEs, in the world's time.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/agents/x3d_stage.hpp"

namespace mechane::agents::test {
namespace {

constexpr const char* kMover = "<Transform DEF='MOVER'><Shape><Box/></Shape></Transform>";

TEST(TimeSensor, RunsInCyclesOfTheWorldsTime) {
  EXPECT_TRUE(rc::check([] {
    const double cycle_s = *rc::gen::inRange(1, 3000) / 1000.0;
    X3dStage stage(fmt::format("<TimeSensor DEF='T' cycleInterval='{}' loop='true'/>", cycle_s));
    for (int i = 0; i < 50; ++i) {
      stage.run_to(stage.time_s() + *rc::gen::inRange(1, 200) / 1000.0);
      const double cycles = stage.time_s() / cycle_s;
      const double off = cycles - stage.value("T.fraction_changed");
      RC_ASSERT(std::abs(off - std::round(off)) < 1e-6);
      RC_ASSERT(stage.value("T.fraction_changed") > 0);
      RC_ASSERT(stage.value("T.cycleTime") <= stage.time_s() &&
                stage.value("T.cycleTime") > stage.time_s() - cycle_s - 0.0011);
      RC_ASSERT(std::abs(stage.value("T.elapsedTime") - stage.time_s()) < 1e-9);
    }
  }));
}

TEST(TimeSensor, RunsOnceFromItsStartUnlessThatIsPastOrStopped) {
  X3dStage stage(
      "<TimeSensor DEF='IDLE'/><TimeSensor DEF='ONCE' startTime='0.5' cycleInterval='0.25'/>"
      "<TimeSensor DEF='CUT' startTime='0.5' stopTime='0.6' cycleInterval='0.25'/>"
      "<TimeSensor DEF='OFF' enabled='false' loop='true'/>");
  stage.run_to(0.499);
  EXPECT_EQ(stage.value("ONCE.isActive"), 0);
  stage.run_to(0.5);
  EXPECT_EQ(stage.value("ONCE.isActive"), 1);
  EXPECT_EQ(stage.value("ONCE.fraction_changed"), 0);
  stage.run_to(0.55);
  EXPECT_NEAR(stage.value("ONCE.fraction_changed"), 0.2, 1e-9);
  stage.run_to(2);
  EXPECT_EQ(stage.value("ONCE.isActive"), 0);
  EXPECT_EQ(stage.value("ONCE.fraction_changed"), 1);
  EXPECT_NEAR(stage.value("CUT.fraction_changed"), 0.4, 1e-9);
  EXPECT_EQ(stage.value("CUT.isActive"), 0);
  EXPECT_EQ(stage.value("IDLE.time"), 0) << "X3D's default start is past";
  EXPECT_EQ(stage.value("OFF.isActive"), 0);
}

TEST(TimeSensor, PausesWhileAHandIsNear) {
  X3dStage stage("<TimeSensor DEF='T' cycleInterval='10' loop='true'/><ProximitySensor DEF='NEAR' size='1 1 1'/>" +
                 route("NEAR.enterTime", "T.pauseTime") + route("NEAR.exitTime", "T.resumeTime"));
  stage.run_to(1);
  stage.put_hand(Vec3(0.4, 0, 0));
  stage.run_to(1.5);
  EXPECT_EQ(stage.value("T.isPaused"), 1);
  EXPECT_NEAR(stage.value("T.elapsedTime"), 1, 0.0011);
  stage.put_hand(Vec3(0.6, 0, 0));
  stage.run_to(3);
  EXPECT_EQ(stage.value("T.isPaused"), 0);
  EXPECT_NEAR(stage.value("T.elapsedTime"), 2.5, 1e-9);
}

/// Of a row of filters of first order after a step of 1.
double step_answer(int order, double t_over_tau) {
  double left = 0, term = 1;
  for (int j = 0; j < order; ++j) {
    left += term;
    term *= t_over_tau / (j + 1);
  }
  return 1 - std::exp(-t_over_tau) * left;
}

TEST(Dampers, FollowTheirClosedForm) {
  EXPECT_TRUE(rc::check([] {
    const int order = *rc::gen::inRange(0, 6);
    const double tau_s = *rc::gen::inRange(1, 2000) / 1000.0;
    X3dStage stage(fmt::format("<PositionDamper DEF='P' order='{0}' tau='{1}' initialDestination='5 -2 0'/>"
                               "<OrientationDamper DEF='O' order='{0}' tau='{1}' initialValue='0 0 1 0.2' "
                               "initialDestination='0 0 1 2.2'/><ScalarDamper DEF='S' order='{0}' tau='{1}' "
                               "initialDestination='-3'/><Transform DEF='MOVER'><Shape><Box/></Shape></Transform>",
                               order, tau_s) +
                   route("P.value_changed", "MOVER.translation") + route("O.value_changed", "MOVER.rotation"));
    for (const double at_s : {0.01, 0.1, 0.5, 2.0, 10.0}) {
      stage.run_to(at_s);
      const double answer = order == 0 ? 1 : step_answer(order, at_s / tau_s);
      RC_ASSERT((stage.pose("MOVER").p - answer * Vec3(5, -2, 0)).norm() < 1e-5);
      RC_ASSERT((rotation_vector(stage.pose("MOVER").R) - (0.2 + 2 * answer) * Vec3::UnitZ()).norm() < 1e-5);
      RC_ASSERT(std::abs(stage.value("S.value_changed") + 3 * answer) < 1e-5);
    }
  }));
}

TEST(Dampers, RestAtTheirDestinationAndStartAgain) {
  X3dStage stage(
      "<PositionDamper DEF='P' tau='0.05' initialDestination='1 0 0'/><ProximitySensor DEF='NEAR' size='9 9 9'/>" +
      route("NEAR.position_changed", "P.set_destination"));
  stage.tick();
  EXPECT_EQ(stage.value("P.isActive"), 1);
  stage.run_to(2);
  EXPECT_EQ(stage.value("P.isActive"), 0);
  EXPECT_EQ(stage.value("P.value_changed.x"), 1);
  stage.put_hand(Vec3(0, 2, 0));
  stage.run_to(2.01);
  EXPECT_EQ(stage.value("P.isActive"), 1);
  stage.run_to(4);
  EXPECT_EQ(stage.value("P.value_changed.y"), 2);
}

TEST(Interpolators, GoStraightFromKeyToKey) {
  EXPECT_TRUE(rc::check([] {
    auto keys = *rc::gen::container<std::vector<int>>(5, rc::gen::inRange(0, 100));
    const auto values = *rc::gen::container<std::vector<int>>(5, rc::gen::inRange(-100, 100));
    std::sort(keys.begin(), keys.end());
    std::string key, scalar, vector, turn;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      key += fmt::format("{} ", keys[i] / 100.0);
      scalar += fmt::format("{} ", values[i]);
      vector += fmt::format("{} 1 0 ", values[i]);
      turn += fmt::format("0 1 0 {} ", values[i] / 100.0);
    }
    X3dStage stage(fmt::format("<TimeSensor DEF='T' loop='true'/><ScalarInterpolator DEF='S' key='{0}' keyValue='{1}'/>"
                               "<PositionInterpolator DEF='P' key='{0}' keyValue='{2}'/>"
                               "<OrientationInterpolator DEF='O' key='{0}' keyValue='{3}'/>{4}",
                               key, scalar, vector, turn, kMover) +
                   route("T.fraction_changed", "S.set_fraction") + route("T.fraction_changed", "P.set_fraction") +
                   route("T.fraction_changed", "O.set_fraction") + route("P.value_changed", "MOVER.translation") +
                   route("O.value_changed", "MOVER.set_rotation"));
    for (int i = 0; i < 20; ++i) {
      stage.run_to(stage.time_s() + *rc::gen::inRange(1, 100) / 1000.0);
      const double at = 100 * stage.value("T.fraction_changed");
      // Of equal keys the last holds, and a rounding error decides at a key itself.
      if (std::ranges::any_of(keys, [&](int one) { return std::abs(one - at) < 1e-4; })) continue;
      std::size_t n = 0;
      while (n + 1 < keys.size() && keys[n + 1] < at)
        ++n;
      double expected = values[n];
      if (at < keys[0]) expected = values[0];
      if (at > keys[0] && n + 1 < keys.size())
        expected += (values[n + 1] - values[n]) * (at - keys[n]) / (keys[n + 1] - keys[n]);
      RC_ASSERT(std::abs(stage.value("S.value_changed") - expected) < 1e-6);
      RC_ASSERT(std::abs(stage.pose("MOVER").p.x() - expected) < 1e-6);
      RC_ASSERT(std::abs(rotation_vector(stage.pose("MOVER").R).y() - expected / 100) < 1e-6);
    }
  }));
}

/// A hand starts a clock, whose fraction moves and turns two things; all branch out.
std::vector<std::string> branching() {
  return {route("NEAR.enterTime", "T.startTime"),        route("T.fraction_changed", "P.set_fraction"),
          route("T.fraction_changed", "O.set_fraction"), route("P.value_changed", "D.set_destination"),
          route("P.value_changed", "MOVER.translation"), route("O.value_changed", "MOVER.rotation"),
          route("D.value_changed", "SLOW.translation"),  route("MOVER.rotation_changed", "SLOW.rotation"),
          route("NEAR.isActive", "TOGGLE.set_boolean"),  route("NEAR.isActive", "FILTER.set_boolean")};
}

constexpr const char* kBranchingNodes =
    "<ProximitySensor DEF='NEAR' size='1 1 1'/><TimeSensor DEF='T' cycleInterval='0.5'/><PositionInterpolator DEF='P' "
    "key='0 1' keyValue='0 3 0 0 0 4'/><OrientationInterpolator DEF='O' key='0 1' keyValue='0 1 0 0 0 1 0 1'/>"
    "<PositionDamper DEF='D' tau='0.1'/><Transform DEF='SLOW'><Shape><Box/></Shape></Transform>"
    "<BooleanToggle DEF='TOGGLE'/><BooleanFilter DEF='FILTER'/><Transform "
    "DEF='MOVER'><Shape><Box/></Shape></Transform>";

std::string joined(const std::vector<std::string>& routes) {
  return fmt::format("{}", fmt::join(routes, ""));
}

TEST(Routes, BringAnEventToAllInTheSameTick) {
  X3dStage stage(kBranchingNodes + joined(branching()));
  stage.run_to(0.2);
  stage.put_hand(Vec3::Zero());
  stage.tick();
  EXPECT_EQ(stage.value("T.startTime"), stage.time_s());
  EXPECT_EQ(stage.value("T.isActive"), 1);
  EXPECT_EQ(stage.pose("MOVER").p, Vec3(0, 3, 0));
  EXPECT_EQ(stage.value("TOGGLE.toggle"), 1);
  EXPECT_EQ(stage.value("FILTER.inputTrue"), 1);
  EXPECT_EQ(stage.value("FILTER.inputNegate"), 0);
  stage.put_hand(Vec3(2, 0, 0));
  stage.run_to(1);
  EXPECT_NEAR(stage.value("NEAR.exitTime"), 0.202, 1e-9);
  EXPECT_EQ(stage.value("TOGGLE.toggle"), 1) << "FALSE toggles nothing";
  EXPECT_EQ(stage.value("FILTER.inputNegate"), 1);
  EXPECT_LT((stage.pose("MOVER").p - Vec3(0, 0, 4)).norm(), 1e-9);
  EXPECT_LT((rotation_vector(stage.pose("SLOW").R) - Vec3(0, 1, 0)).norm(), 1e-9);
}

TEST(Routes, OrderMakesNoDifferenceWhereTheyOnlyBranch) {
  EXPECT_TRUE(rc::check([] {
    auto routes = branching();
    X3dStage one(kBranchingNodes + joined(routes));
    for (std::size_t i = routes.size() - 1; i > 0; --i)
      std::swap(routes[i], routes[*rc::gen::inRange<std::size_t>(0, i + 1)]);
    X3dStage other(kBranchingNodes + joined(routes));
    for (X3dStage* stage : {&one, &other}) {
      stage->run_to(0.1);
      stage->put_hand(Vec3::Zero());
      stage->run_to(0.4);
    }
    RC_ASSERT(state::state_hash(one.state) == state::state_hash(other.state));
  }));
}

TEST(Routes, InACircleEndInEachTick) {
  X3dStage stage(
      "<BooleanFilter DEF='A'/><BooleanFilter DEF='B'/><ProximitySensor DEF='NEAR' size='1 1 1'/><BooleanToggle "
      "DEF='END'/>" +
      route("B.inputNegate", "END.set_boolean") + route("NEAR.isActive", "A.set_boolean") +
      route("A.inputNegate", "B.set_boolean") + route("B.inputNegate", "A.set_boolean") +
      route("A.inputNegate", "A.set_boolean"));
  stage.put_hand(Vec3::Zero());
  stage.tick();
  EXPECT_EQ(stage.value("A.set_boolean"), 1) << "the first event in a tick counts";
  EXPECT_EQ(stage.value("B.inputNegate"), 1);
  stage.run_to(0.5);
  EXPECT_EQ(stage.value("B.inputNegate"), 1);
}

TEST(Routes, TriggersMakeTimesOfBooleansAndBooleansOfTimes) {
  X3dStage stage("<ProximitySensor DEF='NEAR' size='1 1 1'/><TimeTrigger DEF='TIME'/><BooleanTrigger DEF='YES'/>" +
                 route("NEAR.isActive", "TIME.set_boolean") + route("TIME.triggerTime", "YES.set_triggerTime"));
  stage.run_to(0.3);
  EXPECT_EQ(stage.value("YES.triggerTrue"), 0);
  stage.put_hand(Vec3::Zero());
  stage.run_to(0.5);
  EXPECT_NEAR(stage.value("TIME.triggerTime"), 0.301, 1e-9);
  EXPECT_EQ(stage.value("YES.triggerTrue"), 1);
}

TEST(ProximitySensor, StandsInItsTransform) {
  X3dStage stage(
      "<Transform translation='10 0 0' rotation='0 1 0 1.5707963'><ProximitySensor DEF='NEAR' center='0 0 1' size='1 1 "
      "1'/>"
      "</Transform><ProximitySensor DEF='NONE' size='0 1 1'/>");
  stage.put_hand(Vec3(11.4, 0, 0.3));
  stage.tick();
  EXPECT_EQ(stage.value("NEAR.isActive"), 1);
  EXPECT_NEAR(stage.value("NEAR.position_changed.z"), 1.4, 1e-6);
  EXPECT_NEAR(stage.value("NEAR.position_changed.x"), -0.3, 1e-6);
  EXPECT_EQ(stage.value("NONE.isActive"), 0);
  stage.state.users[0].stale = true;
  stage.tick();
  EXPECT_EQ(stage.value("NEAR.isActive"), 0);
}

std::string ball(const std::string& def, const std::string& fields) {
  return fmt::format(
      "<RigidBody DEF='{0}' containerField='bodies' {1}><CollidableShape DEF='C_{0}' containerField='geometry'><Shape "
      "containerField='shape'><Sphere/></Shape></CollidableShape></RigidBody>",
      def, fields);
}

TEST(CollisionSensor, TellsWhetherItsBodiesTouch) {
  X3dStage stage("<RigidBodyCollection>" + ball("A", "fixed='true'") + ball("B", "position='0 2 0'") +
                 ball("C", "position='0 0.2 0'") +
                 "</RigidBodyCollection><CollisionSensor DEF='HIT'><CollisionCollection containerField='collider'>"
                 "<CollidableShape USE='C_A' containerField='collidables'/><CollidableShape USE='C_B' "
                 "containerField='collidables'/></CollisionCollection></CollisionSensor>");
  state::BodyState& b = stage.state[stage.description.find_body("B")];
  for (const auto& [y, hits] : {std::pair{1.01, 0.0}, {0.98, 1.0}, {1.01, 0.0}}) {
    b.X_WB.p.y() = y;
    stage.tick();
    EXPECT_EQ(stage.value("HIT.isActive"), hits) << "C is not in the collider";
  }
}

TEST(DrivenBodies, GoWhereEventsPutThemAndTellOfIt) {
  X3dStage stage("<RigidBodyCollection>" + ball("STAGE", "fixed='true' mass='0'") + ball("FREE", "") +
                 "</RigidBodyCollection><PositionDamper DEF='AGAIN' order='0'/><TimeSensor DEF='T' loop='true' "
                 "cycleInterval='2'/><PositionInterpolator "
                 "DEF='P' key='0 1' keyValue='0 0 0 4 0 0'/><Transform translation='0 1 0'>" +
                 kMover + "</Transform>" + route("T.fraction_changed", "P.set_fraction") +
                 route("P.value_changed", "STAGE.set_position") + route("P.value_changed", "FREE.position") +
                 route("STAGE.position_changed", "AGAIN.set_destination") +
                 route("AGAIN.value_changed", "MOVER.translation"));
  const BodyId body = stage.description.find_body("STAGE");
  EXPECT_TRUE(stage.description.bodies[body.index()].driven && !stage.state[body].movable);
  stage.run_to(0.5);
  EXPECT_LT((stage.pose("STAGE").p - Vec3(1, 0, 0)).norm(), 1e-9);
  EXPECT_LT((stage.state[body].V_WB.v - Vec3(2, 0, 0)).norm(), 1e-6) << "hands feel it come";
  EXPECT_LT((stage.pose("MOVER").p - Vec3(1, 1, 0)).norm(), 1e-9) << "in its group's frame";
  EXPECT_EQ(stage.pose("FREE").p, Vec3::Zero()) << "forces move it";
}

TEST(DrivenBodies, TurnAboutTheirTransformsCentre) {
  X3dStage stage(
      "<Transform DEF='DOOR' center='1 0 0' rotation='0 1 0 0.5' translation='0 2 0'><Shape><Box/></Shape></Transform>"
      "<OrientationDamper DEF='D' order='0' initialDestination='0 1 0 1.5'/>" +
      route("D.value_changed", "DOOR.rotation"));
  // Where the hinge was, in the frame of the mesh: the centre without the first rotation, turned by it.
  const Vec3 p_W = stage.pose("DOOR").p, c(1, 0, 0);
  const Quat first(Eigen::AngleAxisd(0.5, Vec3::UnitY()));
  const Vec3 hinge = first.conjugate() * c;
  stage.run_to(0.01);
  EXPECT_EQ(p_W, Vec3(0, 2, 0));
  EXPECT_LT((stage.pose("DOOR") * hinge - (p_W + c)).norm(), 1e-9) << "the centre stands";
  EXPECT_LT((rotation_vector(stage.pose("DOOR").R) - Vec3(0, 1.5, 0)).norm(), 1e-9);
}

TEST(Events, AllocateNothingAndTakeNoMemoryWhereThereAreNone) {
  X3dStage stage(kBranchingNodes + joined(branching()));
  stage.put_hand(Vec3::Zero());
  const mechane::test::AllocationGuard guard;
  stage.run_to(1);
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_TRUE(X3dStage(kMover).state.memory.size() < 10) << "touches alone";
}

}  // namespace
}  // namespace mechane::agents::test
