// Torsion springs and the stone that they throw: torque, energy, Philon's calibration, the range of the shot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/flight_reference.hpp"
#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

constexpr double kPreload = 1500, kStiffness = 2500, kDrawn = 0.9, kStone = 4.37, kStoneDiameter = 0.148;
constexpr double kArmInertia = 4, kCatapultScale = 0.006;

/// A ten-mina stone-thrower with its stone on the slider, shooting along x at `elevation`.
state::WorldDescription catapult_world(double elevation = kPi / 4, double drag = 0.47) {
  state::WorldDescription world;
  world.effort_scale = kCatapultScale;
  const BodyId frame = add_body(world, "FRAME", 1, 1, true);
  add_joint(world, "ARM", state::JointKind::hinge, frame, add_body(world, "TIMBER", 8, kArmInertia));
  add_body(world, "STONE", kStone, 0.01);
  add_quantity(world, "fired");
  world.machines = {{"SINEW",
                     "machine.torsion_spring",
                     {{"joint", text("ARM")},
                      {"preload", number(kPreload)},
                      {"stiffness", number(kStiffness)},
                      {"springDiameter", number(11 * 0.0185)},
                      {"stoneMass", number(kStone)},
                      {"release", text("fired")}},
                     20},
                    {"SHOT",
                     "machine.projectile",
                     {{"body", text("STONE")},
                      {"spring", text("SINEW")},
                      {"stock", text("FRAME")},
                      {"seat", vector(0, 0, 0)},
                      {"direction", vector(std::cos(elevation), std::sin(elevation), 0)},
                      {"diameter", number(kStoneDiameter)},
                      {"dragCoefficient", number(drag)},
                      {"ground", number(-1)}},
                     30}};
  return world;
}

/// The work against the torque that the machine loads the hinge with.
double area_under_torque(double springs) {
  state::WorldDescription world = catapult_world();
  world.machines[0].parameters["springs"] = number(springs);
  Bench bench(world);
  double area = 0;
  for (int n = 1; n <= 9000; ++n) {
    area -= bench.joint().load / kCatapultScale * kDrawn / 9000;
    bench.move_to(kDrawn * n / 9000);
  }
  return area;
}

TEST(TorsionSpring, TorqueIsPreloadPlusStiffnessTimesAngleOfTwoSprings) {
  Bench bench(catapult_world());
  for (const double angle : {0.05, 0.3, kDrawn}) {
    bench.hold_at(angle);
    EXPECT_NEAR(bench.value("SINEW.torque_nm"), 2 * (kPreload + kStiffness * angle), 1e-9);
    EXPECT_NEAR(bench.joint().load, -kCatapultScale * bench.value("SINEW.torque_nm"), 1e-12) << "back to rest";
  }
  bench.hold_at(0);
  EXPECT_EQ(bench.joint().load, 0) << "at rest the frame carries the preload";
  EXPECT_NEAR(bench.value("SINEW.calibre_dactyls"), 11, 1e-9);
}

TEST(TorsionSpring, HoldsTheAreaUnderItsTorque) {
  Bench bench(catapult_world());
  bench.hold_at(kDrawn);
  const double held = bench.value("SINEW.energy_j");
  EXPECT_NEAR(held, area_under_torque(2), 1e-3 * held);
  EXPECT_NEAR(held, 2 * (kPreload * (kDrawn - 0.01) + 0.5 * kStiffness * kDrawn * kDrawn), 1e-6)
      << "the preload comes in over 0.02 rad";
  EXPECT_EQ(area_under_torque(0), 0) << "cut springs hold nothing";
}

/// Turns the arm there, where the winch holds it.
void draw(Bench& bench, double angle) {
  bench.body("TIMBER").X_WB.R = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  bench.joint().min_position = bench.joint().max_position = angle;
  bench.hold_at(angle);
}
void let_go(Bench& bench) {
  bench.joint().min_position = 1;
  bench.joint().max_position = -1;
}

TEST(TorsionSpring, AFreeArmFliesWithThatEnergyAndNoMore) {
  state::WorldDescription world = catapult_world();
  Bench bench(world, Bench::Moved::by_dynamics);
  draw(bench, kDrawn);
  const double held = bench.value("SINEW.energy_j");
  let_go(bench);
  double most = 0;
  for (int n = 0; n < 200 && bench.joint().position > 0; ++n) {
    bench.tick();
    const double moving = 0.5 * kArmInertia * bench.joint().velocity * bench.joint().velocity;
    most = std::max(most, moving);
  }
  EXPECT_LE(bench.joint().position, 0);
  EXPECT_LE(most, held);
  EXPECT_GT(most, 0.95 * held);
}

TEST(TorsionSpring, IsHeldAgainstPhilonsCalibration) {
  // Belopoeica 51: ten minas ask for 11 dactyls, a talent of sixty for 20, exactly 19.99.
  const auto with = [](double dactyls, double minas) {
    state::WorldDescription world = catapult_world();
    world.machines[0].parameters["springDiameter"] = number(dactyls * 0.0185);
    world.machines[0].parameters["stoneMass"] = number(minas * 0.437);
    return error_of(world);
  };
  EXPECT_EQ(with(11, 10).what, "");
  EXPECT_EQ(with(20, 60).what, "");
  EXPECT_THAT(with(11, 20), is_error(ErrorCode::conflict, line_of("springDiameter"), {"13.9"}));
  EXPECT_THAT(with(8, 10), is_error(ErrorCode::conflict, line_of("springDiameter"), {"0.2035"}));
}

TEST(Shot, TheStoneGetsItsShareAndTheArmNoMoreThanTheRest) {
  Bench bench(catapult_world(), Bench::Moved::by_dynamics);
  draw(bench, kDrawn);
  const double held = bench.value("SINEW.energy_j");
  let_go(bench);
  bench.quantity("fired") = 1;
  bench.tick();
  const double shot = 0.5 * kStone * bench.body("STONE").V_WB.v.squaredNorm();
  EXPECT_NEAR(shot, 0.6 * held, 0.01 * held);
  EXPECT_NEAR(bench.value("SHOT.energy_j"), 0.6 * held, 1e-9);
  double most = 0;
  for (int n = 0; n < 300 && bench.joint().position > 0.02; ++n) {
    bench.tick();
    most = std::max(most, 0.5 * kArmInertia * bench.joint().velocity * bench.joint().velocity);
  }
  EXPECT_LE(most, 0.4 * held);
  EXPECT_GT(most, 0.36 * held);
  EXPECT_NEAR(bench.value("SINEW.shot_j"), 0.6 * held, 1e-9);
}

/// Throws the stone and lets it fly until it lands.
void shoot(Bench& bench) {
  draw(bench, kDrawn);
  bench.quantity("fired") = 1;
  bench.tick();
  for (int n = 0; n < 20000 && bench.value("SHOT.flying") != 0; ++n)
    bench.tick();
}

TEST(Shot, RangeIsThatOfTheIntegratedFlight) {
  for (const double elevation : {0.1, 0.5, kPi / 4, 1.2}) {
    for (const double drag : {0.0, 0.47, 5.0}) {
      Bench bench(catapult_world(elevation, drag), Bench::Moved::by_dynamics);
      shoot(bench);
      const double speed = std::sqrt(2 * bench.value("SHOT.energy_j") / kStone);
      const double k = 0.5 * 1.2 * drag * kPi * kStoneDiameter * kStoneDiameter / 4 / kStone;
      const Landing landing = integrate_flight(speed, elevation, k, 1.0);
      EXPECT_NEAR(bench.value("SHOT.range_m"), landing.range_m, 0.003 * landing.range_m) << elevation << " " << drag;
      EXPECT_NEAR(bench.value("SHOT.flight_s"), landing.time_s, 0.003 * landing.time_s + 0.002);
      EXPECT_NEAR(bench.value("SHOT.height_m"), landing.height_m, 0.005 * landing.height_m + 0.03);
      EXPECT_EQ(bench.value("SHOT.struck"), 1);
    }
  }
}

TEST(Shot, WithoutAirAtFortyFiveDegreesItIsSpeedSquaredOverG) {
  state::WorldDescription world = catapult_world(kPi / 4, 0);
  world.machines[1].parameters["ground"] = number(0);
  Bench bench(world, Bench::Moved::by_dynamics);
  shoot(bench);
  const double speed2 = 2 * 0.6 * 2 * (kPreload * (kDrawn - 0.01) + 0.5 * kStiffness * kDrawn * kDrawn) / kStone;
  EXPECT_NEAR(bench.value("SHOT.range_m"), speed2 / 9.81, 0.003 * speed2 / 9.81);
}

TEST(Shot, OnlyOnceAReleaseAndOnlyFromTheSeat) {
  Bench bench(catapult_world());
  draw(bench, kDrawn);
  bench.body("STONE").X_WB.p = Vec3(0.2, 0, 0);
  bench.quantity("fired") = 1;
  bench.run(0.1);
  EXPECT_EQ(bench.value("SHOT.shots"), 0) << "the stone is beside its seat";
  EXPECT_LT(bench.joint().load, 0) << "nobody took the energy: the arm flies alone";
  bench.body("STONE").X_WB.p = Vec3::Zero();
  bench.run(0.1);
  EXPECT_EQ(bench.value("SHOT.shots"), 0) << "too late";
  bench.quantity("fired") = 0;
  bench.tick();
  bench.quantity("fired") = 1;
  bench.run(0.1);
  EXPECT_EQ(bench.value("SHOT.shots"), 1);
}

TEST(Shot, WaitsForItsHolderAndForTheHand) {
  state::WorldDescription world = catapult_world();
  add_joint(world, "POUCH", state::JointKind::ball, BodyId(0), BodyId(2));
  world.machines[1].parameters["holder"] = text("POUCH");
  Bench bench(world);
  draw(bench, kDrawn);
  bench.quantity("fired") = 1;
  bench.run(0.01);
  EXPECT_EQ(bench.value("SHOT.shots"), 0);
  EXPECT_EQ(bench.joint().load, 0) << "while it waits the spring pushes nothing";
  bench.joint(1).enabled = false;
  bench.tick();
  EXPECT_EQ(bench.value("SHOT.shots"), 1);

  Bench held(catapult_world());
  draw(held, kDrawn);
  held.state->users[0].grasp.active = true;
  held.state->users[0].grasp.body = held.world.find_body("STONE");
  held.quantity("fired") = 1;
  held.run(0.1);
  EXPECT_EQ(held.value("SHOT.shots"), 0);
}

TEST(Shot, ABlowEndsTheFlight) {
  Bench bench(catapult_world(0.3), Bench::Moved::by_dynamics);
  draw(bench, kDrawn);
  bench.quantity("fired") = 1;
  bench.run(0.5);
  ASSERT_EQ(bench.value("SHOT.flying"), 1);
  bench.body("STONE").V_WB.v *= 0.3;  // what a wall does
  bench.run(0.01);
  EXPECT_EQ(bench.value("SHOT.flying"), 0);
  EXPECT_EQ(bench.value("SHOT.struck"), 1);
  const double range = bench.value("SHOT.range_m");
  bench.run(0.5);
  EXPECT_EQ(bench.value("SHOT.range_m"), range);
}

RC_GTEST_PROP(Shot, NoEnergyIsMadeOnTheWay, ()) {
  const double elevation = 0.01 * *rc::gen::inRange(0, 150);
  Bench bench(catapult_world(elevation, 0.1 * *rc::gen::inRange(0, 20)), Bench::Moved::by_dynamics);
  draw(bench, 0.01 * *rc::gen::inRange(5, 120));
  bench.quantity("fired") = 1;
  bench.tick();
  const auto energy = [&] {
    const state::BodyState& stone = bench.body("STONE");
    return kStone * (0.5 * stone.V_WB.v.squaredNorm() + 9.81 * stone.X_WB.p.y());
  };
  double last = energy();
  RC_ASSERT(last <= bench.value("SHOT.energy_j") * 1.001);
  for (int n = 0; n < 3000 && bench.value("SHOT.flying") != 0; ++n) {
    bench.tick();
    RC_ASSERT(energy() <= last + 1e-3);
    last = energy();
  }
}

TEST(Shot, ATickAllocatesNothing) {
  Bench bench(catapult_world());
  draw(bench, kDrawn);
  bench.quantity("fired") = 1;
  EXPECT_EQ(bench.allocations(3000), 0u);
}

TEST(Shot, ErrorsSayWhatToWrite) {
  const auto with = [](std::size_t machine, const std::string& name, const state::Parameter& value) {
    state::WorldDescription world = catapult_world();
    world.machines[machine].parameters[name] = value;
    return error_of(world);
  };
  EXPECT_THAT(with(0, "release", text("pulled")),
              is_error(ErrorCode::unknown_name, line_of("release"), {"'pulled'", "name one of: fired"}));
  EXPECT_THAT(with(0, "springs", number(1.5)),
              is_error(ErrorCode::invalid_value, line_of("springs"), {"'springs'", "1.5"}));
  EXPECT_THAT(with(1, "spring", text("SPRING")),
              is_error(ErrorCode::unknown_name, line_of("spring"), {"'SPRING'", "SINEW, SHOT"}));
  EXPECT_THAT(with(1, "spring", text("SHOT")),
              is_error(ErrorCode::invalid_value, line_of("spring"), {"'SHOT'", "machine.projectile"}));
  EXPECT_THAT(with(1, "body", text("FRAME")), is_error(ErrorCode::conflict, line_of("body"), {"'FRAME'"}));
  EXPECT_THAT(with(1, "direction", vector(0, 0, 0)),
              is_error(ErrorCode::invalid_value, line_of("direction"), {"'direction'"}));
  EXPECT_THAT(with(1, "target", text("STONE")), is_error(ErrorCode::conflict, line_of("target"), {"'target'"}));
  state::WorldDescription world = catapult_world();
  std::swap(world.machines[0], world.machines[1]);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("spring"), {"'SINEW'"}));
}

}  // namespace
}  // namespace mechane::machines::test
