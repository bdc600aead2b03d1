// Ktesibios' pump, played by its own visits; and what fails, and where, once something is wrong with it.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

using Texts = std::vector<std::string>;

const test::Exhibit& pump() {
  static const test::Exhibit kExhibit("ktesibios-pump");
  return kExhibit;
}

test::PlayedVisit play_with_valves(const std::string& parameter, const Texts& valves) {
  return pump().play_changed(
      "pumping", [&](state::WorldDescription& world) { test::set_parameter(world, "WATER", parameter, valves); });
}

TEST(KtesibiosPumpVisits, AllPartsComeToTheirPlaces) {
  const test::PlayedVisit visit = pump().play("assembling");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  EXPECT_EQ(visit.quantities.at("parts"), 6) << visit;
  EXPECT_EQ(visit.quantities.at("too_early"), 0) << visit;
  EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << visit;
  EXPECT_EQ(pump().play("assembling").state_hash, visit.state_hash);
}

TEST(KtesibiosPumpVisits, PumpingFillsTheTubByAreaStrokeAndRate) {
  double least_rad = 0, most_rad = 0;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const double angle = state.joints[pump().description().find_joint("PIVOT").index()].position;
    least_rad = std::min(least_rad, angle);
    most_rad = std::max(most_rad, angle);
  };
  const test::PlayedVisit visit = pump().play("pumping", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  EXPECT_EQ(pump().play("pumping").state_hash, visit.state_hash);
  // Fourteen cycles, less what is still in the vessel and under it: two pistons' area times their stroke, four fifths of it.
  const double litres_a_cycle = 1000 * 2 * (kPi * 0.05 * 0.05) * 0.22 * (most_rad - least_rad) * 0.8;
  EXPECT_NEAR(visit.quantities.at("lifted"), 14 * litres_a_cycle - 3.5, 0.12 * 14 * litres_a_cycle) << visit;
}

TEST(KtesibiosPumpVisits, MistakesEndWellToo) {
  const test::PlayedVisit assembling = pump().play("mistakes-assembling");
  EXPECT_TRUE(assembling.done) << assembling;
  EXPECT_GE(assembling.quantities.at("too_early"), 1) << assembling;
  EXPECT_TRUE(std::ranges::any_of(assembling.moves, test::went_wrong)) << assembling;
  const test::PlayedVisit pumping = pump().play("mistakes-using");
  EXPECT_TRUE(pumping.done) << pumping;
  EXPECT_TRUE(std::ranges::any_of(pumping.moves, test::went_wrong)) << pumping;
}

/// Only what leaks past the leather lets a hand that leans on the handle move it: its share of the real force, 14 N, is little more than
/// the grip's 12 N.
TEST(KtesibiosPumpVisits, OutletFlapsTheWrongWayRoundLockThePistons) {
  const test::PlayedVisit visit = play_with_valves("outletValves", {"reversed"});
  EXPECT_EQ(visit.quantities.at("head"), 0) << visit;
  EXPECT_TRUE(test::went_wrong(visit.moves.at(2))) << "the first swing: " << visit;
  const auto stroke = std::ranges::find(visit.steps, "stroke", &test::PlayedStep::name);
  ASSERT_NE(stroke, visit.steps.end()) << visit;
  EXPECT_TRUE(visit.stopped_at == "stroke" || stroke->seconds > 10) << "good visits need 3 s: " << visit;
}

TEST(KtesibiosPumpVisits, InletFlapsTheWrongWayRoundDrawNoWater) {
  const test::PlayedVisit visit = play_with_valves("inletValves", {"reversed"});
  EXPECT_EQ(visit.stopped_at, "prime") << visit;
  EXPECT_EQ(visit.quantities.at("head"), 0) << visit;
}

TEST(KtesibiosPumpVisits, OneInletFlapTheWrongWayRoundMakesTheJetPulse) {
  const test::PlayedVisit visit = play_with_valves("inletValves", {"good", "reversed"});
  EXPECT_EQ(visit.stopped_at, "steady") << visit;
}

TEST(KtesibiosPumpVisits, APistonThatIsMissingIsMissedAtOnce) {
  const test::PlayedVisit assembling =
      pump().play_changed("assembling", [](state::WorldDescription& world) { test::lose(world, "PISTON_L", {}); });
  EXPECT_EQ(assembling.stopped_at, "pistons") << assembling;
  const test::PlayedVisit pumping = pump().play_changed("pumping", [](state::WorldDescription& world) {
    test::lose(world, "PISTON_R", {"GUIDE_R", "ROD_R"});
  });
  EXPECT_EQ(pumping.stopped_at, "steady") << pumping;
}

TEST(KtesibiosPumpVisits, WithoutItsHandleItCanBeNeitherFinishedNorHeld) {
  const test::PlayedVisit assembling =
      pump().play_changed("assembling", [](state::WorldDescription& world) { test::lose(world, "HANDLE", {}); });
  EXPECT_EQ(assembling.stopped_at, "handle") << assembling;
  const test::PlayedVisit pumping =
      pump().play_changed("pumping", [](state::WorldDescription& world) { test::lose(world, "HANDLE", {"TIE"}); });
  EXPECT_EQ(pumping.stopped_at, "grasp") << pumping;
}

TEST(KtesibiosPumpVisits, AHandleThatIsNotStrappedOnMovesNoPiston) {
  const test::PlayedVisit visit =
      pump().play_changed("pumping", [](state::WorldDescription& world) { test::switch_off(world, "TIE"); });
  EXPECT_EQ(visit.stopped_at, "stroke") << visit;
}

}  // namespace
}  // namespace mechane
