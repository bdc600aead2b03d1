// The crane of one pulley, played by its own visits; the law of the winch; and what fails, and where, once something is broken.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/exhibits/crane_lift.hpp"

namespace mechane {
namespace {

using SingleFigures = test::CraneFigures;

const test::Exhibit& single_crane() {
  static const test::Exhibit kExhibit("pulley-crane");
  return kExhibit;
}

TEST(PulleyCraneVisits, TheStoneComesOntoTheWallAndTwiceTheSame) {
  const test::PlayedVisit visit = single_crane().play("lifting");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 4u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  EXPECT_NEAR(visit.quantities.at("height"), 0.925, 1e-3) << visit;
  EXPECT_EQ(single_crane().play("lifting").state_hash, visit.state_hash);
}

TEST(PulleyCraneVisits, AVisitorWhoMakesMistakesGetsItThereToo) {
  double lowest_away_m = 1;
  test::PlayOptions options;
  const BodyId load = single_crane().description().find_body("LOAD");
  bool was_high = false;
  options.watch = [&](const state::WorldState& state) {
    const double y = state[load].X_WB.p.y();
    was_high = was_high || y > 0.5;
    if (was_high) lowest_away_m = std::min(lowest_away_m, y);
  };
  const test::PlayedVisit visit = single_crane().play("mistakes-use", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_GT(lowest_away_m, 0.47) << "the ratchet holds what was let go: by one tooth at most it falls";
}

TEST(PulleyCraneVisits, TheHandleTakesTheLoadByDrumOverCrank) {
  const test::CraneLift lift = test::measure_lift(single_crane());
  ASSERT_GT(lift.ticks, 1000u) << lift.visit;
  const double tension_n = SingleFigures::load_n / SingleFigures::sheave_efficiency;
  EXPECT_NEAR(lift.tension_n, tension_n, 0.02 * tension_n);
  const double handle_n = test::handle_force_n(tension_n, lift.rate);
  EXPECT_NEAR(lift.handle_n, handle_n, 0.03 * handle_n);
  EXPECT_NEAR(lift.wound_m, lift.turned_rad * SingleFigures::drum_radius_m, 2e-3);
  EXPECT_NEAR(lift.risen_m, lift.wound_m, 2e-3) << "what is wound is lifted";
  EXPECT_GT(lift.work_j, SingleFigures::load_n * lift.risen_m) << "no energy is made";
}

TEST(PulleyCraneVisits, ADrumTwiceAsThickAsksTwiceTheForce) {
  const test::CraneLift thin = test::measure_lift(single_crane());
  const test::CraneLift thick = test::measure_lift(single_crane(), [](state::WorldDescription& world) {
    test::set_parameter(world, "ROPE", "drumRadius", std::vector<double>{2 * SingleFigures::drum_radius_m});
  });
  ASSERT_GT(thick.ticks, 500u) << thick.visit;
  const double friction_n = test::handle_force_n(0, thin.rate);
  EXPECT_NEAR((thick.handle_n - friction_n) / (thin.handle_n - friction_n), 2, 0.06);
}

TEST(PulleyCraneVisits, AWholeHandTurnsTheCrankToo) {
  const test::PlayedVisit visit = single_crane().play_with_glove("lifting");
  EXPECT_TRUE(visit.done) << visit;
}

TEST(PulleyCraneVisits, WithTheRopeCutNothingIsLifted) {
  const auto cut = [](state::WorldDescription& world) { test::switch_off(world, "ROPE"); };
  const test::PlayedVisit visit = single_crane().play_changed("lifting", cut);
  EXPECT_EQ(visit.stopped_at, "lift") << visit;
  EXPECT_LT(visit.quantities.at("height"), 0.25)
      << "the hand shoves the stone on its bed, which is tilted then, but not lifted";
}

TEST(PulleyCraneVisits, WithTheRopeOffTheDrumNothingIsLifted) {
  const test::PlayedVisit visit = single_crane().play_changed("lifting", test::take_rope_off_drum);
  EXPECT_EQ(visit.stopped_at, "lift") << visit;
  EXPECT_GT(visit.quantities.at("turns"), 2) << "the drum turns, but lifts and draws nothing";
}

TEST(PulleyCraneVisits, WithoutItsPawlTheStoneComesDownAgain) {
  const auto off = [](state::WorldDescription& world) { test::switch_off(world, "RATCHET"); };
  const test::PlayedVisit visit = single_crane().play_changed("lifting", off);
  EXPECT_EQ(visit.stopped_at, "guide") << visit;
  EXPECT_LT(visit.quantities.at("height"), 0.3) << visit;
}

}  // namespace
}  // namespace mechane
