#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/visitor/visit_session.hpp"
#include "tests/support/error_like.hpp"

namespace mechane::visitor {
namespace {

using test::is_error;
using testing::ElementsAre;

class VisitChoice : public testing::Test {
 protected:
  VisitChoice() {
    world_.activities.resize(2);
    world_.activities[0].name = "assemble";
    world_.activities[1].name = "use";
    world_.visits = {
        {"assembling", ActivityId(0), {}}, {"turning", ActivityId(1), {}}, {"dropping", ActivityId(1), {}}};
    options_.scenario = "screw.x3d";
  }
  [[nodiscard]] std::vector<std::string> chosen() const {
    const auto visits = choose_visits(options_, world_);
    if (!visits) return {"refused"};
    std::vector<std::string> names;
    for (const auto* visit : *visits)
      names.push_back(visit->name);
    return names;
  }

  [[nodiscard]] Error refusal() const {
    const auto visits = choose_visits(options_, world_);
    return visits ? Error{} : visits.error();
  }

  state::WorldDescription world_;
  VisitOptions options_;
};

TEST_F(VisitChoice, AVisitIsPlayedByItsName) {
  EXPECT_THAT(chosen(), ElementsAre("assembling", "turning", "dropping"));
  options_.visits = {"dropping", "assembling"};
  EXPECT_THAT(chosen(), ElementsAre("dropping", "assembling"));
  options_.visits.clear();
  options_.activities = {"use"};
  EXPECT_THAT(chosen(), ElementsAre("turning"));
}

TEST_F(VisitChoice, AnUnknownNameBringsTheListOfThoseThatThereAre) {
  const char* list = "assembling (activity assemble), turning (activity use)";
  options_.visits = {"use"};
  EXPECT_THAT(refusal(), is_error(ErrorCode::unknown_name, 0, {"screw.x3d", "visit 'use'", list}));
  options_.visits.clear();
  options_.activities = {"lifting"};
  EXPECT_THAT(refusal(), is_error(ErrorCode::unknown_name, 0, {"screw.x3d", "'lifting'", list}));
  options_.activities = {"turning"};
  EXPECT_THAT(refusal(), is_error(ErrorCode::unknown_name, 0, {"screw.x3d", "'turning'", "--visit turning"}));
  world_.visits.clear();
  EXPECT_THAT(refusal(), is_error(ErrorCode::missing, 0, {"screw.x3d"}));
}

}  // namespace
}  // namespace mechane::visitor
