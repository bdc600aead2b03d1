// The sphere of Aiolos, played by its own visits; and what fails, and where, once something is broken.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

const test::Exhibit& sphere() {
  static const test::Exhibit kExhibit("aiolos-sphere");
  return kExhibit;
}

/// Where 'lighting' stops once the description is changed so.
std::string stopped_at(std::function<void(state::WorldDescription&)> change) {
  return sphere().play_changed("lighting", std::move(change)).stopped_at;
}

std::string stopped_with(const std::string& component, const std::string& parameter, std::vector<double> value) {
  return stopped_at([&](state::WorldDescription& world) { test::set_parameter(world, component, parameter, value); });
}

TEST(AiolosSphereVisits, FireBoilsTheWaterSteamTurnsTheSphereWithoutFireItDiesDown) {
  test::PlayOptions options;
  double fastest = 0, hottest = 0, speed_when_out = 0;
  bool faster_without_fire = false;
  options.watch = [&, before = 0.0](const state::WorldState& state) mutable {
    const double speed = sphere().value(state, "speed");
    fastest = std::max(fastest, speed);
    hottest = std::max(hottest, sphere().value(state, "temperature"));
    const bool out = fastest > 0 && sphere().value(state, "fire") < 0.5;
    if (out && speed_when_out == 0) speed_when_out = speed;
    // What steam there was when the fire went out is gone after a few times steamDelay.
    if (out && sphere().value(state, "steam") < 1e-6 && speed > before) faster_without_fire = true;
    before = speed;
  };
  const test::PlayedVisit visit = sphere().play("lighting", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 6u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << step.name;
  EXPECT_EQ(hottest, 100);
  EXPECT_GT(fastest, 400);
  EXPECT_LT(fastest, 1100);
  EXPECT_LT(visit.quantities.at("speed"), speed_when_out / 2) << visit;
  EXPECT_FALSE(faster_without_fire);
  EXPECT_GT(visit.quantities.at("water"), 0) << "it was the fire that went out, not the water";
  EXPECT_EQ(sphere().play("lighting").state_hash, visit.state_hash);
}

TEST(AiolosSphereVisits, ATorchDroppedTheWrongPartAShutterTornAwayAndAWalkStillEndWell) {
  test::PlayOptions options;
  int grasps = 0, lights = 0;
  options.watch = [&](const state::WorldState& state) {
    for (const state::Event& event : state.event_span()) {
      grasps += event.kind == state::EventKind::grasped ? 1 : 0;
      lights += event.kind == state::EventKind::lit ? 1 : 0;
    }
  };
  const test::PlayedVisit visit = sphere().play("mistakes-use", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_GE(grasps, 4) << "the torch again after it fell, the shutter again after it was torn out of the hand";
  EXPECT_EQ(lights, 2) << "the torch and the wood; the sphere does not burn";
  EXPECT_EQ(sphere().play("mistakes-use").state_hash, visit.state_hash);
}

TEST(AiolosSphereVisits, WithoutTheTorchsFlameNothingIsLit) {
  const auto coals_out = [](state::WorldDescription& world) { test::take_away(world, "BRAZIER"); };
  EXPECT_EQ(stopped_at(coals_out), "light");
  const auto never_near = [](state::WorldDescription& world) { test::switch_off(world, "FIRE"); };
  EXPECT_EQ(stopped_at(never_near), "light");
}

TEST(AiolosSphereVisits, WithoutWaterNothingBoils) {
  EXPECT_EQ(stopped_with("STEAM", "water", {0}), "boil");
}

TEST(AiolosSphereVisits, ANozzleTheWrongWayRoundTurnsNothing) {
  EXPECT_EQ(stopped_with("STEAM", "nozzleAngles", {0, kPi}), "spin");
}

TEST(AiolosSphereVisits, AFireThatDiesTooSoonLetsTheSphereSlowDown) {
  test::PlayOptions options;
  // The water boils after 5.6 s; two seconds of steam are not enough.
  options.change = [](state::WorldDescription& world) {
    test::set_parameter(world, "FIRE", "burnTime", std::vector<double>{7.5});
  };
  double fastest = 0;
  options.watch = [&](const state::WorldState& state) { fastest = std::max(fastest, sphere().value(state, "speed")); };
  const test::PlayedVisit visit = sphere().play("lighting", options);
  EXPECT_EQ(visit.stopped_at, "spin") << visit;
  EXPECT_GT(fastest, 50) << visit;
  EXPECT_LT(visit.quantities.at("speed"), fastest / 2) << visit;
}

TEST(AiolosSphereVisits, AFireWhoseDoorStaysOpenBurnsOn) {
  EXPECT_EQ(stopped_at([](state::WorldDescription& world) { test::switch_off(world, "PULL"); }), "shut");
}

}  // namespace
}  // namespace mechane
