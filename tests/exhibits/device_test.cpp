// Every exhibit, and whatever comes to be shipped, by a stylus of the Phantom's class, by a glove and by a hand before a camera: its visits
// are completed, those with mistakes too.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"
#include "tests/support/shipped_exhibits.hpp"
#include "tests/support/tracked_hand.hpp"

namespace mechane {
namespace {

struct Device {
  const char* name;
  client::HandKind hand;
  bool tracked = false;
};
constexpr Device kDevices[] = {{"Phantom", client::HandKind::one_point},
                               {"Glove", client::HandKind::glove},
                               {"TrackedHand", client::HandKind::glove, true}};

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
  options.device.hand = device.hand;
  if (device.tracked) {
    options.make_device = [] { return std::make_unique<test::TrackedHand>(); };
    options.player.waits_for_lag_m = 0.03;  // it sees what it does not feel
  }
  bool held = false, closed = false, touched = false;
  options.watch = [&](const state::WorldState& state) {
    const state::UserState& user = state.users[0];
    held = held || user.grasp.active;
    closed = closed || (user.grasp.active && index_bent(user) > 0.8);
    touched = touched || user.output.touches();
  };
  for (const state::VisitDescription& script : exhibit.description().visits) {
    const test::PlayedVisit visit = exhibit.play(script.name, options);
    EXPECT_TRUE(test::arrived(visit, exhibit.description())) << script.name << ": " << visit;
    for (const test::PlayedStep& step : visit.steps)
      EXPECT_LT(step.seconds, 60) << script.name << ": " << visit;
  }
  EXPECT_TRUE(touched);
  EXPECT_EQ(closed, held && device.hand == client::HandKind::glove) << "a whole hand closes around what it holds";
}

INSTANTIATE_TEST_SUITE_P(Shipped, ByDevice,
                         testing::Combine(testing::ValuesIn(test::shipped_exhibits()), testing::ValuesIn(kDevices)),
                         [](const auto& of) {
                           return test::test_name(std::get<0>(of.param) + "_" + std::get<1>(of.param).name);
                         });

}  // namespace
}  // namespace mechane
