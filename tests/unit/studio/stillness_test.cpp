// Why bodies stand still: each reason where it holds, and none where it does not.
#include "client-sdk/studio/view/stillness.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mechane::studio {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Texts = std::vector<std::string>;

/// A ball of 0.5 kg on a table, which hands may take, and two steps.
class StillnessTest : public testing::Test {
 protected:
  StillnessTest() {
    add_body("TABLE").fixed = true;
    state::BodyDescription& ball = add_body("BALL");
    ball.mass_kg = 0.5;
    ball.graspable = true;
    add_agent("HOLD", "simulation.grasp");
    world_.activities.emplace_back().name = "use";
    for (const char* name : {"first", "second"}) {
      state::StepDescription step;
      step.name = name;
      step.activity = ActivityId(0);
      world_.steps.push_back(step);
    }
    seen_.step = "first";
    seen_.enabled_agents = {"HOLD"};
  }

  state::BodyDescription& add_body(const std::string& name) {
    state::BodyDescription& body = world_.bodies.emplace_back();
    body.name = name;
    seen_.X_WB.emplace_back();
    seen_.visible.push_back(1);
    seen_.moves.push_back(0);
    return body;
  }
  state::ComponentDescription& add_agent(const std::string& name, const std::string& type) {
    state::ComponentDescription& agent = world_.agents.emplace_back();
    agent.name = name;
    agent.type = type;
    return agent;
  }
  state::BodyOverride& change(std::size_t step, std::size_t body) {
    state::BodyOverride& change = world_.steps[step].bodies.emplace_back();
    change.body = BodyId(body);
    return change;
  }
  std::vector<StillReason> reasons(const std::string& def = "BALL") const {
    for (const StillBody& body : still_bodies(world_, seen_))
      if (body.def == def) return body.reasons;
    return {};
  }
  Texts kinds(const std::string& def = "BALL") const {
    Texts kinds;
    for (const StillReason& reason : reasons(def))
      kinds.push_back(reason.kind);
    return kinds;
  }

  state::WorldDescription world_;
  SeenWorld seen_;
};

TEST_F(StillnessTest, ABodyThatHandsCanTakeHasNoReason) {
  EXPECT_THAT(still_bodies(world_, seen_), IsEmpty());
}

TEST_F(StillnessTest, WhatMovesIsNotAmongThem) {
  seen_.visible[1] = 0;
  EXPECT_THAT(kinds(), ElementsAre("hidden"));
  seen_.moves[1] = 1;
  EXPECT_THAT(still_bodies(world_, seen_), IsEmpty());
}

TEST_F(StillnessTest, EachReasonHasWordsInBothLanguagesAndAWayOut) {
  seen_.visible[1] = 0;
  seen_.X_WB[1].p.y() = -11;
  seen_.enabled_agents.clear();
  change(0, 1).movable = false;
  EXPECT_THAT(kinds(), ElementsAre("hidden", "fell", "fixed", "off"));
  for (const StillReason& reason : reasons()) {
    EXPECT_EQ(reason.text.size(), 2U) << reason.kind;
    EXPECT_EQ(reason.remedy.size(), 2U) << reason.kind;
    EXPECT_FALSE(reason.path.empty()) << reason.kind;
  }
}

TEST_F(StillnessTest, AStepThatHoldsABodyStillIsTold) {
  change(0, 1).movable = false;
  EXPECT_THAT(kinds(), ElementsAre("fixed"));
  EXPECT_EQ(reasons()[0].path, "activities/use/steps/first/object:BALL/movable");
}

TEST_F(StillnessTest, WhatOtherStepsMayHaveChangedIsNotGuessed) {
  change(1, 1).movable = false;
  change(1, 1).graspable = false;
  EXPECT_THAT(kinds(), IsEmpty());
  seen_.step = "second";
  EXPECT_THAT(kinds(), ElementsAre("fixed", "not_graspable"));
}

TEST_F(StillnessTest, ABodyThatEventsMoveIsHeldUntilAStepFreesIt) {
  world_.bodies[1].driven = true;
  EXPECT_THAT(kinds(), ElementsAre("fixed"));
  change(0, 1).movable = true;
  EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(StillnessTest, AFixedBodyIsToldOnlyWhereHandsAreToTakeIt) {
  world_.bodies[0].graspable = true;
  EXPECT_THAT(kinds("TABLE"), ElementsAre("fixed"));
  EXPECT_EQ(reasons("TABLE")[0].path, "TABLE");
}

TEST_F(StillnessTest, AGraspThatIsOffInTheStepIsTold) {
  seen_.enabled_agents.clear();
  EXPECT_THAT(kinds(), ElementsAre("off"));
  EXPECT_EQ(reasons()[0].path, "activities/use/steps/first/enable");
  EXPECT_THAT(reasons()[0].text.at("en"), HasSubstr("HOLD"));
}

TEST_F(StillnessTest, ABodyThatNoHandMayTakeIsTold) {
  world_.bodies[1].graspable = false;
  EXPECT_THAT(kinds(), ElementsAre("not_graspable"));
  EXPECT_EQ(reasons()[0].path, "BALL/mechane:haptic/graspable");
  change(0, 1).graspable = false;
  EXPECT_EQ(reasons()[0].path, "activities/use/steps/first/object:BALL/graspable");
  world_.steps[0].bodies.clear();
  world_.bodies[1].graspable = true;
  world_.agents[0].parameters["bodies"] = Texts{"TABLE"};
  EXPECT_THAT(kinds(), ElementsAre("not_graspable"));
  EXPECT_EQ(reasons()[0].path, "agents/HOLD/bodies");
  EXPECT_THAT(reasons()[0].remedy.at("en"), HasSubstr("HOLD"));
  world_.agents.clear();
  EXPECT_EQ(reasons()[0].path, "agents");
}

TEST_F(StillnessTest, ARatchetThatIsOnLetsItGoOneWayOnly) {
  state::JointDescription axle;
  axle.name = "AXLE";
  axle.body1 = BodyId(0);
  axle.body2 = BodyId(1);
  world_.joints.push_back(axle);
  add_agent("PAWL", "geometry.ratchet").parameters["joint"] = Texts{"AXLE"};
  EXPECT_THAT(kinds(), IsEmpty());
  seen_.enabled_agents.push_back("PAWL");
  EXPECT_THAT(kinds(), ElementsAre("one_way"));
  EXPECT_EQ(reasons()[0].path, "agents/PAWL");
  world_.bodies[1].graspable = false;
  EXPECT_THAT(kinds(), ElementsAre("not_graspable")) << "what is told first explains enough";
}

TEST_F(StillnessTest, WhatARopeMovesNeedsNoHandAndWantsTheRopeOn) {
  world_.bodies[1].graspable = false;
  add_agent("ROPE", "geometry.rope").parameters["bodies"] = Texts{"TABLE", "BALL"};
  EXPECT_THAT(kinds(), ElementsAre("off"));
  EXPECT_THAT(reasons()[0].text.at("el"), HasSubstr("ROPE"));
  seen_.enabled_agents.push_back("ROPE");
  EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(StillnessTest, AGearOnItsJointDrivesABody) {
  world_.bodies[1].graspable = false;
  state::JointDescription& axle = world_.joints.emplace_back();
  axle.name = "AXLE";
  axle.body1 = BodyId(0);
  axle.body2 = BodyId(1);
  add_agent("GEAR", "geometry.gear").parameters["joint2"] = Texts{"AXLE"};
  EXPECT_THAT(kinds(), ElementsAre("off"));
}

TEST_F(StillnessTest, AWeightOverTheGripsForceIsTold) {
  world_.bodies[1].mass_kg = 2;
  EXPECT_THAT(kinds(), ElementsAre("heavy"));
  EXPECT_THAT(reasons()[0].text.at("en"), testing::AllOf(HasSubstr("19.6 N"), HasSubstr("12.0 N")));
  world_.bodies[1].effort_scale = 0.5;
  EXPECT_THAT(kinds(), IsEmpty());
  world_.agents[0].parameters["forceLimit"] = std::vector<double>{5};
  EXPECT_THAT(kinds(), ElementsAre("heavy"));
  state::JointDescription& axle = world_.joints.emplace_back();
  axle.body1 = BodyId(0);
  axle.body2 = BodyId(1);
  EXPECT_THAT(kinds(), IsEmpty()) << "a joint bears it";
}

TEST_F(StillnessTest, ASnapHoldsWhatIsInItsPlace) {
  auto& snap = add_agent("SNAP", "geometry.snap");
  snap.parameters["object"] = Texts{"BALL"};
  snap.parameters["into"] = Texts{"TABLE"};
  snap.parameters["position"] = std::vector<double>{0, 0.5, 0};
  EXPECT_THAT(kinds(), IsEmpty());
  seen_.X_WB[0].p.x() = 2;
  seen_.X_WB[1].p = Vec3(2, 0.5, 0);
  EXPECT_THAT(kinds(), ElementsAre("snapped"));
  EXPECT_EQ(reasons()[0].path, "agents/SNAP");
  seen_.X_WB[1].R = Quat(Eigen::AngleAxisd(1, Vec3::UnitY()));
  EXPECT_THAT(kinds(), IsEmpty());
  snap.parameters["axis"] = std::vector<double>{0, 1, 0};
  EXPECT_THAT(kinds(), ElementsAre("snapped")) << "any rotation about its axis is right";
}

TEST_F(StillnessTest, ABodyFarBelowItsPlaceFell) {
  world_.bodies[1].X_WB.p.y() = 1;
  seen_.X_WB[1].p.y() = -9.5;
  EXPECT_THAT(kinds(), ElementsAre("fell"));
  EXPECT_THAT(reasons()[0].text.at("en"), HasSubstr("10 m"));
  change(0, 1).X_WB = Pose{Vec3(0, -5, 0), Quat::Identity()};
  EXPECT_THAT(kinds(), IsEmpty()) << "the step puts it lower";
}

TEST_F(StillnessTest, AWorldThatIsNotSeenYetHasNone) {
  seen_.moves.clear();
  seen_.visible[1] = 0;
  EXPECT_THAT(still_bodies(world_, seen_), IsEmpty());
}

}  // namespace
}  // namespace mechane::studio
