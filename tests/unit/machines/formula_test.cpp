// machine.formula: values and loads against closed forms; units, faults and names as authors write them; any text at all.
#include <bit>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/machines/formula_names.hpp"
#include "server/machines/registry.hpp"
#include "server/machines/unit.hpp"
#include "server/state/snapshot.hpp"
#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

using FormulaTexts = std::vector<std::string>;

/// A wheel on the hinge ARM, a box on the slider ROD, and the quantity `water`, in litres.
state::WorldDescription formula_world(const FormulaTexts& values,
                                      const std::map<std::string, std::string>& loads = {}) {
  state::WorldDescription world;
  const BodyId frame = add_body(world, "FRAME", 1, 1, true);
  add_joint(world, "ARM", state::JointKind::hinge, frame, add_body(world, "WHEEL", 2, 0.05));
  add_joint(world, "ROD", state::JointKind::slider, frame, add_body(world, "BOX", 2, 0.05));
  for (state::BodyDescription& body : world.bodies)
    body.use_gravity = false;
  world.quantities.push_back({"water", "TUB.basin_l", "l"});
  world.machines = {{"OWN", "machine.formula", {{"values", values}}, 7}};
  for (const auto& [key, formula] : loads)
    world.machines[0].parameters[key] = text(formula);
  return world;
}

/// The value of a formula after one tick.
double value_of(const std::string& formula, const std::string& unit = "1") {
  Bench bench(formula_world({"x = " + formula + " in " + unit}));
  bench.tick();
  return bench.value("OWN.x");
}

Error error_in(const std::string& formula) {
  return error_of(formula_world({"x = " + formula}));
}

TEST(FormulaMachine, ComputesAsItIsWritten) {
  EXPECT_EQ(value_of("1 + 2 * 3 - 4 / 2"), 5);
  EXPECT_EQ(value_of("-2^2 + (1 + 1)^3 * 2^-1"), 0);
  EXPECT_EQ(value_of("10 - 3 - 2"), 5);
  EXPECT_EQ(value_of("min(3, 1, 2) + max(3, 1, 2) * 10"), 31);
  EXPECT_EQ(value_of("abs(-2) + sqrt(9) + clamp(7, 0, 5)"), 10);
  EXPECT_DOUBLE_EQ(value_of("sin(pi / 6) + cos(60 deg)"), 1);
  EXPECT_EQ(value_of("if(1 < 2 and not 2 <= 1, 3, 4) + step(1 >= 2 or 2 > 1)"), 4);
}

TEST(FormulaMachine, UnitsAreConverted) {
  EXPECT_NEAR(value_of("2 m / 4 s", "km/h"), 1.8, 1e-12);
  EXPECT_NEAR(value_of("1 m^3 + 5 l", "l"), 1005, 1e-9);
  EXPECT_NEAR(value_of("sqrt(2 * 9.81 m/s^2 * 50 cm)", "m/s"), std::sqrt(9.81), 1e-12);
  EXPECT_NEAR(value_of("3 N m/rad * 2 rad", "N m"), 6, 1e-12);
  EXPECT_NEAR(value_of("60 rpm", "rad/s"), 2 * kPi, 1e-12);
  EXPECT_NEAR(value_of("20 degC", "K"), 293.15, 1e-12);
  EXPECT_NEAR(value_of("1000 kg/m3 * 9.81 m/s2 * 10 m", "bar"), 0.981, 1e-12);
  EXPECT_NEAR(value_of("6/min", "Hz"), 0.1, 1e-12);
  EXPECT_NEAR(value_of("2 cm² * 3 m/s² * 1 kg/m³", "g/s^2"), 0.6, 1e-12);
  EXPECT_NEAR(value_of("2 cm2", "mm²"), 200, 1e-9);
}

TEST(FormulaMachine, ReadsJointsQuantitiesAndItsOwnValues) {
  Bench bench(formula_world({"turned = ARM.angle in turns", "speed = ROD.rate in cm/s",
                             "depth = quantity.water / 0.1 m^2 in cm", "twice = 2 * depth in cm"}));
  bench.joint(0).position = kPi;
  bench.joint(1).velocity = 0.5;
  bench.quantity("water") = 5;
  bench.tick();
  EXPECT_DOUBLE_EQ(bench.value("OWN.turned"), 0.5);
  EXPECT_DOUBLE_EQ(bench.value("OWN.speed"), 50);
  EXPECT_NEAR(bench.value("OWN.depth"), 5, 1e-12);
  EXPECT_NEAR(bench.value("OWN.twice"), 10, 1e-12);
}

/// A vessel of 0.02 m2 that empties through a hole of 0.5 cm2, by Torricelli: sqrt(h) falls evenly.
TEST(FormulaMachine, AVesselEmptiesInTorricellisTime) {
  Bench bench(formula_world({"out = 0.6 * 0.5e-4 m^2 * sqrt(2 * 9.81 m/s^2 * last(level)) in l/s",
                             "volume = integral(-out, 4 l, 0, 10 l) in l", "level = volume / 0.02 m^2 in m"}));
  EXPECT_NEAR(bench.value("OWN.volume"), 4, 1e-12) << "before the first tick";
  EXPECT_NEAR(bench.value("OWN.level"), 0.2, 1e-12);
  const double full_s = 0.02 / (0.6 * 0.5e-4) * std::sqrt(2 * 0.2 / 9.81);
  bench.run(full_s / 2);
  EXPECT_NEAR(bench.value("OWN.level"), 0.05, 0.0005);
  bench.run(full_s / 2 * 0.98);
  EXPECT_GT(bench.value("OWN.volume"), 0);
  bench.run(full_s * 0.02);
  EXPECT_NEAR(bench.value("OWN.volume"), 0, 1e-3);
  EXPECT_EQ(bench.value("OWN.faults"), 0);
}

TEST(FormulaMachine, CountsHowOftenAConditionBecomesTrue) {
  Bench bench(
      formula_world({"strokes = count(ARM.position > 0.5) in 1", "lifted = sum(0.25 l, ARM.position > 0.5) in l"}));
  bench.joint().position = 1;
  bench.tick();
  EXPECT_EQ(bench.value("OWN.strokes"), 0) << "it held from the start";
  for (int i = 0; i < 3; ++i) {
    for (const double at : {0.0, 0.1, 0.6, 0.9}) {
      bench.joint().position = at;
      bench.tick();
    }
  }
  EXPECT_EQ(bench.value("OWN.strokes"), 3);
  EXPECT_NEAR(bench.value("OWN.lifted"), 0.75, 1e-12);
}

TEST(FormulaMachine, AnIntegralStaysWithinItsLimits) {
  Bench bench(formula_world({"x = integral(ROD.rate, 1 m, 0 m, 2 m) in m"}));
  bench.joint(1).velocity = 1;
  bench.run(0.5);
  EXPECT_NEAR(bench.value("OWN.x"), 1.5, 1e-9);
  bench.run(5);
  EXPECT_EQ(bench.value("OWN.x"), 2);
  bench.joint(1).velocity = -1;
  bench.run(0.5);
  EXPECT_NEAR(bench.value("OWN.x"), 1.5, 1e-9);
}

TEST(FormulaMachine, ASpringSwingsInItsTime) {
  state::WorldDescription world = formula_world({}, {{"joint", "ARM"}, {"load", "-0.2 N m/rad * (ARM.position - 1)"}});
  Bench bench(world, Bench::Moved::by_dynamics);
  double farthest = 0;
  const double period_s = 2 * kPi * std::sqrt(0.05 / 0.2);
  bench.run(period_s / 2);
  EXPECT_NEAR(bench.joint().position, 2, 0.01);
  bench.run(period_s / 2);
  EXPECT_NEAR(bench.joint().position, 0, 0.02);
  for (int i = 0; i < 3000; ++i) {
    bench.tick();
    farthest = std::max(farthest, bench.joint().position);
  }
  EXPECT_NEAR(farthest, 2, 0.02);
}

TEST(FormulaMachine, LoadsAreScaledAndLimited) {
  state::WorldDescription world = formula_world({}, {{"joint", "ROD"}, {"load", "1e6 N"}, {"resistance", "-5 N"}});
  world.machines[0].parameters["limit"] = number(40);
  world.machines[0].parameters["effortScale"] = number(0.1);
  Bench bench(world);
  bench.tick();
  EXPECT_DOUBLE_EQ(bench.joint(1).load, 4);
  EXPECT_EQ(bench.joint(1).resistance, 0);
  bench.joint(1).enabled = false;
  bench.tick();
  EXPECT_EQ(bench.joint(1).load, 0);
}

TEST(FormulaMachine, PushesABodyAlongItsAxisAtAPoint) {
  state::WorldDescription world = formula_world({}, {{"body", "BOX"}, {"force", "3 N"}, {"torque", "2 N m"}});
  world.machines[0].parameters["axis"] = vector(0, 0, 2);
  world.machines[0].parameters["point"] = vector(0.5, 0, 0);
  Bench bench(world);
  bench.body("BOX").X_WB.R = Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  bench.tick();
  EXPECT_TRUE(bench.body("BOX").load_W.f.isApprox(Vec3(0, -3, 0), 1e-12)) << bench.body("BOX").load_W.f;
  EXPECT_TRUE(bench.body("BOX").load_W.t.isApprox(Vec3(0, -2, -1.5), 1e-12)) << bench.body("BOX").load_W.t;
}

TEST(FormulaMachine, WhatDoesNotExistIsZeroAndCounted) {
  EXPECT_EQ(value_of("1 / 0"), 0);
  EXPECT_EQ(value_of("sqrt(-1)"), 0);
  EXPECT_EQ(value_of("(1e30)^9"), 1e30);
  EXPECT_EQ(value_of("0^-1"), 0);
  Bench bench(
      formula_world({"x = 1 / quantity.water in 1/l", "y = if(quantity.water > 0, 1 / quantity.water, 0) in 1/l"},
                    {{"joint", "ARM"}, {"load", "1 N m l * y"}}));
  bench.run(0.01);
  EXPECT_EQ(bench.value("OWN.faults"), 10) << "of x: the branch of y was not taken";
  bench.quantity("water") = std::nan("");
  bench.joint().velocity = std::numeric_limits<double>::infinity();
  bench.run(0.01);
  EXPECT_TRUE(std::isfinite(bench.joint().load));
  bench.quantity("water") = 2;
  const double before = bench.value("OWN.faults");
  bench.tick();
  EXPECT_EQ(bench.value("OWN.faults"), before);
}

TEST(FormulaMachine, ASnapshotGoesOnToTheSameBits) {
  const state::WorldDescription world =
      formula_world({"a = integral(sin(integral(1)/1 s), 0 s) in s", "n = count(sin(a * 9/s) > 0.2) in 1"});
  const auto move = [](Bench& bench, int from, int to) {
    for (int i = from; i < to; ++i) {
      bench.joint().position = 0.01 * i;
      bench.tick();
    }
  };
  Bench whole(world);
  move(whole, 0, 3000);
  std::vector<std::byte> saved;
  state::write_snapshot(*whole.state, saved);
  move(whole, 3000, 6000);
  Bench resumed(world);
  ASSERT_TRUE(state::read_snapshot(saved, *resumed.state));
  move(resumed, 3000, 6000);
  EXPECT_EQ(state::state_hash(*whole.state), state::state_hash(*resumed.state));
  EXPECT_GT(whole.value("OWN.n"), 1);
  EXPECT_EQ(whole.value("OWN.n"), resumed.value("OWN.n"));
}

TEST(FormulaMachine, ATickAllocatesNothing) {
  Bench bench(formula_world({"v = integral(ARM.rate * 0.1 m, 0, 0, 5 m) in m", "n = count(v > 1 m) in 1"},
                            {{"joint", "ARM"}, {"load", "-1 N * v"}}));
  EXPECT_EQ(bench.allocations(5000), 0u);
}

TEST(FormulaMachine, ErrorsSayWhichPartHasWhichUnitAndWhatToWrite) {
  const auto values = [](ErrorCode code, const std::vector<std::string>& words) {
    return is_error(code, line_of("values"), words);
  };
  EXPECT_THAT(
      error_in("ROD.position + 2 s"),
      values(ErrorCode::conflict, {"'ROD.position' is in m", "'2 s' after the '+' is in s", "letter 5", "same unit"}));
  EXPECT_THAT(error_in("1 m > 2 kg and 1 < 2"), values(ErrorCode::conflict, {"'2 kg'"}));
  EXPECT_THAT(error_in("if(1, 2, 3)"), values(ErrorCode::conflict, {"'1' is a pure number, not a condition"}));
  EXPECT_THAT(error_in("1 < 2"), values(ErrorCode::conflict, {"step("}));
  EXPECT_THAT(error_in("sin(2 m)"), values(ErrorCode::conflict, {"'2 m' is in m"}));
  EXPECT_THAT(error_in("sqrt(sqrt(2 m))"), values(ErrorCode::conflict, {"no square root"}));
  EXPECT_THAT(error_in("min(1 m, 2)"), values(ErrorCode::conflict, {"'2' is a pure number"}));
  EXPECT_THAT(error_in("integral(ROD.rate, 2 s)"),
              values(ErrorCode::conflict, {"the integral over time of 'ROD.rate' is in m"}));
  EXPECT_THAT(error_in("integral(1, quantity.water)"), values(ErrorCode::conflict, {"'quantity.water'"}));
  EXPECT_THAT(error_in("integral(1, ARM.angle * 1 s)"), values(ErrorCode::conflict, {"not a constant"}));
  EXPECT_THAT(error_in("2 furlongs"), values(ErrorCode::unknown_name, {"'furlongs' is not a unit", "cm"}));
  EXPECT_THAT(error_in("2 m/s kg"), values(ErrorCode::invalid_value, {"another slash"}));
  EXPECT_THAT(error_in("ARMS.position"), values(ErrorCode::unknown_name, {"'ARMS'", "ARM"}));
  EXPECT_THAT(error_in("ARM.height"), values(ErrorCode::unknown_name, {"'height'", "ARM.angle"}));
  EXPECT_THAT(error_in("quantity.wine"), values(ErrorCode::unknown_name, {"'wine'", "water"}));
  EXPECT_THAT(error_in("squrt(2)"), values(ErrorCode::unknown_name, {"'squrt'", "sqrt"}));
  EXPECT_THAT(error_in("2 +"), values(ErrorCode::missing, {"ends where a number is needed"}));
  EXPECT_THAT(error_in("(2"), values(ErrorCode::invalid_value, {"')'"}));
  EXPECT_THAT(error_in("2 ) 3"), values(ErrorCode::invalid_value, {"')' is not expected"}));
  EXPECT_THAT(error_in("ROD.position^2.5"), values(ErrorCode::invalid_value, {"whole number"}));
  EXPECT_THAT(error_in("((1 m)^9)^9"), values(ErrorCode::too_large, {"too high a power"}));
  EXPECT_THAT(error_in(std::string(60, '(') + "1"), values(ErrorCode::too_large, {"brackets"}));
  EXPECT_THAT(error_in("x"), values(ErrorCode::conflict, {"last(x)"}));
  EXPECT_THAT(error_in("last(x) + 1"), values(ErrorCode::missing, {"unit of 'x'"}));
}

TEST(FormulaMachine, ErrorsOfNamesAndLoads) {
  const auto error = [](const FormulaTexts& values, const std::map<std::string, std::string>& loads = {}) {
    return error_of(formula_world(values, loads));
  };
  const auto in = [](const std::string& key, ErrorCode code, const std::vector<std::string>& words) {
    return is_error(code, line_of(key), words);
  };
  EXPECT_THAT(error({"2 m"}), in("values", ErrorCode::invalid_value, {"NAME = FORMULA"}));
  EXPECT_THAT(error({"m = 2"}), in("values", ErrorCode::invalid_value, {"'m'"}));
  EXPECT_THAT(error({"a b = 2"}), in("values", ErrorCode::invalid_value, {"'a b'"}));
  EXPECT_THAT(error({"a = 1", "a = 2"}), in("values", ErrorCode::duplicate, {"'a'"}));
  EXPECT_THAT(error({"a = 2 m in s"}), in("values", ErrorCode::conflict, {"comes out in m", "'in s'"}));
  EXPECT_THAT(error({"a = 2 in ells"}), in("values", ErrorCode::unknown_name, {"'ells'"}));
  EXPECT_THAT(error({}, {{"joint", "ARM"}, {"load", "2 N"}}),
              in("load", ErrorCode::conflict, {"'2 N' comes out in N", "a hinge takes N m"}));
  EXPECT_THAT(error({}, {{"load", "2 N"}}), in("load", ErrorCode::missing, {"'joint'"}));
  EXPECT_THAT(error({}, {{"body", "FRAME"}, {"force", "2 N"}}), in("body", ErrorCode::conflict, {"fixed"}));
  std::string chain = "1";
  for (int i = 0; i < 45; ++i)
    chain += " + sin(" + std::to_string(i) + ")";
  EXPECT_THAT(error(FormulaTexts(16, "v = 1")), in("values", ErrorCode::duplicate, {"'v'"}));
  FormulaTexts many;
  for (int i = 0; i < 20; ++i)
    many.push_back(fmt::format("v{} = {}", i, chain));
  EXPECT_THAT(error(many), in("values", ErrorCode::too_large, {"two machines"}));
  EXPECT_THAT(error({"a = " + std::string(1000, ' ') + "1"}), in("values", ErrorCode::too_large, {"letters"}));
}

TEST(FormulaMachine, WhatItNamesCanBeFoundAndItsValuesRead) {
  const std::string text = "2.5e1 * ARM.rate + quantity.water / x1 - min(a.b, 3.m)";
  std::vector<std::string> found;
  for (const FormulaName& name : names_in_formula(text))
    found.push_back((name.quantity ? "q:" : "") + text.substr(name.begin, name.length));
  EXPECT_EQ(found, (std::vector<std::string>{"ARM", "q:water", "a"}));
  const state::WorldDescription world = formula_world({"a = 1", "b = quantity.water in l", "c = 2 in 1"});
  const std::vector<OwnValue> own = own_values(world.machines[0]);
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[0].name + own[0].unit + own[1].name + own[1].unit, "blc");
  EXPECT_EQ(quantities_in_formulas(world.machines[0]), std::vector<std::string>{"water"});
}

TEST(FormulaUnits, WordsComeBackAsTheyAreWritten) {
  for (const char* unit : {"N m", "kg m2/s3/K", "m3/s", "1/s", "m^0.5", "W", "m"}) {
    const auto parsed = std::string(unit) == "m^0.5" ? Unit{{{1, 0, 0, 0}}, 1, 0} : *parse_unit(unit);
    EXPECT_EQ(in_words(parsed.dimension), unit);
  }
  for (const char* wrong : {"m s/kg s", "m//s", "furlong", "degC/s", "m ", "m10", "2"})
    EXPECT_FALSE(parse_unit(wrong)) << wrong;
}

/// Any text of these pieces is refused with a place and a remedy, or each tick gives finite numbers whatever the world does.
RC_GTEST_PROP(FormulaMachine, AnyFormulaIsRefusedWithAPlaceOrStaysFinite, ()) {
  static const FormulaTexts kPieces = {"1",        "0",
                                       "2.5",      "1e30",
                                       "3 m",      "2 s",
                                       "4 N m",    "5 l/s",
                                       "20 degC",  "ARM.position",
                                       "5 m²",     "³",
                                       "ARM.rate", "ROD.position",
                                       "ROD.rate", "quantity.water",
                                       "pi",       "+",
                                       "-",        "*",
                                       "/",        "^",
                                       "^2",       "^-3",
                                       "<",        ">=",
                                       "(",        ")",
                                       ",",        "min(",
                                       "max(",     "sqrt(",
                                       "sin(",     "abs(",
                                       "clamp(",   "if(",
                                       "step(",    "integral(",
                                       "count(",   "sum(",
                                       "last(",    "and",
                                       "or",       "not",
                                       "x",        "y",
                                       "in",       "%",
                                       ".",        "#",
                                       "\xce\xb1"};
  static const FormulaTexts kTerms = {"ARM.angle",
                                      "sqrt(ARM.rate * 1 s - 1)",
                                      "1 Hz / ARM.rate",
                                      "1e30",
                                      "ARM.angle^-9",
                                      "integral(ARM.rate * 1e30)",
                                      "count(ARM.rate > 0 or ROD.rate < 0)",
                                      "ROD.rate / ROD.rate",
                                      "if(quantity.water > 1 l, 1 l / quantity.water, -2)"};
  const bool right = *rc::gen::arbitrary<bool>();
  const auto draw = [&] {
    std::string formula = right ? *rc::gen::elementOf(kTerms) : "";
    for (int i = *rc::gen::inRange(0, 12); i > 0; --i) {
      if (right)
        formula += *rc::gen::elementOf(FormulaTexts{" + ", " * ", " / ", " - "}) + *rc::gen::elementOf(kTerms);
      else
        formula += *rc::gen::elementOf(kPieces) + (*rc::gen::arbitrary<bool>() ? " " : "");
    }
    return formula;
  };
  const state::WorldDescription world = formula_world({"x = " + draw() + " in 1", "y = " + draw()},
                                                      {{"joint", "ARM"}, {"load", "(" + draw() + ") * 1 N m"}});
  const Error error = error_of(world);
  if (!error.what.empty()) {
    RC_ASSERT(!error.remedy.empty());
    RC_ASSERT(error.line == line_of("values") || error.line == line_of("load"));
    return;
  }
  RC_TAG("runs");
  Bench bench(world);
  for (int i = 0; i < 20; ++i) {
    for (double* const number :
         {&bench.joint(0).position, &bench.joint(0).velocity, &bench.joint(1).position, &bench.quantity("water")})
      *number = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>());
    bench.tick();
    RC_ASSERT(std::isfinite(bench.joint(0).load) && std::abs(bench.joint(0).load) <= 1000);
    RC_ASSERT(std::ranges::all_of(bench.state->memory, [](double x) { return std::isfinite(x); }));
  }
}

}  // namespace
}  // namespace mechane::machines::test
