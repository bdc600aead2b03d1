#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

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
    if (!visits) return {visits.error().to_string()};
    std::vector<std::string> names;
    for (const auto* visit : *visits)
      names.push_back(visit->name);
    return names;
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
  const auto list = AllOf(HasSubstr("screw.x3d"), HasSubstr("assembling (activity assemble), turning (activity use)"));
  options_.visits = {"use"};
  EXPECT_THAT(chosen().front(), AllOf(HasSubstr("no visit 'use'"), list));
  options_.visits.clear();
  options_.activities = {"turning"};
  EXPECT_THAT(chosen().front(), AllOf(HasSubstr("'turning'"), list));
  world_.visits.clear();
  EXPECT_THAT(chosen().front(), HasSubstr("no visit to play"));
}

}  // namespace
}  // namespace mechane::visitor
