// The crane of two pulleys, played by its own visits: half the force, twice the rope; and what fails once something is broken.
#include <gtest/gtest.h>

#include "tests/exhibits/crane_lift.hpp"

namespace mechane {
namespace {

using DoubleFigures = test::CraneFigures;

const test::Exhibit& double_crane() {
  static const test::Exhibit kExhibit("compound-pulley-crane");
  return kExhibit;
}

TEST(CompoundPulleyCraneVisits, TheDrumComesOntoTheColumnAndTwiceTheSame) {
  const test::PlayedVisit visit = double_crane().play("lifting");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 4u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  EXPECT_NEAR(visit.quantities.at("height"), 0.925, 1e-3) << visit;
  EXPECT_EQ(double_crane().play("lifting").state_hash, visit.state_hash);
}

TEST(CompoundPulleyCraneVisits, AVisitorWhoMakesMistakesGetsItThereToo) {
  const test::PlayedVisit visit = double_crane().play("mistakes-use");
  EXPECT_TRUE(visit.done) << visit;
}

TEST(CompoundPulleyCraneVisits, TwoPartsOfTheRopeBearTheLoadByTheLawOfTheTackle) {
  const test::CraneLift lift = test::measure_lift(double_crane());
  ASSERT_GT(lift.ticks, 1000u) << lift.visit;
  const double n = DoubleFigures::sheave_efficiency;
  const double tension_n = DoubleFigures::load_n / (n + n * n);  // behind the first sheave n, behind the second n^2
  EXPECT_NEAR(lift.tension_n, tension_n, 0.02 * tension_n);
  const double handle_n = test::handle_force_n(tension_n, lift.rate);
  EXPECT_NEAR(lift.handle_n, handle_n, 0.03 * handle_n);
  EXPECT_NEAR(lift.wound_m, lift.turned_rad * DoubleFigures::drum_radius_m, 2e-3);
  EXPECT_NEAR(lift.wound_m / lift.risen_m, 2, 0.02) << "twice the rope";
  EXPECT_GT(lift.work_j, DoubleFigures::load_n * lift.risen_m) << "no energy is made";
}

TEST(CompoundPulleyCraneVisits, WithoutFrictionItTakesHalfTheForceOfTheSinglePulley) {
  const auto ideal = [](state::WorldDescription& world) {
    test::set_parameter(world, "ROPE", "efficiency", std::vector<double>{1});
    test::set_parameter(world, "AXLE", "frictionTorque", std::vector<double>{0});
    test::set_parameter(world, "AXLE", "viscous", std::vector<double>{0});
  };
  const test::CraneLift one = test::measure_lift(test::Exhibit("pulley-crane"), ideal);
  const test::CraneLift two = test::measure_lift(double_crane(), ideal);
  EXPECT_NEAR(two.handle_n / one.handle_n, 0.5, 0.015);
  EXPECT_NEAR(one.work_j / one.risen_m, DoubleFigures::load_n, 0.03 * DoubleFigures::load_n);
  EXPECT_NEAR(two.work_j / two.risen_m, DoubleFigures::load_n, 0.03 * DoubleFigures::load_n) << "the work is the same";
}

TEST(CompoundPulleyCraneVisits, WithTheRopeCutNothingIsLifted) {
  const auto cut = [](state::WorldDescription& world) { test::switch_off(world, "ROPE"); };
  const test::PlayedVisit visit = double_crane().play_changed("lifting", cut);
  EXPECT_EQ(visit.stopped_at, "lift") << visit;
}

TEST(CompoundPulleyCraneVisits, WithTheRopeOffTheDrumNothingIsLifted) {
  const test::PlayedVisit visit = double_crane().play_changed("lifting", test::take_rope_off_drum);
  EXPECT_EQ(visit.stopped_at, "lift") << visit;
}

TEST(CompoundPulleyCraneVisits, WithoutItsPawlTheDrumComesDownAgain) {
  const auto off = [](state::WorldDescription& world) { test::switch_off(world, "RATCHET"); };
  const test::PlayedVisit visit = double_crane().play_changed("lifting", off);
  EXPECT_EQ(visit.stopped_at, "guide") << visit;
}

}  // namespace
}  // namespace mechane
