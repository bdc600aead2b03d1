// Every exhibit, and whatever comes to be shipped, by a stylus of the Phantom's class whose forces come late, by a glove and by a hand before a camera: its visits
// are completed, those with mistakes too.
#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
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

struct Device {
  const char* name;
  haptic::VirtualChoice choice;
};
const Device kDevices[] = {
    {"LatePhantom",
     {.stylus = {.delay = 10, .hand = haptic::ArmConfig{}}}},  // on time, it plays each exhibit's own tests
    {"Glove", {.hand = client::HandKind::glove}},
    {"TrackedHand", {.hand = client::HandKind::glove, .tracked = true}}};

void PrintTo(const Device& device, std::ostream* out) {
  *out << device.name;
}

/// How far the index finger's first joint is bent, rad.
double index_bent(const state::UserState& user) {
  return user.sample.joints[hand::kFingerJoints + 1];
}

class ByDevice : public testing::TestWithParam<std::tuple<std::string, Device>> {};

TEST_P(ByDevice, EveryVisitIsCompleted) {
  const auto& [name, device] = GetParam();
  const test::Exhibit exhibit(name);
  test::PlayOptions options;
  options.device = device.choice;
  bool held = false, closed = false, touched = false;
  options.watch = [&](const state::WorldState& state) {
    const state::UserState& user = state.users[0];
    held = held || user.grasp.active;
    closed = closed || (user.grasp.active && index_bent(user) > 0.8);
    touched = touched || user.output.touches();
  };
  for (const state::VisitDescription& script : exhibit.description().visits) {
    const test::PlayedVisit visit = exhibit.play(script.name, options);
    EXPECT_TRUE(arrived(visit, exhibit.description())) << script.name << ": " << visit;
    for (const test::PlayedStep& step : visit.steps)
      EXPECT_LT(step.seconds, 60) << script.name << ": " << visit;
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(closed, held && device.choice.hand == client::HandKind::glove)
      << "a whole hand closes around what it holds";
}

INSTANTIATE_TEST_SUITE_P(Shipped, ByDevice,
                         testing::Combine(testing::ValuesIn(shipped_exhibits()), testing::ValuesIn(kDevices)),
                         [](const auto& test) {
                           std::string name = std::get<0>(test.param) + "_" + std::get<1>(test.param).name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace mechane
