// Vitruvius' odometer, played by its own visits; and what fails, and where, once something is wrong with it.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

const test::Exhibit& odometer() {
  static const test::Exhibit kExhibit("odometer");
  return kExhibit;
}

TEST(OdometerVisits, Constructing) {
  const test::PlayedVisit visit = odometer().play("constructing");
  EXPECT_TRUE(visit.done) << visit;
  std::cout << visit;
}
TEST(OdometerVisits, MistakesConstructing) {
  const test::PlayedVisit visit = odometer().play("mistakes-construct");
  EXPECT_TRUE(visit.done) << visit;
  std::cout << visit;
}
TEST(OdometerVisits, Pushing) {
  test::PlayOptions options;
  const BodyId pebble = odometer().description().find_body("PEBBLE_1");
  options.watch = [&, n = 0](const state::WorldState& state) mutable {
    if (state[pebble].movable && n++ % 20 == 0 && n < 1600) std::cout << state.tick << ": " << state[pebble].X_WB.p.transpose() << "\n";
  };
  const test::PlayedVisit visit = odometer().play("pushing", options);
  EXPECT_TRUE(visit.done) << visit;
  std::cout << visit;
}
TEST(OdometerVisits, MistakesPushing) {
  const test::PlayedVisit visit = odometer().play("mistakes-use");
  EXPECT_TRUE(visit.done) << visit;
  std::cout << visit;
}
}  // namespace
}  // namespace mechane
