// The screw as a machine: what comes out, what it asks of the crank, where the water stays.
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/machines/machine_set.hpp"
#include "server/machines/registry.hpp"
#include "server/machines/screw_geometry.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/parameter_lines.hpp"
#include "tests/support/sanitizers.hpp"

namespace mechane::machines {
namespace {

using mechane::test::is_error;
using mechane::test::line_of;
using state::EventKind;

constexpr double kStep = 1e-3;
constexpr double kLength = 2.4, kPitch = 2 * kPi * 0.075;

/// Vitruvius' screw of 0.3 m, lifting 1 m; effort_scale 0.06.
state::WorldDescription screw_world() {
  state::WorldDescription world;
  world.effort_scale = 0.06;
  world.bodies.resize(2);
  state::JointDescription joint;
  joint.name = "CRANK";
  joint.body1 = BodyId(0);
  joint.body2 = BodyId(1);
  world.joints = {joint};
  const auto number = [](double x) { return std::vector<double>{x}; };
  world.machines = {{"PUMP",
                     "machine.screw_pump",
                     {{"joint", std::vector<std::string>{"CRANK"}},
                      {"diameter", number(0.3)},
                      {"length", number(kLength)},
                      {"lift", number(1.0)},
                      {"basinArea", number(0.25)},
                      {"basinCapacity", number(80)}},
                     12}};
  return world;
}

struct Pump {
  state::WorldDescription world;
  state::MemoryLayout layout;
  std::unique_ptr<MachineSet> machines;
  std::unique_ptr<state::WorldState> state;
  double work_j = 0;  ///< at the crank, unscaled

  explicit Pump(state::WorldDescription from = screw_world()) : world(std::move(from)) {
    auto made = MachineSet::create(world, layout);
    if (!made) throw std::runtime_error(made.error().to_string());
    machines = std::move(*made);
    if (auto linked = machines->link(layout); !linked) throw std::runtime_error(linked.error().to_string());
    state = std::make_unique<state::WorldState>(world);
    state->memory = layout.initial();
    state->joints[0].enabled = true;
  }
  [[nodiscard]] double value(const std::string& name) const {
    return state->memory[layout.find("PUMP." + name)->index];
  }
  void turn(double rate_rad_s, double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n) {
      state->joints[0].velocity = rate_rad_s;
      state->joints[0].resistance = 0;
      state->event_count = 0;
      machines->run(*state, kStep);
      work_j += value("torque_nm") * std::abs(rate_rad_s) * kStep;
    }
  }
  void turns(double rate_rad_s, double count) { turn(rate_rad_s, 2 * kPi * count / std::abs(rate_rad_s)); }
};

double volume_m3() {
  return volume_per_turn_m3({0.15, 0.075, kPitch, 8, std::atan(0.75)});
}
constexpr double kFillTurns = kLength / kPitch;

TEST(ScrewPump, WaterComesOutWhenTheScrewHasFilledAndThenVolumePerTurn) {
  Pump pump;
  pump.turns(2.0, kFillTurns - 0.2);
  EXPECT_EQ(pump.value("lifted_l"), 0) << "the first bucket is on its way";
  pump.turns(2.0, 0.4);
  EXPECT_GT(pump.value("lifted_l"), 0);
  const double before = pump.value("lifted_l");
  pump.turns(2.0, 5);
  EXPECT_NEAR(pump.value("lifted_l") - before, 5 * 1000 * volume_m3(), 0.01);
  EXPECT_NEAR(pump.value("flow_l_per_s"), 1000 * volume_m3() * 2.0 / (2 * kPi), 1e-3);
  EXPECT_NEAR(pump.value("level_m"), pump.value("basin_l") / 1000 / 0.25, 1e-12);
}

TEST(ScrewPump, AFullScrewOfThirtyCentimetresAsksForTwelveNewtonMetres) {
  Pump pump;
  EXPECT_EQ(pump.value("torque_nm"), 0);
  pump.turns(2.0, kFillTurns + 1);
  EXPECT_NEAR(pump.value("torque_nm"), volume_m3() * 1000 * 9.81 * 1.0 / (2 * kPi) / 0.7, 0.2);
  EXPECT_NEAR(pump.value("torque_nm"), 12.6, 0.2);
  EXPECT_NEAR(pump.state->joints[0].resistance, 0.06 * pump.value("torque_nm"), 1e-12)
      << "felt by the world's effort_scale";
  EXPECT_EQ(pump.state->joints[0].load, 0) << "the water holds, it does not drive";
}

TEST(ScrewPump, TorqueGrowsWithTheFilledShare) {
  Pump pump;
  double last = 0;
  for (int i = 0; i < 5; ++i) {
    pump.turns(2.0, kFillTurns / 5);
    EXPECT_GT(pump.value("torque_nm"), last + 1);
    EXPECT_NEAR(pump.value("torque_nm") / 12.63, pump.value("filled"), 0.01);
    last = pump.value("torque_nm");
  }
}

TEST(ScrewPump, WorkAtTheCrankIsAtLeastTheWaterLifted) {
  Pump pump;
  pump.turns(3.0, 12);
  const double lifted_j = pump.value("lifted_l") * 9.81 * 1.0;
  EXPECT_GT(pump.work_j, lifted_j);
  // What is still in the screw has been lifted half way on average; all of it at an efficiency of 0.7.
  const double inside_j = pump.value("filled") * kFillTurns * volume_m3() * 1000 * 9.81 * 0.5;
  EXPECT_NEAR(pump.work_j, (lifted_j + inside_j) / 0.7, 0.03 * pump.work_j);
}

TEST(ScrewPump, AboveMuyskensLimitMoreAndMoreRunsBack) {
  state::WorldDescription world = screw_world();
  world.machines[0].parameters["basinCapacity"] = std::vector<double>{1e6};
  const double limit = muysken_limit_rad_s(0.3);
  const auto flow_at = [&](double rate) {
    Pump pump(world);
    pump.turns(rate, kFillTurns + 3);
    return std::pair{pump.value("flow_l_per_s"), pump.value("spill_l_per_s")};
  };
  const double full = 1000 * volume_m3() * limit / (2 * kPi);
  EXPECT_NEAR(flow_at(0.5 * limit).first, 0.5 * full, 0.01 * full);
  EXPECT_NEAR(flow_at(limit).first, full, 0.01 * full);
  EXPECT_NEAR(flow_at(limit).second, 0, 1e-9);
  const auto [flow_fast, spill_fast] = flow_at(1.5 * limit);
  const auto [flow_faster, spill_faster] = flow_at(2.0 * limit);
  EXPECT_NEAR(flow_fast, full / 1.5, 0.01 * full);
  EXPECT_NEAR(flow_fast + spill_fast, 1.5 * full, 0.01 * full) << "nothing is lost";
  EXPECT_LT(flow_faster, flow_fast);
  EXPECT_GT(spill_faster, spill_fast);
}

TEST(ScrewPump, TurningBackEmptiesTheScrewAndLiftsNothing) {
  Pump pump;
  pump.turns(2.0, kFillTurns + 1);
  const double lifted = pump.value("lifted_l");
  const double forward_nm = pump.value("torque_nm");
  pump.turns(-2.0, 0.1);
  EXPECT_NEAR(pump.value("torque_nm") / forward_nm, 0.3, 0.02) << "only the losses";
  pump.turns(-2.0, kFillTurns + 1);
  EXPECT_NEAR(pump.value("filled"), 0, 1e-9);
  EXPECT_EQ(pump.value("lifted_l"), lifted);
  EXPECT_EQ(pump.state->joints[0].resistance, 0);
}

TEST(ScrewPump, StandingStillLeaksSlowly) {
  Pump pump;
  pump.turns(2.0, kFillTurns + 1);
  const double lifted = pump.value("lifted_l");
  pump.turn(0, 20);
  EXPECT_NEAR(pump.value("filled"), std::exp(-1.0), 0.02);
  EXPECT_EQ(pump.value("lifted_l"), lifted);
  EXPECT_EQ(pump.state->joints[0].load, 0);
}

/// What a solver leaves of the speed of a screw at rest. Going back through no way at all would bring a whole bucket to the river.
TEST(ScrewPump, ThatTremblesByRoundingDrawsNoWater) {
  Pump pump;
  for (const double rate_rad_s : {-1e-17, 1e-17, -1e-30, 1e-30})
    pump.turn(rate_rad_s, kStep);
  EXPECT_EQ(pump.value("filled"), 0);
}

TEST(ScrewPump, TheBasinOverflowsAtItsRimAndSaysSoTwiceASecond) {
  state::WorldDescription world = screw_world();
  world.machines[0].parameters["basinStart"] = std::vector<double>{80};
  Pump pump(world);
  pump.turns(3.0, kFillTurns + 1);
  double said_l = 0;
  int events = 0;
  const double before_l = pump.value("lifted_l");
  for (int n = 0; n < 3000; ++n) {
    pump.turn(3.0, kStep);
    for (const state::Event& event : pump.state->event_span()) {
      EXPECT_EQ(event.kind, EventKind::spilled);
      EXPECT_EQ(event.subject, 0u);
      said_l += 1000 * event.value;
      ++events;
    }
  }
  EXPECT_GE(events, 5);
  EXPECT_LE(events, 7);
  EXPECT_NEAR(said_l, pump.value("lifted_l") - before_l, 1.6) << "what ran over, but for half a second's worth";
  EXPECT_EQ(pump.value("basin_l"), 80);
  EXPECT_NEAR(pump.value("level_m"), 0.32, 1e-12);
}

RC_GTEST_PROP(ScrewPump, LosesNoWaterHoweverItIsTurned, ()) {
  Pump pump;
  const double fill_m3 = kFillTurns * volume_m3();
  for (int i = 0; i < 12; ++i) {
    pump.turn(0.5 * *rc::gen::inRange(-20, 21), 0.1 * *rc::gen::inRange(1, 20));
    RC_ASSERT(pump.value("filled") >= 0 && pump.value("filled") <= 1);
    RC_ASSERT(pump.value("torque_nm") >= 0);
    RC_ASSERT(pump.value("basin_l") >= 0 && pump.value("basin_l") <= 80);
  }
  const double before = pump.value("lifted_l"), inside = pump.value("filled") * fill_m3;
  pump.turns(3.0, 2 * kFillTurns);
  // All that was inside, and what a full river gave since, less what fills the screw now.
  const double came = (pump.value("lifted_l") - before) / 1000;
  RC_ASSERT(came <= inside + kFillTurns * volume_m3() + 1e-3);
  RC_ASSERT(came >= kFillTurns * volume_m3() - 1e-3);
}

TEST(ScrewPump, AHingeThatIsOffMovesNoWater) {
  Pump pump;
  pump.state->joints[0].enabled = false;
  pump.turns(3.0, 10);
  EXPECT_EQ(pump.value("filled"), 0);
}

TEST(ScrewPump, ATickAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Pump pump;
  const mechane::test::AllocationGuard guard;
  for (int n = 0; n < 5000; ++n) {
    pump.state->joints[0].velocity = 30;
    pump.state->event_count = 0;
    pump.machines->run(*pump.state, kStep);
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

Error error_of(state::WorldDescription world) {
  mechane::test::number_lines(world.machines);
  state::MemoryLayout layout;
  auto made = MachineSet::create(world, layout);
  return made ? Error{} : made.error();
}

TEST(MachineSet, ErrorsNameTheMachineItsLineAndTheRemedy) {
  state::WorldDescription world = screw_world();
  world.machines[0].type = "machine.perpetuum";
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::unknown_name, 12,
                       {"line 12, machine.perpetuum PUMP", "'machine.perpetuum'", "machine.screw_pump"}));
  const auto with = [](const std::string& name, const state::Parameter& value) {
    state::WorldDescription changed = screw_world();
    changed.machines[0].parameters[name] = value;
    return error_of(changed);
  };
  const auto wrong = [](const char* parameter, const std::vector<std::string>& words = {}) {
    return is_error(ErrorCode::invalid_value, line_of(parameter), words);
  };
  EXPECT_THAT(with("diametre", std::vector<double>{1}),
              is_error(ErrorCode::unknown_name, line_of("diametre"), {"'diametre'", "use one of: joint, diameter"}));
  EXPECT_THAT(with("diameter", std::vector<double>{0}), wrong("diameter", {"from 0.01 to 20"}));
  EXPECT_THAT(with("diameter", std::vector<double>{std::nan("")}), wrong("diameter", {"finite"}));
  EXPECT_THAT(with("diameter", std::vector<double>{1, 2}), wrong("diameter", {"2 numbers", "write 1"}));
  EXPECT_THAT(with("diameter", true), wrong("diameter", {"one number"}));
  EXPECT_THAT(with("joint", std::vector<std::string>{"AXLE"}),
              is_error(ErrorCode::unknown_name, line_of("joint"), {"'AXLE'", "name one of: CRANK"}));
  EXPECT_THAT(with("slope", std::vector<double>{0.9}), is_error(ErrorCode::conflict, line_of("slope")));
  EXPECT_THAT(with("coreDiameter", std::vector<double>{0.3}), is_error(ErrorCode::conflict, line_of("coreDiameter")));
  EXPECT_THAT(with("blades", std::vector<double>{2.5}), wrong("blades", {"2.5"}));
  EXPECT_THAT(with("length", std::vector<double>{150}), is_error(ErrorCode::conflict, line_of("length"), {"256"}));
  world = screw_world();
  world.machines[0].parameters.erase("lift");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, 12, {"'lift'", "from the river's surface"}));
}

TEST(Registry, EveryTypeSaysWhatItsParametersAndValuesAre) {
  for (const state::ComponentType& type : registry()) {
    EXPECT_FALSE(type.summary.empty());
    for (const auto& p : type.parameters)
      EXPECT_FALSE(p.summary.empty()) << type.name << " " << p.name;
    for (const auto& v : type.values)
      EXPECT_FALSE(v.summary.empty()) << type.name << " " << v.name;
  }
}

}  // namespace
}  // namespace mechane::machines
