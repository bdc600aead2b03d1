#include "client-sdk/visitor/grasp_reason.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mechane::visitor {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GraspReason : public testing::Test {
 protected:
  GraspReason() {
    world_.bodies.resize(2);
    world_.bodies[0].name = "FRAME";
    world_.bodies[0].fixed = true;
    world_.bodies[1].name = "SHAFT";
    world_.bodies[1].graspable = true;
    state::ComponentDescription grasp;
    grasp.name = "hands";
    grasp.type = "simulation.grasp";
    grasp.parameters["bodies"] = std::vector<std::string>{"SHAFT"};
    world_.agents = {grasp};
    world_.steps.resize(2);
    world_.steps[0].name = "look";
    world_.steps[1].name = "turn";
  }
  [[nodiscard]] std::string why(int body = 1, int step = 1) const {
    FailedGrasp grasp = grasp_;
    grasp.body = BodyId(static_cast<std::size_t>(body));
    return why_not_grasped(grasp, world_, StepId(static_cast<std::size_t>(step)), enabled_);
  }
  state::BodyOverride& change(std::size_t step) {
    state::BodyOverride& change = world_.steps[step].bodies.emplace_back();
    change.body = BodyId(1);
    return change;
  }

  state::WorldDescription world_;
  std::vector<std::string> enabled_{"hands"};
  FailedGrasp grasp_{BodyId(1), 0.25, false};
};

TEST_F(GraspReason, WhatCannotBeTakenAtAll) {
  EXPECT_THAT(why(0), HasSubstr("FRAME is fixed"));
  world_.bodies[1].graspable = false;
  EXPECT_THAT(why(), AllOf(HasSubstr("SHAFT is not graspable"), HasSubstr("'turn'")));
  world_.bodies[1].graspable = true;
  world_.agents[0].parameters["bodies"] = std::vector<std::string>{"FRAME"};
  EXPECT_THAT(why(), HasSubstr("no agent lets hands take SHAFT"));
}

TEST_F(GraspReason, WhatTheStepForbids) {
  enabled_ = {"other"};
  EXPECT_THAT(why(), AllOf(HasSubstr("'hands'"), HasSubstr("is disabled in step 'turn'")));
  enabled_ = {"hands"};
  change(1).graspable = false;
  EXPECT_THAT(why(), HasSubstr("not graspable in step 'turn'"));
  EXPECT_THAT(why(1, 0), HasSubstr("felt nothing")) << "another step's word is not this one's";
  world_.steps[1].bodies.clear();
  change(1).movable = false;
  EXPECT_THAT(why(), HasSubstr("not movable in step 'turn'"));
}

TEST_F(GraspReason, WhereTheHandWas) {
  EXPECT_THAT(why(), AllOf(HasSubstr("felt nothing"), HasSubstr("0.250 m")));
  grasp_.touched = true;
  EXPECT_THAT(why(), AllOf(HasSubstr("touched something"), HasSubstr("SHAFT")));
}

}  // namespace
}  // namespace mechane::visitor
