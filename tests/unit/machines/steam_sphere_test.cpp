// The sphere of Aiolos: how long the water takes, how much steam comes, how fast the sphere turns, and how it dies down.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

constexpr double kFire = 1000, kNozzle_m = 0.12, kBore_m = 0.003, kBearing = 2e-4, kAir = 2e-7, kSphereInertia = 2e-4;
constexpr double kNozzleArea = 2 * kPi * kBore_m * kBore_m / 4;
constexpr double kSteamFlow = kFire / 2.26e6;

state::WorldDescription sphere_world(double time_scale = 60) {
  state::WorldDescription world;
  world.effort_scale = 0.5;
  const BodyId frame = add_body(world, "CAULDRON", 1, 1, true);
  add_joint(world, "PIVOT", state::JointKind::hinge, frame, add_body(world, "SPHERE", 1, kSphereInertia));
  add_quantity(world, "lit");
  world.machines = {{"STEAM",
                     "machine.steam_sphere",
                     {{"joint", text("PIVOT")},
                      {"fire", text("lit")},
                      {"firePower", number(kFire)},
                      {"timeScale", number(time_scale)},
                      {"nozzleRadius", number(kNozzle_m)},
                      {"nozzleDiameter", number(kBore_m)},
                      {"bearing", number(kBearing)},
                      {"airDrag", number(kAir)}},
                     5}};
  return world;
}

state::WorldDescription sphere_with(const std::string& name, const state::Parameter& value) {
  state::WorldDescription world = sphere_world();
  world.machines[0].parameters[name] = value;
  return world;
}

double seconds_to_boil(Bench& bench, double most) {
  bench.quantity("lit") = 1;
  double time = 0;
  while (time < most && bench.value("STEAM.boils") == 0) {
    bench.tick();
    time += kTick;
  }
  return time;
}

TEST(SteamSphere, ALitreAtAKilowattBoilsAfterMCDeltaTOverP) {
  Bench real(sphere_world(1));
  const double closed_form = 1.0 * 4186 * 80 / kFire;
  EXPECT_NEAR(closed_form, 335, 1);
  EXPECT_NEAR(seconds_to_boil(real, 400), closed_form, 0.01);
  Bench fast(sphere_world(60));
  EXPECT_NEAR(seconds_to_boil(fast, 400), closed_form / 60, 0.002);
}

TEST(SteamSphere, ACauldronThatLosesHeatWarmsByTheExponential) {
  Bench bench(sphere_with("loss", number(5)));
  // m c dT/dt = P - k (T - T0): boils at t = -(m c / k) ln(1 - k dT / P).
  const double closed_form = -(4186.0 / 5) * std::log(1 - 5 * 80 / kFire) / 60;
  EXPECT_NEAR(seconds_to_boil(bench, 60), closed_form, 0.002 * closed_form);
  bench.run(5);
  EXPECT_NEAR(bench.value("STEAM.steam_kg_s"), (kFire - 5 * 80) / 2.26e6, 1e-7) << "the rest boils";
}

TEST(SteamSphere, SteamIsPowerOverLatentHeatAndTheWaterGoes) {
  Bench bench(sphere_world(60));
  (void)seconds_to_boil(bench, 60);
  const double before = bench.value("STEAM.water_l");
  bench.run(10);
  EXPECT_NEAR(bench.value("STEAM.steam_kg_s"), kSteamFlow, 1e-6 * kSteamFlow);
  EXPECT_NEAR(before - bench.value("STEAM.water_l"), 10 * 60 * kSteamFlow, 1e-3) << "as fast as timeScale says";
  EXPECT_NEAR(bench.value("STEAM.exit_m_s"), kSteamFlow / (0.598 * kNozzleArea), 1e-3);
  EXPECT_EQ(bench.value("STEAM.temperature_c"), 100);
}

/// Where flow r (v - w r) = bearing + c w^2.
double terminal_rate() {
  const double v = kSteamFlow / (0.598 * kNozzleArea);
  const double a = kAir, b = kSteamFlow * kNozzle_m * kNozzle_m, c = kBearing - kSteamFlow * kNozzle_m * v;
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

TEST(SteamSphere, TurnsAsFastAsTheDragLetsIt) {
  state::WorldDescription world = sphere_world(60);
  world.machines[0].parameters["water"] = number(3);
  Bench bench(world, Bench::Moved::by_dynamics);
  (void)seconds_to_boil(bench, 60);
  bench.run(40);
  EXPECT_GT(terminal_rate(), 80) << "some 1000 turns a minute, as reconstructions have it";
  EXPECT_NEAR(bench.value("STEAM.rate"), terminal_rate(), 0.01 * terminal_rate());
  EXPECT_NEAR(bench.joint().velocity, bench.value("STEAM.rate"), 0.01);
}

TEST(SteamSphere, DiesDownWithoutFire) {
  state::WorldDescription world = sphere_world(60);
  world.machines[0].parameters["water"] = number(3);
  Bench bench(world, Bench::Moved::by_dynamics);
  (void)seconds_to_boil(bench, 60);
  bench.run(15);
  const double fast = bench.value("STEAM.rate");
  ASSERT_GT(fast, 40);
  bench.quantity("lit") = 0;
  bench.run(4);
  EXPECT_LT(bench.value("STEAM.steam_kg_s"), 0.001 * kSteamFlow);
  EXPECT_LT(bench.value("STEAM.rate"), fast);
  bench.run(60);
  EXPECT_NEAR(bench.value("STEAM.rate"), 0, 0.01) << "bearing and air stop it";
}

TEST(SteamSphere, StopsWhenTheWaterHasRunOut) {
  Bench bench(sphere_with("water", number(0.2)));
  (void)seconds_to_boil(bench, 60);
  bench.run(0.2 * 2.26e6 / kFire / 60 + 6);
  EXPECT_EQ(bench.value("STEAM.water_l"), 0);
  EXPECT_NEAR(bench.value("STEAM.steam_kg_s"), 0, 1e-5 * kSteamFlow);
  EXPECT_LT(bench.value("STEAM.torque_nm"), 1e-9);
}

TEST(SteamSphere, ANozzleBentTheWrongWayOrAnOpenLidTurnsNothing) {
  for (const state::WorldDescription& world :
       {sphere_with("nozzleAngles", std::vector<double>{0, kPi}), sphere_with("lid", false)}) {
    Bench bench(world, Bench::Moved::by_dynamics);
    (void)seconds_to_boil(bench, 60);
    bench.run(5);
    EXPECT_EQ(bench.value("STEAM.boils"), 1);
    EXPECT_NEAR(bench.value("STEAM.rate"), 0, 1e-6);
  }
}

TEST(SteamSphere, WithoutFireNothingHappens) {
  Bench bench(sphere_world(), Bench::Moved::by_dynamics);
  bench.run(10);
  EXPECT_EQ(bench.value("STEAM.temperature_c"), 20);
  EXPECT_EQ(bench.value("STEAM.rate"), 0);
}

RC_GTEST_PROP(SteamSphere, TheHeatOfTheFireIsAllAccountedFor, ()) {
  Bench bench(sphere_with("water", number(0.1 * *rc::gen::inRange(3, 20))));
  const double start_l = bench.value("STEAM.water_l");
  double fire_j = 0, warmed_j = 0;
  for (int i = 0; i < 8; ++i) {
    bench.quantity("lit") = *rc::gen::inRange(0, 2);
    for (int n = *rc::gen::inRange(1, 2000); n > 0; --n) {
      const double before_c = bench.value("STEAM.temperature_c"), water = bench.value("STEAM.water_l");
      if (bench.quantity("lit") > 0.5 && water > 0.01) fire_j += kFire * 60 * kTick;
      bench.tick();
      warmed_j += water * 4186 * (bench.value("STEAM.temperature_c") - before_c);
      if (bench.value("STEAM.water_l") <= 0.01) RC_DISCARD("dry");
    }
  }
  const double boiled_j = (start_l - bench.value("STEAM.water_l")) * 2.26e6;
  RC_ASSERT(std::abs(fire_j - warmed_j - boiled_j) <= 1e-6 * fire_j + 1e-3);
}

/// FIRE, a simulation.lit, lights the fire in the place of a quantity.
state::WorldDescription sphere_lit_by(const std::string& agent_type) {
  state::WorldDescription world = sphere_world(60);
  world.machines[0].parameters.erase("fire");
  world.machines[0].parameters["litBy"] = text("FIRE");
  world.agents = {{"FIRE", agent_type, {}, 7}};
  return world;
}

TEST(SteamSphere, TheAgentThatIsNamedLightsTheFireAndPutsItOut) {
  Bench bench(sphere_lit_by("simulation.lit"), Bench::Moved::by_hand, {"OTHER.lit", "FIRE.lit"});
  bench.value_of_agent("OTHER.lit") = 1;
  bench.run(0.5);
  EXPECT_EQ(bench.value("STEAM.temperature_c"), 20) << "another agent's fire warms nothing";
  bench.value_of_agent("FIRE.lit") = 1;
  bench.run(0.5);
  const double warm_c = bench.value("STEAM.temperature_c");
  EXPECT_NEAR(warm_c, 20 + kFire * 0.5 * 60 / 4186, 0.01);
  bench.value_of_agent("FIRE.lit") = 0;
  bench.run(0.5);
  EXPECT_EQ(bench.value("STEAM.temperature_c"), warm_c) << "no loss, no fire";
}

TEST(SteamSphere, SaysWhatTheFireIsLitBy) {
  EXPECT_THAT(error_of(sphere_lit_by("simulation.dwell")),
              is_error(ErrorCode::invalid_value, line_of("litBy"), {"'FIRE'", "simulation.lit"}));
  state::WorldDescription both = sphere_lit_by("simulation.lit");
  both.machines[0].parameters["fire"] = text("lit");
  EXPECT_THAT(error_of(both), is_error(ErrorCode::conflict, line_of("litBy"), {"'fire'", "'litBy'"}));
  state::WorldDescription none = sphere_world();
  none.machines[0].parameters.erase("fire");
  EXPECT_THAT(error_of(none),
              is_error(ErrorCode::missing, 5, {"line 5, machine.steam_sphere STEAM", "'fire'", "'litBy'"}));
  EXPECT_THAT(error_of(sphere_lit_by("simulation.lit")),
              is_error(ErrorCode::invalid_value, line_of("litBy"), {"'FIRE' has no value 'lit'"}));
}

TEST(SteamSphere, ATickAllocatesNothing) {
  Bench bench(sphere_world());
  bench.quantity("lit") = 1;
  EXPECT_EQ(bench.allocations(10000), 0u);
}

TEST(SteamSphere, ErrorsSayWhatToWrite) {
  EXPECT_THAT(error_of(sphere_with("nozzleDiameter", number(0.001))),
              is_error(ErrorCode::conflict, line_of("nozzleDiameter"), {"0.0014 or more"}));
  EXPECT_THAT(error_of(sphere_with("loss", number(20))), is_error(ErrorCode::conflict, line_of("loss"), {"12.50"}));
  EXPECT_THAT(error_of(sphere_with("fire", text("flame"))),
              is_error(ErrorCode::unknown_name, line_of("fire"), {"'flame'", "name one of: lit"}));
  EXPECT_THAT(error_of(sphere_with("nozzleAngles", std::vector<double>{})),
              is_error(ErrorCode::invalid_value, line_of("nozzleAngles"), {"0 angles", "1 to 8"}));
}

}  // namespace
}  // namespace mechane::machines::test
