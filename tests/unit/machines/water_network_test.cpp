// machine.water_network against closed forms: Torricelli's time, vessels that communicate, siphons, shut-in air, floats; no water made or
// lost in any network; and what authors get wrong.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/machines/formula_names.hpp"
#include "server/machines/registry.hpp"
#include "server/state/snapshot.hpp"
#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

using PartTexts = std::vector<std::string>;
using NetworkTexts = std::map<std::string, PartTexts>;

constexpr double kGravity = 9.81;
constexpr double kRoomPressure_pa = 101325;

/// A hinge TAP, a slider GUIDE upwards whose body is FLOAT (0.1 kg), and a quantity `wind`.
state::WorldDescription network_world(const NetworkTexts& texts) {
  state::WorldDescription world;
  const BodyId frame = add_body(world, "FRAME", 1, 1, true);
  add_joint(world, "TAP", state::JointKind::hinge, frame, add_body(world, "HANDLE", 1, 0.01));
  add_joint(world, "GUIDE", state::JointKind::slider, frame, add_body(world, "FLOAT", 0.1, 0.01));
  world.joints.back().X_B1J.R = Quat::FromTwoVectors(Vec3::UnitX(), Vec3::UnitY());
  world.joints.back().X_B2J.R = world.joints.back().X_B1J.R;
  world.quantities.push_back({"wind", "SAIL.speed", "m/s"});
  state::ComponentDescription network{"NET", "machine.water_network", {}, 9};
  for (const auto& [list, parts] : texts)
    network.parameters[list] = parts;
  world.machines = {network};
  return world;
}

double hole_m2(double bore_m, double discharge) {
  return discharge * kPi * bore_m * bore_m / 4;
}

TEST(WaterNetwork, AVesselEmptiesInTorricellisTime) {
  Bench bench(network_world({{"vessels", {"TUB: area 100 cm2, height 0.5 m, start 4 l"}},
                             {"pipes", {"HOLE: from TUB at 0 m, to air, bore 1 cm, discharge 0.62"}}}));
  EXPECT_NEAR(bench.value("NET.TUB_level"), 0.4, 1e-12) << "before the first tick";
  const double time_s = 0.01 / hole_m2(0.01, 0.62) * std::sqrt(2 * 0.4 / kGravity);
  bench.run(0.5 * time_s);
  EXPECT_NEAR(bench.value("NET.TUB_level"), 0.1, 0.001);
  bench.run(0.49 * time_s);
  EXPECT_GT(bench.value("NET.TUB_volume"), 1e-6);
  bench.run(0.02 * time_s);
  EXPECT_LT(bench.value("NET.TUB_volume"), 1e-7);
  EXPECT_NEAR(bench.value("NET.TUB_volume") + bench.value("NET.delivered_l"), 4, 1e-12);
}

/// sqrt(dh) falls evenly, for dh' = -c A sqrt(2 g dh) (1/A1 + 1/A2).
TEST(WaterNetwork, TwoVesselsCommunicateAsInTheClosedForm) {
  Bench bench(network_world({{"vessels", {"A: area 0.01 m2, height 1 m, start 6 l", "B: area 0.03 m2, height 1 m"}},
                             {"pipes", {"LINK: from A at 0 m, to B at 0 m, bore 2 cm, discharge 0.6"}}}));
  const double time_s = 2 * std::sqrt(0.6) / (hole_m2(0.02, 0.6) * std::sqrt(2 * kGravity) * (1 / 0.01 + 1 / 0.03));
  const double level_m = 0.006 / 0.04;
  for (const double part : {0.25, 0.5, 0.75}) {
    bench.run(0.25 * time_s);
    const double difference_m = 0.6 * (1 - part) * (1 - part);
    EXPECT_NEAR(bench.value("NET.A_level") - bench.value("NET.B_level"), difference_m, 0.006) << part;
  }
  EXPECT_GT(bench.value("NET.LINK_flow"), 0.01);
  bench.run(0.26 * time_s);
  EXPECT_NEAR(bench.value("NET.A_level"), level_m, 1e-6);
  EXPECT_NEAR(bench.value("NET.B_level"), level_m, 1e-6);
  EXPECT_NEAR(bench.value("NET.LINK_flow"), 0, 1e-6);
}

TEST(WaterNetwork, ASiphonStartsAtItsCrestAndStopsAtItsMouth) {
  Bench bench(network_world({{"vessels", {"CUP: area 0.004 m2, height 0.3 m"}},
                             {"feeds", {"TAP_FEED: into CUP, flow 3 l/min * step(TAP.angle > 0.5)"}},
                             {"pipes", {"SIPHON: from CUP at 0.05 m, to air at -0.1 m, bore 1 cm, crest 0.25 m"}}}));
  bench.joint().position = 1;
  const double fill_s = 0.004 * 0.25 / (0.003 / 60);
  bench.run(0.99 * fill_s);
  EXPECT_EQ(bench.value("NET.SIPHON_flow"), 0);
  EXPECT_NEAR(bench.value("NET.CUP_level"), 0.99 * 0.25, 1e-6);
  bench.run(0.02 * fill_s);
  EXPECT_GT(bench.value("NET.SIPHON_flow"), 0.1);
  bench.joint().position = 0;
  bench.run(30);
  EXPECT_NEAR(bench.value("NET.CUP_level"), 0.05, 1e-9);
  EXPECT_EQ(bench.value("NET.SIPHON_flow"), 0);
  bench.joint().position = 1;
  bench.run(2);
  EXPECT_EQ(bench.value("NET.SIPHON_flow"), 0) << "it is empty until water stands over its crest again";
}

TEST(WaterNetwork, ShutInAirKeepsPressureTimesVolume) {
  Bench bench(network_world(
      {{"vessels",
        {"HIGH: area 0.05 m2, floor 5 m, height 1 m, start 40 l", "BELL: area 0.01 m2, height 0.5 m, air INSIDE"}},
       {"pipes", {"PIPE: from HIGH at 5 m, to BELL at 0 m, bore 1 cm"}}}));
  for (int i = 0; i < 40; ++i) {
    bench.run(0.5);
    const double air_l = 5 - bench.value("NET.BELL_volume");
    EXPECT_NEAR((bench.value("NET.BELL_pressure") + kRoomPressure_pa) * air_l, kRoomPressure_pa * 5, 1e-3);
  }
  const double head_pa = 1000 * kGravity * (5 + bench.value("NET.HIGH_level") - bench.value("NET.BELL_level"));
  EXPECT_NEAR(bench.value("NET.BELL_pressure"), head_pa, 1) << "at rest";
  EXPECT_GT(bench.value("NET.BELL_volume"), 1);
}

/// Heron's fountain (Pneumatica I.36 and after): water that falls presses the air of two vessels, which drives other water over the level
/// of the first.
TEST(WaterNetwork, VesselsThatShareTheirAirDriveEachOthersWater) {
  Bench bench(network_world({{"vessels",
                              {"BASIN: area 0.04 m2, floor 1 m, height 0.1 m, start 2 l",
                               "LOW: area 0.03 m2, floor 0 m, height 0.3 m, air SHARED",
                               "MIDDLE: area 0.03 m2, floor 0.5 m, height 0.3 m, start 8 l, air SHARED"}},
                             {"pipes",
                              {"DOWN: from BASIN at 1 m, to LOW at 0 m, bore 1 cm",
                               "JET: from MIDDLE at 0.5 m, to BASIN at 1.2 m, bore 4 mm"}}}));
  bench.run(10);
  EXPECT_GT(bench.value("NET.JET_flow"), 0.005) << "it rises 0.4 m over the water that it comes from";
  EXPECT_EQ(bench.value("NET.LOW_pressure"), bench.value("NET.MIDDLE_pressure"));
  const double fall_pa = 1000 * kGravity * (1 + bench.value("NET.BASIN_level") - bench.value("NET.LOW_level"));
  EXPECT_LT(bench.value("NET.LOW_pressure"), fall_pa);
  EXPECT_GT(bench.value("NET.LOW_pressure"), 0.5 * fall_pa);
}

/// The thief of wine, which Empedocles knew: a finger on the hole above keeps the water in.
TEST(WaterNetwork, AClosedVesselHoldsItsWaterUntilItsVentOpens) {
  Bench bench(network_world(
      {{"vessels", {"THIEF: area 0.002 m2, floor 1 m, height 0.2 m, start 0.3 l, air IN, vent step(TAP.angle > 0.5)"}},
       {"pipes", {"HOLE: from THIEF at 1 m, to air, bore 3 mm"}}}));
  bench.run(5);
  const double held_l = bench.value("NET.THIEF_volume");
  EXPECT_GT(held_l, 0.29);
  EXPECT_NEAR(bench.value("NET.THIEF_pressure"), -1000 * kGravity * bench.value("NET.THIEF_level"), 0.01);
  bench.joint().position = 1;
  bench.tick();
  EXPECT_EQ(bench.value("NET.THIEF_pressure"), 0);
  const double time_s = 0.002 / hole_m2(0.003, 0.6) * std::sqrt(2 * 1e-3 * held_l / 0.002 / kGravity);
  bench.run(0.98 * time_s);
  EXPECT_GT(bench.value("NET.THIEF_volume"), 0);
  bench.run(0.04 * time_s);
  EXPECT_LT(bench.value("NET.THIEF_volume"), 1e-6);
}

TEST(WaterNetwork, AValveLetsThroughItsShareAndAFlapNothingBack) {
  Bench bench(
      network_world({{"vessels", {"A: area 1 m2, height 1 m, start 500 l", "B: area 1 m2, height 1 m, start 900 l"}},
                     {"pipes",
                      {"OUT: from A at 0 m, to air, bore 1 cm, discharge 0.6, open TAP.angle / 2 rad",
                       "BACK: from A at 0 m, to B at 0 m, bore 5 cm, oneway",
                       "FLOATED: from B at 0 m, to air, bore 1 cm, discharge 0.6, "
                       "open clamp((A_level - 40 cm) / 20 cm, 0, 1)",
                       "BLOWN: from A at 0 m, to air, bore 1 cm, open 1 m/s / quantity.wind"}}}));
  const double full_l_s = 1000 * hole_m2(0.01, 0.6) * std::sqrt(2 * kGravity * 0.5);
  bench.joint().position = 1;
  bench.tick();
  EXPECT_NEAR(bench.value("NET.OUT_flow"), 0.5 * full_l_s, 1e-6);
  EXPECT_EQ(bench.value("NET.BACK_flow"), 0);
  EXPECT_NEAR(bench.value("NET.FLOATED_flow"), 0.5 * full_l_s * std::sqrt(0.9 / 0.5), 1e-6);
  EXPECT_EQ(bench.value("NET.BLOWN_flow"), 0);
  EXPECT_EQ(bench.value("NET.faults"), 1) << "of the wind, which is 0";
  bench.quantity("wind") = 0.5;
  bench.joint().position = -1;
  bench.tick();
  EXPECT_EQ(bench.value("NET.OUT_flow"), 0);
  EXPECT_NEAR(bench.value("NET.BLOWN_flow"), full_l_s, 1e-3) << "quite open, not twice";
  EXPECT_EQ(bench.value("NET.faults"), 1);
}

TEST(WaterNetwork, WhatFindsNoRoomRunsOverTheRimAndIsCounted) {
  state::WorldDescription world = network_world(
      {{"vessels", {"CUP: area 0.01 m2, height 0.1 m, start 0.5 l"}}, {"feeds", {"SPRING: into CUP, flow 6 l/min"}}});
  world.machines[0].parameters["timeScale"] = number(10);
  Bench bench(world);
  bench.run(1);
  EXPECT_NEAR(bench.value("NET.CUP_volume"), 1, 1e-12);
  EXPECT_NEAR(bench.value("NET.supplied_l"), 1, 1e-9);
  EXPECT_NEAR(bench.value("NET.spilled_l"), 0.5, 1e-9);
  EXPECT_NEAR(bench.value("NET.CUP_overflow"), 0.1, 1e-9);
  EXPECT_NEAR(bench.value("NET.SPRING_flow"), 0.1, 1e-9);
}

TEST(WaterNetwork, AFloatSwimsWhereItDisplacesItsWeight) {
  state::WorldDescription world =
      network_world({{"vessels", {"TUB: area 0.1 m2, floor -0.1 m, height 0.5 m, start 10 l"}},
                     {"feeds", {"SPRING: into TUB, flow 1 l/s * step(TAP.angle > 0.5)"}},
                     {"floats", {"CORK: in TUB, of FLOAT.body, area 50 cm2, height 6 cm, bottom -1 cm"}}});
  world.bodies[world.find_body("FLOAT").index()].effort_scale = 0.2;
  Bench bench(world, Bench::Moved::by_dynamics);
  const double draught_m = 0.1 / 1000 / 0.005;
  bench.run(3);
  EXPECT_NEAR(bench.body("FLOAT").X_WB.p.y(), 0.01 - draught_m, 1e-4);
  EXPECT_NEAR(bench.value("NET.CORK_lift"), 0.1 * kGravity, 1e-3);
  const double before_m = bench.body("FLOAT").X_WB.p.y();
  bench.state->joints[0].position = 1;
  for (int i = 0; i < 10'000; ++i) {
    bench.joint().position = 1;
    bench.tick();
  }
  EXPECT_NEAR(bench.body("FLOAT").X_WB.p.y() - before_m, 0.1, 0.001) << "10 l more";
}

TEST(WaterNetwork, LoadsAreScaledLimitedAndFinite) {
  state::WorldDescription world =
      network_world({{"vessels", {"PAIL: area 0.05 m2, height 0.4 m, start 2 l, on HANDLE.body"}},
                     {"floats", {"CORK: in PAIL, of FLOAT.body, area 0.05 m2, height 5 m, bottom -5 m"}}});
  world.machines[0].parameters["limit"] = number(30);
  world.bodies[world.find_body("HANDLE").index()].effort_scale = 0.5;
  Bench bench(world);
  bench.tick();
  EXPECT_NEAR(bench.body("HANDLE").load_W.f.y(), -0.5 * 2 * kGravity, 1e-9);
  EXPECT_EQ(bench.body("FLOAT").load_W.f.y(), 30);
  bench.body("FLOAT").X_WB.p.y() = std::nan("");
  bench.tick();
  EXPECT_EQ(bench.body("FLOAT").load_W.f.y(), 0);
  EXPECT_EQ(bench.value("NET.CORK_lift"), 0);
}

/// A network of any vessels and pipes, and the water that it has at the start.
struct DrawnNetwork {
  NetworkTexts texts;
  int vessels = 0;
  double start_l = 0;
  std::vector<double> capacity_l;
};

DrawnNetwork draw_network() {
  DrawnNetwork out;
  out.vessels = *rc::gen::inRange(2, 6);
  std::vector<double> floors_m;
  for (int i = 0; i < out.vessels; ++i) {
    const int area_cm2 = *rc::gen::inRange(1, 300);
    out.capacity_l.push_back(0.05 * area_cm2);
    const double its_l = std::min<double>(*rc::gen::inRange(0, 9), 0.98 * out.capacity_l.back());
    out.start_l += its_l;
    floors_m.push_back(0.1 * *rc::gen::inRange(0, 20));
    out.texts["vessels"].push_back(
        fmt::format("V{}: area {} cm2, floor {} m, height 0.5 m, start {} l{}", i, area_cm2, floors_m.back(), its_l,
                    *rc::gen::elementOf(PartTexts{"", "", ", air ONE", ", air TWO, vent TAP.angle"})));
    if (i == 0) continue;
    const auto other = static_cast<std::size_t>(*rc::gen::inRange(0, i));
    out.texts["pipes"].push_back(
        fmt::format("P{}: from V{} at {} m, to V{} at {} m, bore {} mm{}", i, i, floors_m.back(), other,
                    floors_m[other] + 0.1, *rc::gen::inRange(1, 200),
                    *rc::gen::elementOf(PartTexts{"", ", oneway", ", open TAP.angle",
                                                  fmt::format(", crest {} m", floors_m.back() + 0.2)})));
  }
  out.texts["pipes"].push_back(fmt::format("OUT: from V0 at {} m, to air at -1 m, bore {} mm, open TAP.rate * 1 s",
                                           floors_m[0], *rc::gen::inRange(1, 50)));
  out.texts["feeds"].push_back(fmt::format("IN: into V1, flow {} l/s * TAP.angle", *rc::gen::inRange(0, 20)));
  return out;
}

RC_GTEST_PROP(WaterNetwork, NeitherMakesNorLosesWaterNorOverfillsNorOvershoots, ()) {
  const DrawnNetwork drawn = draw_network();
  Bench bench(network_world(drawn.texts));
  const auto moves = *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(-5, 15));
  for (int n = 0; n < 400; ++n) {
    bench.joint().position = bench.joint().velocity = 0.1 * moves[static_cast<std::size_t>(n / 50)];
    bench.tick();
    double sum_l = bench.value("NET.delivered_l") + bench.value("NET.spilled_l") - bench.value("NET.supplied_l");
    for (int i = 0; i < drawn.vessels; ++i) {
      const double water_l = bench.value(fmt::format("NET.V{}_volume", i));
      RC_ASSERT(std::isfinite(bench.value(fmt::format("NET.V{}_pressure", i))));
      RC_ASSERT(water_l >= 0 && water_l <= drawn.capacity_l[static_cast<std::size_t>(i)] * (1 + 1e-14));
      sum_l += water_l;
    }
    RC_ASSERT(std::abs(sum_l - drawn.start_l) < 1e-11);
  }
  RC_ASSERT(bench.value("NET.faults") == 0);
}

TEST(WaterNetwork, ASnapshotGoesOnToTheSameBitsAndATickAllocatesNothing) {
  const state::WorldDescription world = network_world(
      {{"vessels",
        {"A: area 0.01 m², height 1 m, start 6 l", "B: area 0.03 m^2, height 1 m, air IN, vent step(A_level < 1 cm)"}},
       {"pipes", {"P: from A at 0.1 m, to B at 0 m, bore 1 cm, crest 0.5 m, open 1 - sin(integral(1) * 1 Hz)^2"}},
       {"feeds", {"F: into A, flow count(TAP.angle > 1) * 1 ml/s"}},
       {"floats", {"CORK: in A, of FLOAT.body, area 50 cm2, height 6 cm"}}});
  Bench whole(world), again(world), resumed(world);
  whole.run(1);
  std::vector<std::byte> saved;
  state::write_snapshot(*whole.state, saved);
  ASSERT_TRUE(state::read_snapshot(saved, *resumed.state));
  whole.run(2);
  resumed.run(2);
  again.run(3);
  EXPECT_EQ(state::state_hash(*whole.state), state::state_hash(*resumed.state));
  EXPECT_EQ(state::state_hash(*whole.state), state::state_hash(*again.state));
  EXPECT_GT(whole.value("NET.B_volume"), 0);
  EXPECT_EQ(whole.allocations(1000), 0u);
}

TEST(WaterNetwork, ItsValuesAreNamedAsQuantitiesReadThem) {
  const state::WorldDescription world = network_world(
      {{"vessels", {"TUB : area 1 m2, height 1 m"}}, {"pipes", {"HOLE: from TUB at 0 m, to air, bore 1 cm"}}});
  std::vector<std::string> names;
  const Bench bench(world);
  for (const OwnValue& own : own_values(world.machines[0])) {
    names.push_back(own.name + " " + own.unit);
    EXPECT_EQ(bench.value("NET." + own.name), 0) << own.name;
  }
  EXPECT_THAT(names, testing::ElementsAre("TUB_level m", "TUB_volume l", "TUB_pressure Pa", "TUB_overflow l/s",
                                          "HOLE_flow l/s"));
}

TEST(WaterNetwork, WhatItNamesCanBeFoundAndRenamed) {
  const std::string text = "CORK: in TUB at 1.5 m, of FLOAT.body, area 2e-3 m2, open TAP.angle + quantity.wind / 1 m/s";
  std::vector<std::string> found;
  for (const FormulaName& name : names_in_formula(text))
    found.push_back((name.quantity ? "q:" : "") + text.substr(name.begin, name.length));
  EXPECT_THAT(found, testing::ElementsAre("FLOAT", "TAP", "q:wind"));
}

struct WrongPart {
  std::string list;
  std::string text;
  ErrorCode code;
  std::vector<std::string> words;
};

TEST(WaterNetwork, ErrorsSayWhichPartAndWhatToWrite) {
  const std::string tub = "TUB: area 0.02 m2, height 0.3 m";
  const std::string open = "P: from TUB at 0 m, to air, bore 1 cm";
  const std::vector<WrongPart> wrong = {
      {"vessels", "area 0.02 m2", ErrorCode::invalid_value, {"'area 0.02 m2'", "a colon", "TANK:"}},
      {"vessels", "V area 0.02 m2: height 1 m", ErrorCode::invalid_value, {"a colon"}},
      {"vessels", "V area 0.02 m2", ErrorCode::invalid_value, {"a colon"}},
      {"vessels", "1A: area 0.02 m2, height 1 m", ErrorCode::invalid_value, {"'1A"}},
      {"vessels", "air: area 0.02 m2, height 1 m", ErrorCode::invalid_value, {"not air"}},
      {"vessels", "V: area 0.02 m, height 1 m", ErrorCode::conflict, {"'0.02 m' is in m", "'area' takes m2", "'V'"}},
      {"vessels", "V: area 0.02, height 1 m", ErrorCode::conflict, {"a pure number"}},
      {"vessels", "V: area -0.02 m2, height 1 m", ErrorCode::invalid_value, {"'-0.02 m2'", "out of range", "m2"}},
      {"vessels", "V: area 0 m2, height 1 m", ErrorCode::invalid_value, {"out of range"}},
      {"vessels", "V: area 0.02 m2", ErrorCode::missing, {"no 'height'"}},
      {"vessels", "V: area 0.02 m2, hight 1 m", ErrorCode::unknown_name, {"'hight'", "height"}},
      {"vessels", "V: area 0.02 m2, height 1 m,", ErrorCode::unknown_name, {"''"}},
      {"vessels", "V: area 0.02 m2, height 1 m, height 2 m", ErrorCode::duplicate, {"'height'"}},
      {"vessels", "V: area 0.02 m2, height tall", ErrorCode::unknown_name, {"'tall'"}},
      {"vessels", "V: area 0.02 ells, height 1 m", ErrorCode::unknown_name, {"'ells' is not a unit"}},
      {"vessels", "V: area 0.02 m2, height TAP.angle * 1 m", ErrorCode::conflict, {"'height' would change"}},
      {"vessels", "V: area 0.02 m2, height 1 m, start 21 l", ErrorCode::conflict, {"20 l"}},
      {"vessels", "V: area 0.02 m2, height 1 m, start 20 l, air A", ErrorCode::conflict, {"19.8 l"}},
      {"vessels", "V: area 0.02 m2, height 1 m, air", ErrorCode::invalid_value, {"name of an air"}},
      {"vessels", "V: area 0.02 m2, height 1 m, vent 1", ErrorCode::missing, {"'air'"}},
      {"vessels", "V: area 0.02 m2, height 1 m, on FRAME.body", ErrorCode::unknown_name, {"'FRAME.body'", "HANDLE"}},
      {"vessels", "V: area 0.02 m2, height 1 m, on HANDLE", ErrorCode::unknown_name, {"HANDLE.body"}},
      {"vessels", tub, ErrorCode::duplicate, {"'TUB'"}},
      {"pipes", "P: to air, bore 1 cm", ErrorCode::missing, {"no 'from'"}},
      {"pipes", "P: from TUB at 0 m, bore 1 cm", ErrorCode::missing, {"no 'to'"}},
      {"pipes", "P: from TUB at 0 m, to air", ErrorCode::missing, {"no 'bore'"}},
      {"pipes", "P: from TUBE at 0 m, to air, bore 1 cm", ErrorCode::unknown_name, {"'TUBE'", "did you mean 'TUB'?"}},
      {"pipes", "P: from TUB at 0 m, to TUB at 0.1 m, bore 1 cm", ErrorCode::conflict, {"both ends", "'TUB'"}},
      {"pipes", "P: from air at 0 m, to TUB at 0.1 m, bore 1 cm", ErrorCode::conflict, {"a feed"}},
      {"pipes", "P: from TUB at 2 m, to air, bore 1 cm", ErrorCode::conflict, {"from 0 to 0.3 m"}},
      {"pipes", "P: from TUB, to air, bore 1 cm", ErrorCode::missing, {"no height"}},
      {"pipes", "P: from TUB at 0 l, to air, bore 1 cm", ErrorCode::conflict, {"'0 l'"}},
      {"pipes", "P: from TUB at 0 m, to air, bore -1 cm", ErrorCode::invalid_value, {"'-1 cm'"}},
      {"pipes", open + ", discharge 2", ErrorCode::invalid_value, {"from 0.01 to 1"}},
      {"pipes", open + ", open COCK.angle", ErrorCode::unknown_name, {"'COCK'", "letter"}},
      {"pipes", open + ", open GUIDE.position", ErrorCode::conflict, {"'GUIDE.position' is in m", "a pure number"}},
      {"pipes", open + ", open TAP.angle > 1", ErrorCode::conflict, {"step("}},
      {"pipes", open + ", oneway crest 1 m", ErrorCode::invalid_value, {"'crest 1 m'", "comma"}},
      {"pipes", open + ", crest -1 m", ErrorCode::conflict, {"-1 m"}},
      {"pipes", open + ", crest 12 m", ErrorCode::conflict, {"12 m"}},
      {"pipes", "TUB: from TUB at 0 m, to air, bore 1 cm", ErrorCode::duplicate, {"'TUB'"}},
      {"feeds", "F: into TUB", ErrorCode::missing, {"no 'flow'"}},
      {"feeds", "F: into TUB, flow 2 l", ErrorCode::conflict, {"'2 l' is in m3", "m3/s"}},
      {"feeds", "F: into TOB, flow 2 l/s", ErrorCode::unknown_name, {"'TOB'"}},
      {"floats", "F: in TUB, of CORK.body, area 1 cm2, height 1 cm", ErrorCode::unknown_name, {"'CORK.body'"}},
      {"floats", "F: in TUB, of FLOAT.body, area 0.03 m2, height 1 cm", ErrorCode::conflict, {"wider", "0.02 m2"}},
      {"pipes", open + ", open TUB.level / 1 m", ErrorCode::unknown_name, {"write TUB_level"}},
      {"floats", "F: in TUB, of FLOAT.body, area 1 cm2", ErrorCode::missing, {"no 'height'"}},
  };
  for (const WrongPart& part : wrong) {
    NetworkTexts texts{{"vessels", {tub}}};
    texts[part.list].push_back(part.text);
    EXPECT_THAT(error_of(network_world(texts)), is_error(part.code, line_of(part.list), part.words)) << part.text;
  }
  EXPECT_THAT(error_of(network_world({{"vessels", {"LAKE: area 9 m2, height 1 m"}},
                                      {"floats", {"F: in LAKE, of FLOAT.body, area 2 m2, height 1 cm"}}})),
              is_error(ErrorCode::conflict, line_of("floats"), {"too light", "0.2 kg"}));
  PartTexts many;
  for (int i = 0; i < 33; ++i)
    many.push_back(fmt::format("V{}: area 1 m2, height 1 m", i));
  EXPECT_THAT(error_of(network_world({{"vessels", many}})),
              is_error(ErrorCode::too_large, line_of("vessels"), {"33", "32"}));
  EXPECT_THAT(error_of(network_world({{"vessels", {}}})), is_error(ErrorCode::missing, line_of("vessels"), {"TANK:"}));
}

/// Any text of these pieces is refused with a place and a remedy, or runs.
RC_GTEST_PROP(WaterNetwork, AnyTextIsRefusedWithAPlaceOrRuns, ()) {
  static const PartTexts kPieces = {"TUB",   "V:",   ":",    ",",      " ",    "area",       "1 m2",      "height",
                                    "1 m",   "from", "to",   "air",    " at ", "in",         "of",        "into",
                                    "flow",  "l/s",  "bore", "1 cm",   "open", "(",          ")",         "vent",
                                    "crest", "1",    "-",    "oneway", "on",   "FLOAT.body", "TAP.angle", "\xce\xb1"};
  NetworkTexts texts{{"vessels", {"TUB: area 1 m2, height 1 m, start 10 l"}}};
  const std::string list = *rc::gen::elementOf(PartTexts{"vessels", "pipes", "feeds", "floats"});
  std::string text =
      *rc::gen::elementOf(PartTexts{"", "V: area 1 m2, height 1 m", "P: from TUB at 0 m, to air, bore 1 cm",
                                    "F: into TUB, flow 1 l/s", "C: in TUB, of FLOAT.body, area 1 cm2, height 1 cm"});
  for (int i = *rc::gen::inRange(0, 8); i > 0; --i)
    text += *rc::gen::elementOf(kPieces) + (*rc::gen::arbitrary<bool>() ? " " : "");
  texts[list].push_back(text);
  const state::WorldDescription world = network_world(texts);
  const Error error = error_of(world);
  if (!error.what.empty()) {
    RC_ASSERT(!error.remedy.empty());
    RC_ASSERT(error.line == line_of(list));
    return;
  }
  RC_TAG("runs");
  Bench bench(world);
  for (int i = 0; i < 5; ++i) {
    bench.tick();
    RC_ASSERT(std::ranges::all_of(bench.state->memory, [](double x) { return std::isfinite(x); }));
  }
}

}  // namespace
}  // namespace mechane::machines::test
