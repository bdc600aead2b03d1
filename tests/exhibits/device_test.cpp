// Every exhibit, and whatever comes to be shipped, by a stylus of the Phantom's class whose forces come late and whose motors bear little
// for long, by a glove and by a hand before a camera: its visits are completed, those with mistakes too.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"
#include "tests/support/shipped_exhibits.hpp"

namespace mechane {
namespace {

struct Device {
  const char* name;
  haptic::VirtualChoice choice;
};
constexpr double kTouchContinuous_n = 0.88;
const Device kDevices[] = {
    {"LatePhantom",
     {.stylus = {.delay = 10,
                 .hand = haptic::ArmConfig{},
                 .continuous_n = kTouchContinuous_n}}},  // on time, it plays each exhibit's own tests
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
  EXPECT_FALSE(exhibit.description().visits.empty());
  for (const state::VisitDescription& script : exhibit.description().visits) {
    const test::PlayedVisit visit = exhibit.play(script.name, options);
    EXPECT_TRUE(test::arrived(visit, exhibit.description())) << script.name << ": " << visit;
    for (const test::PlayedStep& step : visit.steps)
      EXPECT_LT(step.seconds, 60) << script.name << ": " << visit;
    const bool good = !script.name.starts_with("mistakes");
    EXPECT_LT(visit.warm_share, good ? 0.01 : 1) << script.name << " asks for more than a Touch bears: " << visit;
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(closed, held && device.choice.hand == client::HandKind::glove)
      << "a whole hand closes around what it holds";
}

INSTANTIATE_TEST_SUITE_P(Shipped, ByDevice,
                         testing::Combine(testing::ValuesIn(test::shipped_exhibits()), testing::ValuesIn(kDevices)),
                         [](const auto& of) {
                           return test::test_name(std::get<0>(of.param) + "_" + std::get<1>(of.param).name);
                         });

}  // namespace
}  // namespace mechane
