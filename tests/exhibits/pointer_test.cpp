// Every exhibit, and whatever comes to be shipped, by a person with a mouse before the display's picture.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/pointer_play.hpp"
#include "tests/support/shipped_exhibits.hpp"

namespace mechane {
namespace {

/// A script in which the visitor makes no mistakes.
bool goes_well(const state::VisitDescription& script) {
  return !script.name.starts_with("mistakes-");
}

class ByPointer : public testing::TestWithParam<std::string> {};

TEST_P(ByPointer, EveryVisitIsCompleted) {
  const test::Exhibit exhibit(GetParam());
  const auto shown = test::show_exhibit(exhibit.description());
  test::PlayOptions options;
  options.make_person = [&](const auto& description, const auto& visit) {
    return test::make_pointer_person(*shown, description, visit);
  };
  EXPECT_FALSE(exhibit.description().visits.empty());
  for (const state::VisitDescription& script : exhibit.description().visits) {
    const test::PlayedVisit visit = exhibit.play(script.name, options);
    EXPECT_TRUE(test::arrived(visit, exhibit.description())) << script.name << ": " << visit;
    if (goes_well(script)) {
      EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << script.name << ": " << visit;
    }
    for (const test::PlayedStep& step : visit.steps)
      EXPECT_LT(step.seconds, 60) << script.name << ": " << visit;
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, ByPointer, testing::ValuesIn(test::shipped_exhibits()),
                         [](const auto& of) { return test::test_name(of.param); });

}  // namespace
}  // namespace mechane
