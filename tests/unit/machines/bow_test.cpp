// The gastraphetes: what drawing it asks and stores, what the arrow gets, and where it goes in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/flight_reference.hpp"
#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

constexpr double kFull = 1000, kDraw = 0.45, kArrow = 0.1, kShaft = 0.012, kBowScale = 0.02, kStraw = 1200;
constexpr double kHeld = kFull * kDraw / 2;

/// A crossbow that shoots along x at a target 20 m away; the arrow's origin is its middle, its tip 0.23 m before it.
state::WorldDescription bow_world() {
  state::WorldDescription world;
  world.effort_scale = kBowScale;
  const BodyId stock = add_body(world, "STOCK", 1, 1, true);
  add_joint(world, "SLIDE", state::JointKind::slider, stock, add_body(world, "SLIDER", 2, 0.1));
  add_body(world, "ARROW", kArrow, 2e-3);
  const BodyId target = add_body(world, "TARGET", 1, 1, true);
  world.bodies[target.index()].X_WB.p = Vec3(20, 0, 0);
  add_quantity(world, "trigger");
  world.machines = {{"BOW",
                     "machine.bow",
                     {{"joint", text("SLIDE")},
                      {"fullForce", number(kFull)},
                      {"drawLength", number(kDraw)},
                      {"release", text("trigger")}},
                     3},
                    {"FLIGHT",
                     "machine.projectile",
                     {{"body", text("ARROW")},
                      {"spring", text("BOW")},
                      {"seat", vector(0, 0, 0)},
                      {"direction", vector(1, 0, 0)},
                      {"efficiency", number(0.8)},
                      {"diameter", number(kShaft)},
                      {"dragCoefficient", number(2)},
                      {"axis", vector(1, 0, 0)},
                      {"tip", vector(0.23, 0, 0)},
                      {"target", text("TARGET")},
                      {"targetNormal", vector(-1, 0, 0)},
                      {"targetRadius", number(0.6)},
                      {"stopForce", number(kStraw)}},
                     9}};
  return world;
}

/// Brings the slider there, where its ratchets hold it.
void draw_to(Bench& bow, double to) {
  bow.body("SLIDER").X_WB.p = Vec3(to, 0, 0);
  bow.joint().min_position = bow.joint().max_position = to;
  bow.hold_at(to);
}
void span(Bench& bow, double to = kDraw) {
  for (int n = 0; n <= 100; ++n)
    draw_to(bow, to * n / 100);
}
void pull_trigger(Bench& bow) {
  bow.quantity("trigger") = 0;
  bow.tick();
  bow.quantity("trigger") = 1;
  bow.tick();
}

TEST(Bow, ForceRisesWithTheDrawAndHoldsHalfForceTimesLength) {
  Bench bow(bow_world());
  span(bow, kDraw / 3);
  EXPECT_NEAR(bow.value("BOW.force_n"), kFull / 3, 1e-9);
  EXPECT_NEAR(bow.joint().load, -kBowScale * kFull / 3, 1e-9);
  bow.hold_at(kDraw);
  EXPECT_NEAR(bow.value("BOW.energy_j"), kHeld, 1e-9);
  double work = 0;
  for (int n = 99; n >= 0; --n) {  // let down by hand: what it gives is what it held
    bow.move_to(kDraw * n / 100);
    work -= bow.joint().load / kBowScale * kDraw / 100 * (n > 0 ? 1 : 0);
  }
  EXPECT_NEAR(work, kHeld, 0.03 * kHeld);
  EXPECT_LE(work, kHeld);
}

TEST(Bow, ACurveOfItsOwnIsFollowedAndHoldsItsArea) {
  state::WorldDescription world = bow_world();
  world.machines[0].parameters["curve"] = std::vector<double>{0.2, 0.7, 0.8, 1};
  Bench bow(world);
  span(bow, kDraw / 2);
  EXPECT_NEAR(bow.value("BOW.force_n"), 0.75 * kFull, 1e-9);
  bow.hold_at(kDraw);
  EXPECT_NEAR(bow.value("BOW.energy_j"), kFull * kDraw / 3 * (0.45 + 0.75 + 0.9), 1e-9);
}

TEST(Bow, TheArrowGetsFourFifths) {
  Bench bow(bow_world(), Bench::Moved::by_dynamics);
  span(bow);
  bow.body("ARROW").X_WB = {};
  bow.body("ARROW").V_WB = {};
  pull_trigger(bow);
  EXPECT_NEAR(bow.body("ARROW").V_WB.v.x(), std::sqrt(2 * 0.8 * kHeld / kArrow), 0.01);
  EXPECT_NEAR(bow.value("BOW.shot_j"), 0, 1e-9);
  bow.tick();
  EXPECT_NEAR(bow.value("BOW.shot_j"), 0.8 * kHeld, 1e-3 * kHeld);
  EXPECT_EQ(bow.value("BOW.string_m"), 0);
  EXPECT_NEAR(bow.joint().position, kDraw, 1e-3) << "the slider stays";
}

TEST(Bow, ASecondPullWithoutDrawingShootsNothing) {
  Bench bow(bow_world());
  span(bow);
  pull_trigger(bow);
  ASSERT_EQ(bow.value("FLIGHT.shots"), 1);
  pull_trigger(bow);
  EXPECT_EQ(bow.value("FLIGHT.shots"), 1);
  EXPECT_EQ(bow.joint().load, 0) << "the string is home";
  bow.hold_at(0);
  EXPECT_EQ(bow.value("BOW.caught"), 1) << "the slider is home again";
  draw_to(bow, kDraw);
  pull_trigger(bow);
  EXPECT_EQ(bow.value("FLIGHT.shots"), 2);
}

TEST(Bow, WithoutAStringItDrawsFreelyAndShootsNothing) {
  state::WorldDescription world = bow_world();
  world.machines[0].parameters["strung"] = false;
  Bench bow(world);
  span(bow);
  EXPECT_EQ(bow.joint().load, 0);
  pull_trigger(bow);
  EXPECT_EQ(bow.value("FLIGHT.shots"), 0);
}

TEST(Bow, ASliderThatNeverWasHomeHasNoString) {
  Bench bow(bow_world());
  bow.hold_at(0.1);
  bow.hold_at(kDraw);
  EXPECT_EQ(bow.value("BOW.caught"), 0);
  EXPECT_EQ(bow.value("BOW.force_n"), 0);
}

/// Shoots, until the arrow rests.
void shoot_arrow(Bench& bow, double seconds = 1.0) {
  span(bow);
  bow.body("ARROW").X_WB = {};
  bow.body("ARROW").V_WB = {};
  pull_trigger(bow);
  bow.run(seconds);
}

TEST(Arrow, EntersTheTargetByItsEnergyOverTheStrawsForce) {
  Bench flight(bow_world(), Bench::Moved::by_dynamics);
  shoot_arrow(flight);
  const double k = 0.5 * 1.2 * 2 * kPi * kShaft * kShaft / 4 / kArrow;
  const double speed = std::sqrt(2 * 0.8 * kHeld / kArrow) * std::exp(-k * (20 - 0.23));  // flat flight with v^2 drag
  const double depth = 0.5 * kArrow * speed * speed / kStraw;
  EXPECT_EQ(flight.value("FLIGHT.hit"), 1);
  EXPECT_EQ(flight.value("FLIGHT.flying"), 0);
  EXPECT_NEAR(flight.value("FLIGHT.depth_m"), depth, 0.1 * depth);
  EXPECT_NEAR(flight.value("FLIGHT.range_m"), 20 - 0.23, 0.01);
  const double drop = 0.5 * 9.81 * std::pow(20 / speed, 2);
  EXPECT_NEAR(flight.value("FLIGHT.off_centre_m"), drop, 0.1 * drop + 0.01);
  const Vec3 stuck = flight.body("ARROW").X_WB.p;
  flight.run(0.5);
  EXPECT_LT((flight.body("ARROW").X_WB.p - stuck).norm(), 1e-6) << "it sticks";
}

TEST(Arrow, FlewByATargetThatIsTooSmall) {
  state::WorldDescription world = bow_world();
  world.machines[1].parameters["targetRadius"] = number(0.1);
  Bench flight(world, Bench::Moved::by_dynamics);
  shoot_arrow(flight);
  EXPECT_EQ(flight.value("FLIGHT.hit"), 0);
  EXPECT_GT(flight.value("FLIGHT.range_m"), 30);
}

TEST(Arrow, KeepsItsAxisAlongTheFlightAndItsRangeUnderDrag) {
  state::WorldDescription world = bow_world();
  auto& flight = world.machines[1].parameters;
  flight.erase("target");
  flight["direction"] = vector(std::cos(0.7), std::sin(0.7), 0);
  flight["ground"] = number(0);
  Bench bow(world, Bench::Moved::by_dynamics);
  shoot_arrow(bow, 12);
  const double k = 0.5 * 1.2 * 2 * kPi * kShaft * kShaft / 4 / kArrow;
  const Landing landing = integrate_flight(std::sqrt(2 * 0.8 * kHeld / kArrow), 0.7, k, 1e-6);
  EXPECT_NEAR(bow.value("FLIGHT.range_m"), landing.range_m, 0.005 * landing.range_m);
  EXPECT_NEAR(bow.value("FLIGHT.speed_m_s"), landing.speed_m_s, 0.01 * landing.speed_m_s);

  Bench nose(world, Bench::Moved::by_dynamics);
  shoot_arrow(nose, 6);
  ASSERT_EQ(nose.value("FLIGHT.flying"), 1);
  const state::BodyState& arrow = nose.body("ARROW");
  EXPECT_LT(arrow.V_WB.v.y(), -10) << "it falls by now";
  EXPECT_GT(arrow.X_WB.rotate(Vec3::UnitX()).dot(arrow.V_WB.v.normalized()), 0.999) << "nose first";
}

TEST(Arrow, ATickAllocatesNothing) {
  Bench bow(bow_world());
  span(bow);
  bow.quantity("trigger") = 1;
  EXPECT_EQ(bow.allocations(3000), 0u);
}

TEST(Bow, ErrorsSayWhatToWrite) {
  state::WorldDescription world = bow_world();
  world.machines[0].parameters["curve"] = std::vector<double>{0.5};
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("curve"), {"1 points", "2 to 64"}));
  world = bow_world();
  world.joints[0].kind = state::JointKind::hinge;
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::invalid_value, line_of("joint"), {"machine.bow BOW", "'SLIDE'", "SliderJoint"}));
}

}  // namespace
}  // namespace mechane::machines::test
