// Ktesibios' pump: what two cylinders lift, what they ask of the hand, and what a bad valve does.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

constexpr double kBore = 0.1, kStroke = 0.12, kLift = 2.0, kArm = 0.3, kHandleArm = 0.9, kLeather = 15, kScale = 0.05;
constexpr double kArea = kPi * kBore * kBore / 4;
constexpr double kColumn_n = 1000 * 9.81 * kLift * kArea;

state::WorldDescription pump_world() {
  state::WorldDescription world;
  world.effort_scale = kScale;
  const BodyId frame = add_body(world, "FRAME", 1, 1, true);
  add_joint(world, "BEAM", state::JointKind::hinge, frame, add_body(world, "ROCKER", 5, 1));
  world.machines = {{"PUMP",
                     "machine.force_pump",
                     {{"beam", text("BEAM")},
                      {"arm", number(kArm)},
                      {"handleArm", number(kHandleArm)},
                      {"bore", number(kBore)},
                      {"stroke", number(kStroke)},
                      {"lift", number(kLift)},
                      {"friction", number(kLeather)},
                      {"riser", number(0)},
                      {"cushion", number(0)}},
                     7}};
  return world;
}

state::WorldDescription pump_with(const std::string& name, const state::Parameter& value) {
  state::WorldDescription world = pump_world();
  world.machines[0].parameters[name] = value;
  return world;
}

/// Up and down at constant speed over the whole stroke, from level. `each_tick` looks on.
template <class Look>
void rock(Bench& pump, double cycles, double cycles_per_s, Look each_tick) {
  const double most = kStroke / 2 / kArm;
  const long ticks = std::lround(cycles / cycles_per_s / kTick);
  pump.move_to(0);
  for (long n = 1; n <= ticks; ++n) {
    const double phase = std::fmod(static_cast<double>(n) * kTick * cycles_per_s + 0.25, 1.0);
    pump.move_to(most * (phase < 0.5 ? 4 * phase - 1 : 3 - 4 * phase));
    each_tick();
  }
}
void rock(Bench& pump, double cycles, double cycles_per_s = 0.5) {
  rock(pump, cycles, cycles_per_s, [] {});
}

TEST(ForcePump, FlowIsAreaTimesStrokeTimesRateOfBothCylindersTimesTheEfficiency) {
  for (const double rate : {0.25, 0.5, 1.0}) {
    Bench pump(pump_world());
    rock(pump, 1, rate);  // the first strokes fill the cylinders
    const double before = pump.value("PUMP.lifted_l");
    rock(pump, 10, rate);
    const double per_cycle_l = 2 * 1000 * kArea * kStroke * 0.8;
    EXPECT_NEAR((pump.value("PUMP.lifted_l") - before) / 10, per_cycle_l, 0.01 * per_cycle_l) << rate << " cycles/s";
    rock(pump, 0.1, rate);
    EXPECT_NEAR(pump.value("PUMP.flow_l_per_s"), per_cycle_l * rate, 0.01 * per_cycle_l * rate);
  }
}

TEST(ForcePump, TheHandleCarriesOneColumnAndBothLeathersByTheBeamsRatio) {
  Bench pump(pump_world());
  rock(pump, 1.1);
  EXPECT_NEAR(pump.value("PUMP.force_n"), kColumn_n, 1e-9);
  EXPECT_NEAR(pump.value("PUMP.handle_n"), (kColumn_n + 2 * kLeather) / 3, 1e-9);
  EXPECT_NEAR(pump.joint().resistance, kScale * kArm * (kColumn_n + 2 * kLeather), 1e-9);
  EXPECT_EQ(pump.joint().load, 0) << "valves hold: the water does not drive the beam";
}

TEST(ForcePump, WorkOfTheHandIsWhatWasLiftedOverTheEfficiency) {
  state::WorldDescription world = pump_with("friction", number(0));
  Bench pump(world);
  double work_j = 0;
  rock(pump, 8, 0.5, [&] { work_j += pump.joint().resistance / kScale * std::abs(pump.joint().velocity) * kTick; });
  const double lifted_j = pump.value("PUMP.lifted_l") * 9.81 * kLift;
  EXPECT_GT(work_j, lifted_j);
  EXPECT_NEAR(work_j, lifted_j / 0.8, 0.01 * work_j);
}

TEST(ForcePump, TwoCylindersGiveAContinuousJetAndOneDoesNot) {
  const auto least_over_mean = [](double cylinders) {
    state::WorldDescription world = pump_with("cushion", number(0.3));
    world.machines[0].parameters["cylinders"] = number(cylinders);
    Bench pump(world);
    rock(pump, 4);
    double least = 1e9, sum = 0;
    int count = 0;
    rock(pump, 4, 0.5, [&] {
      least = std::min(least, pump.value("PUMP.jet_l_per_s"));
      sum += pump.value("PUMP.jet_l_per_s");
      ++count;
    });
    return least / (sum / count);
  };
  EXPECT_GT(least_over_mean(2), 0.9);
  EXPECT_LT(least_over_mean(1), 0.2);
}

TEST(ForcePump, TheFirstWaterComesWhenVesselAndPipeAreFull) {
  Bench pump(pump_with("riser", number(3)));
  double into_l = 0;
  rock(pump, 4, 0.5, [&] {
    into_l += pump.value("PUMP.flow_l_per_s") * kTick;
    if (into_l < 2.999) {
      ASSERT_EQ(pump.value("PUMP.lifted_l"), 0);
      ASSERT_NEAR(pump.value("PUMP.head_m"), kLift * into_l / 3, 0.01) << "the head grows with the column";
    }
  });
  EXPECT_NEAR(pump.value("PUMP.lifted_l"), into_l - 3, 1e-6);
  EXPECT_EQ(pump.value("PUMP.head_m"), kLift);
}

TEST(ForcePump, ABadValveLiftsNothing) {
  for (const char* valves : {"inletValves", "outletValves"}) {
    for (const char* how : {"reversed", "missing"}) {
      state::WorldDescription world = pump_with(valves, text(how));
      world.machines[0].parameters["riser"] = number(3);  // an outlet that lets water back needs some behind it
      Bench pump(world);
      rock(pump, 6);
      EXPECT_NEAR(pump.value("PUMP.lifted_l"), 0, 1e-3) << valves << " " << how;
    }
  }
}

TEST(ForcePump, ABadValveInOneCylinderTakesHalf) {
  Bench good(pump_world());
  Bench half(pump_with("inletValves", std::vector<std::string>{"good", "reversed"}));
  rock(good, 6);
  rock(half, 6);
  EXPECT_NEAR(half.value("PUMP.lifted_l") / good.value("PUMP.lifted_l"), 0.5, 0.05);
}

TEST(ForcePump, AReversedOutletLocksThePistons) {
  Bench pump(pump_with("outletValves", text("reversed")));
  double most_n = 0;
  rock(pump, 2, 0.5, [&] { most_n = std::max(most_n, pump.value("PUMP.force_n")); });
  EXPECT_GT(most_n, 10 * kColumn_n);
  EXPECT_GT(pump.value("PUMP.leaked_l"), 1);
}

TEST(ForcePump, SlidersMoveThePistonsAsABeamDoes) {
  state::WorldDescription world = pump_world();
  add_joint(world, "LEFT", state::JointKind::slider, BodyId(0), add_body(world, "PISTON1", 2, 1));
  add_joint(world, "RIGHT", state::JointKind::slider, BodyId(0), add_body(world, "PISTON2", 2, 1));
  auto& parameters = world.machines[0].parameters;
  parameters.erase("beam");
  parameters["pistons"] = std::vector<std::string>{"LEFT", "RIGHT"};
  Bench beam(pump_world()), sliders(world);
  rock(beam, 3.1, 0.5, [&] {
    const double x = kArm * beam.joint().position, v = kArm * beam.joint().velocity;
    for (const double side : {1.0, -1.0}) {
      state::JointState& joint = sliders.joint(side > 0 ? 1 : 2);
      joint.position = kStroke / 2 + side * x;
      joint.velocity = side * v;
    }
    sliders.tick();
  });
  EXPECT_NEAR(sliders.value("PUMP.lifted_l"), beam.value("PUMP.lifted_l"), 0.02);
  const auto [low, high] = std::minmax(sliders.joint(1).resistance, sliders.joint(2).resistance);
  EXPECT_NEAR(low, kScale * kLeather, 1e-9) << "the rising piston carries no water";
  EXPECT_NEAR(high, kScale * (kLeather + kColumn_n), 1e-9);
}

TEST(ForcePump, CountsHowOftenItTurnsRound) {
  Bench pump(pump_world());
  rock(pump, 5.2);
  EXPECT_EQ(pump.value("PUMP.strokes"), 10);
}

TEST(ForcePump, WithoutItsBeamNothingMoves) {
  Bench pump(pump_world());
  pump.joint().enabled = false;
  rock(pump, 3);
  EXPECT_EQ(pump.value("PUMP.lifted_l"), 0);
  EXPECT_EQ(pump.joint().resistance, 0);
}

RC_GTEST_PROP(ForcePump, HoweverItIsMovedItLiftsNoMoreThanTheWorkPutIn, ()) {
  const std::vector<std::string> states{"good", "reversed", "missing"};
  state::WorldDescription world = pump_with("riser", number(*rc::gen::inRange(0, 4)));
  auto& parameters = world.machines[0].parameters;
  parameters["friction"] = number(0);
  parameters["cushion"] = number(0.1 * *rc::gen::inRange(0, 4));
  if (*rc::gen::inRange(0, 3) == 0)
    parameters["outletValves"] = std::vector<std::string>{*rc::gen::elementOf(states), *rc::gen::elementOf(states)};
  Bench pump(world);
  double work_j = 0, potential_j = 0;
  for (int i = 0; i < 30; ++i) {
    const double to = 0.01 * *rc::gen::inRange(-25, 26);
    const int ticks = *rc::gen::inRange(20, 2000);
    const double from = pump.joint().position;
    for (int n = 1; n <= ticks; ++n) {
      pump.move_to(from + (to - from) * n / ticks);
      work_j += pump.joint().resistance / kScale * std::abs(pump.joint().velocity) * kTick;
      potential_j += std::max(0.0, pump.value("PUMP.flow_l_per_s")) * kTick * 9.81 * pump.value("PUMP.head_m");
    }
  }
  RC_ASSERT(potential_j <= work_j + 1e-9);
  RC_ASSERT(pump.value("PUMP.lifted_l") * 9.81 * kLift <= work_j + 1e-9 ||
            world.machines[0].parameters["riser"] != number(0));
  RC_ASSERT(pump.value("PUMP.lifted_l") >= 0 && pump.value("PUMP.leaked_l") >= 0);
}

TEST(ForcePump, ATickAllocatesNothing) {
  Bench pump(pump_world());
  EXPECT_EQ(pump.allocations(3000), 0u);
}

TEST(ForcePump, ErrorsSayWhatToWrite) {
  EXPECT_THAT(
      error_of(pump_with("inletValves", text("upside down"))),
      is_error(ErrorCode::unknown_name, line_of("inletValves"), {"'upside down'", "good, reversed or missing"}));
  EXPECT_THAT(error_of(pump_with("inletValves", std::vector<std::string>{"good", "good", "good"})),
              is_error(ErrorCode::invalid_value, line_of("inletValves"), {"3 words", "2 cylinders"}));
  EXPECT_THAT(error_of(pump_with("pistons", text("BEAM"))),
              is_error(ErrorCode::conflict, line_of("beam"), {"'pistons'", "'beam'"}));
  EXPECT_THAT(error_of(pump_with("cylinders", number(1.5))),
              is_error(ErrorCode::invalid_value, line_of("cylinders"), {"'cylinders'", "1.5"}));
  state::WorldDescription world = pump_world();
  world.machines[0].parameters.erase("arm");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, line_of("beam"), {"'arm'"}));
  world = pump_world();
  world.joints[0].kind = state::JointKind::slider;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("beam"),
                                        {"machine.force_pump PUMP", "'BEAM'", "SingleAxisHingeJoint"}));
}

}  // namespace
}  // namespace mechane::machines::test
