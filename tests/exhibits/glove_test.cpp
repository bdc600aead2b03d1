// Every exhibit, and whatever comes to be shipped, by a whole hand: its visits that are to go well do.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane {
namespace {

std::vector<std::string> shipped_exhibits() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const fs::directory_entry& folder : fs::directory_iterator(mechane::test::source_folder() / "scenarios")) {
    const std::string name = folder.path().filename().string();
    if (fs::exists(folder.path() / (name + ".x3d"))) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// Through with its activity, or at a step that sends the visitor on.
bool arrived(const test::PlayedVisit& visit, const state::WorldDescription& world) {
  return visit.done || std::ranges::any_of(visit.steps, [&](const test::PlayedStep& step) {
           return !world.steps[world.find_step(step.name).index()].opens.empty();
         });
}

class ByGlove : public testing::TestWithParam<std::string> {};

TEST_P(ByGlove, AVisitThatShouldGoWellDoes) {
  const test::Exhibit exhibit(GetParam());
  std::size_t played = 0;
  for (const state::VisitDescription& script : exhibit.description().visits) {
    if (script.name.starts_with("mistakes-")) continue;
    ++played;
    const test::PlayedVisit visit = exhibit.play_with_glove(script.name);
    EXPECT_TRUE(arrived(visit, exhibit.description())) << script.name << ": " << visit;
    for (const test::PlayedStep& step : visit.steps)
      EXPECT_LT(step.seconds, 60) << script.name << ": " << visit;
  }
  EXPECT_GE(played, 1u);
}

INSTANTIATE_TEST_SUITE_P(Shipped, ByGlove, testing::ValuesIn(shipped_exhibits()), [](const auto& test) {
  std::string name = test.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace mechane
