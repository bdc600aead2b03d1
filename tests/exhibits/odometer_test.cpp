// Vitruvius' odometer, played by its own visits; what its drums do to each other; and what fails, and where, once something is missing.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

constexpr double kDrumTooth_rad = 2 * kPi / 400;
constexpr double kWindow_rad = 0.04;  // of the wheel, in which its tooth drives

const test::Exhibit& odometer() {
  static const test::Exhibit kExhibit("odometer");
  return kExhibit;
}

double joint_position(const state::WorldState& state, const char* joint) {
  return state[odometer().description().find_joint(joint)].position;
}

Vec3 place_of(const state::WorldState& state, const char* body) {
  return state[odometer().description().find_body(body)].X_WB.p;
}

TEST(OdometerVisits, AllPartsComeToTheirPlacesInTheirOrder) {
  const test::PlayedVisit visit = odometer().play("constructing");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  EXPECT_EQ(visit.quantities.at("parts"), 5) << visit;
  EXPECT_EQ(visit.quantities.at("too_early"), 0) << visit;
  EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  EXPECT_EQ(odometer().play("constructing").state_hash, visit.state_hash);
}

TEST(OdometerVisits, EveryFiveTurnsAPebbleComesToLieInTheVessel) {
  double first_fell_turns = 0, second_fell_turns = 0;
  Vec3 first_W, second_W, vessel_W;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const double turns = joint_position(state, "AXLE") / (2 * kPi);
    const auto fallen = [&](const char* pebble) { return state[odometer().description().find_body(pebble)].movable; };
    if (first_fell_turns == 0 && fallen("PEBBLE_1") && state.tick > 300) first_fell_turns = turns;
    if (second_fell_turns == 0 && fallen("PEBBLE_2") && state.tick > 300) second_fell_turns = turns;
    first_W = place_of(state, "PEBBLE_1");
    second_W = place_of(state, "PEBBLE_2");
    vessel_W = place_of(state, "VESSEL");
  };
  const test::PlayedVisit visit = odometer().play("pushing", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  // In the middle of the fifth and the tenth jerk, which are half a turn of the wheel before its turn is full.
  EXPECT_NEAR(first_fell_turns, 4.5, 0.5 * kWindow_rad / (2 * kPi));
  EXPECT_NEAR(second_fell_turns, 9.5, 0.5 * kWindow_rad / (2 * kPi));
  EXPECT_EQ(visit.quantities.at("distance"), 37) << visit;
  for (const Vec3& pebble_W : {first_W, second_W}) {
    EXPECT_LT((pebble_W - vessel_W).norm(), 0.09) << "it lies in the vessel: " << pebble_W.transpose();
    EXPECT_GT(pebble_W.y(), vessel_W.y() + 0.02) << "on its bottom, not in it";
  }
  EXPECT_GT((first_W - second_W).norm(), 0.03)
      << "two stones of 34 mm are not in one place, though one may just hit the other";
  EXPECT_EQ(odometer().play("pushing").state_hash, visit.state_hash);
}

TEST(OdometerVisits, OneToothATurnByJerksAndTheFlatDrumWithIt) {
  double worst_rad = 0, worst_side_rad = 0;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const double wheel = joint_position(state, "AXLE"), upright = joint_position(state, "UPRIGHT");
    const double past_middle = std::remainder(wheel - kPi, 2 * kPi);
    const double teeth = std::floor((wheel + kPi) / (2 * kPi));
    if (std::abs(past_middle) > 0.6 * kWindow_rad)
      worst_rad = std::max(worst_rad, std::abs(upright - teeth * kDrumTooth_rad));
    worst_side_rad = std::max(worst_side_rad, std::abs(joint_position(state, "LYING") - upright * 80 / 12));
  };
  const test::PlayedVisit visit = odometer().play("pushing", options);
  EXPECT_GE(visit.quantities.at("teeth"), 10) << visit;
  EXPECT_LT(worst_rad, 0.02 * kDrumTooth_rad) << "between the jerks the drum stands on a tooth";
  EXPECT_LT(worst_side_rad, 1e-3);
}

TEST(OdometerVisits, WrongPartsFirstPartsDroppedAndAWalkStillEndWell) {
  const test::PlayedVisit visit = odometer().play("mistakes-construct");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.quantities.at("too_early"), 2) << "the flat drum first, the pane before the vessel\n" << visit;
  ASSERT_GE(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.steps[1].name, "not_yet") << visit;
  EXPECT_EQ(odometer().play("mistakes-construct").state_hash, visit.state_hash);
}

TEST(OdometerVisits, BackwardsTooFastAndAWalkStillEndWell) {
  double least_turns = 0, fastest = 0;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    least_turns = std::min(least_turns, joint_position(state, "AXLE") / (2 * kPi));
    fastest = std::max(fastest, std::abs(state[odometer().description().find_joint("AXLE")].velocity));
  };
  const test::PlayedVisit visit = odometer().play("mistakes-use", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_LT(least_turns, -0.95) << visit;
  EXPECT_GT(fastest, 10) << visit;
  EXPECT_EQ(odometer().play("mistakes-use").state_hash, visit.state_hash);
}

TEST(OdometerVisits, WithoutTheOneToothTheGreatDrumStands) {
  const test::PlayedVisit visit = odometer().play_changed("pushing", [](state::WorldDescription& world) {
    test::lose(world, "TOOTH", {"HUB", "DOWELS"});
  });
  EXPECT_EQ(visit.stopped_at, "one_tooth") << visit;
  EXPECT_GT(visit.quantities.at("turns"), 10) << visit;
  EXPECT_EQ(visit.quantities.at("drum_angle"), 0) << visit;
  const test::PlayedVisit loose =
      odometer().play_changed("pushing", [](state::WorldDescription& world) { test::switch_off(world, "DOWELS"); });
  EXPECT_EQ(loose.stopped_at, "one_tooth") << "the drum with the tooth does not turn with the hub\n" << loose;
}

TEST(OdometerVisits, WithoutTheSidePegsNoPebbleFalls) {
  const test::PlayedVisit visit =
      odometer().play_changed("pushing", [](state::WorldDescription& world) { test::switch_off(world, "SIDE_PEGS"); });
  EXPECT_EQ(visit.stopped_at, "mile") << visit;
  EXPECT_GE(visit.quantities.at("teeth"), 10) << visit;
  EXPECT_EQ(visit.quantities.at("pebbles"), 0) << visit;
}

TEST(OdometerVisits, WithoutGutterOrVesselAPebbleFallsForNothing) {
  for (const char* part : {"CHANNEL", "VESSEL"}) {
    const test::PlayedVisit visit =
        odometer().play_changed("pushing", [&](state::WorldDescription& world) { test::lose(world, part); });
    EXPECT_EQ(visit.stopped_at, "mile") << part << "\n" << visit;
    EXPECT_EQ(visit.quantities.at("pebbles"), 2) << part << "\n" << visit;
  }
}

TEST(OdometerVisits, AHandWithoutForceMovesNoCart) {
  const test::PlayedVisit visit = odometer().play_changed("pushing", [](state::WorldDescription& world) {
    test::set_parameter(world, "HOLD", "forceLimit", std::vector<double>{0});
  });
  EXPECT_EQ(visit.stopped_at, "push") << visit;
  EXPECT_LT(std::abs(visit.quantities.at("turns")), 0.1) << visit;
}

TEST(OdometerVisits, APartThatIsMissingIsMissedAtItsStep) {
  // The visit goes on to the great drum, which is refused: no other part takes the first one's place.
  const test::PlayedVisit first =
      odometer().play_changed("constructing", [](state::WorldDescription& world) { test::lose(world, "TOOTH"); });
  EXPECT_EQ(first.stopped_at, "not_yet") << first;
  EXPECT_EQ(first.quantities.at("parts"), 0) << first;
  EXPECT_GE(first.quantities.at("too_early"), 1) << first;
  const test::PlayedVisit flat =
      odometer().play_changed("constructing", [](state::WorldDescription& world) { test::lose(world, "FLAT"); });
  EXPECT_EQ(flat.stopped_at, "flat") << flat;
  EXPECT_EQ(flat.quantities.at("parts"), 2) << flat;
}

}  // namespace
}  // namespace mechane
