// The stone-thrower, played by its own visits: what winding costs and the springs hold, the flight, the wall; and what fails, and where,
// once something is broken.
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "server/machines/nature.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

/// As catapult.md has them.
struct CatapultFigures {
  static constexpr double preload_nm = 1500, stiffness_nm_per_rad = 2500;  // of one of two bundles
  static constexpr double efficiency = 0.6, stone_kg = 4.37, stone_m = 0.148, drag_coefficient = 0.47;
  static constexpr double drum_m = 0.045, tooth_rad = 2 * kPi / 24;
  static double energy_j(double angle) { return 2 * (preload_nm * angle + 0.5 * stiffness_nm_per_rad * angle * angle); }
};

const test::Exhibit& catapult() {
  static const test::Exhibit kExhibit("catapult");
  return kExhibit;
}

state::BodyDescription& body_of(state::WorldDescription& world, const char* name) {
  const BodyId id = world.find_body(name);
  if (!id) throw std::runtime_error(std::string("there is no body ") + name);
  return world.bodies[id.index()];
}

void weaken_springs(state::WorldDescription& world, double share) {
  using F = CatapultFigures;
  test::set_parameter(world, "SPRINGS", "preload", std::vector<double>{share * F::preload_nm});
  test::set_parameter(world, "SPRINGS", "stiffness", std::vector<double>{share * F::stiffness_nm_per_rad});
}

/// How many of the wall's stones are not where they stood.
std::size_t moved_stones(const state::WorldState& state) {
  const auto& bodies = catapult().description().bodies;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name.starts_with("WALL_") && (state.bodies[i].X_WB.p - bodies[i].X_WB.p).norm() > 0.05) ++moved;
  }
  return moved;
}

TEST(CatapultVisits, TheWallFallsAndTwiceTheSame) {
  test::PlayOptions options;
  std::size_t moved = 0;
  const BodyId winch = catapult().description().find_body("WINCH");
  std::set<std::uint32_t> wound;  // the counts of clicks that were seen while the hand held it
  options.watch = [&](const state::WorldState& state) {
    moved = moved_stones(state);
    const state::UserState& user = state.users[0];
    if (user.grasp.active && user.grasp.body == winch) wound.insert(user.clicks.count);
  };
  const test::PlayedVisit visit = catapult().play("shooting", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  EXPECT_GE(moved, 4u) << visit;
  EXPECT_GT(visit.quantities.at("teeth"), 20);
  EXPECT_GE(static_cast<double>(wound.size()), visit.quantities.at("teeth"))
      << "the hand feels each tooth of the ratchet";
  EXPECT_EQ(catapult().play("shooting").state_hash, visit.state_hash);
}

TEST(CatapultVisits, ATriggerTooSoonAWinchLetGoAndADroppedStoneStillEndWell) {
  test::PlayOptions options;
  double furthest_m = 0, lost_m = 0, lowest_stone_m = 1;
  int stone_taken = 0;
  const BodyId stone = catapult().description().find_body("STONE");
  options.watch = [&](const state::WorldState& state) {
    const double drawn_m = catapult().value(state, "drawn");
    furthest_m = std::max(furthest_m, drawn_m);
    lost_m = std::max(lost_m, furthest_m - drawn_m);
    for (const state::Event& event : state.event_span()) {
      const bool took = event.kind == state::EventKind::grasped && event.object == stone.index();
      stone_taken += took ? 1 : 0;
    }
    if (catapult().value(state, "shots") < 0.5) lowest_stone_m = std::min(lowest_stone_m, state[stone].X_WB.p.y());
  };
  const test::PlayedVisit visit = catapult().play("mistakes-use", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.quantities.at("shots"), 1) << "the pin keeps the trigger";
  EXPECT_LT(lost_m, CatapultFigures::tooth_rad * CatapultFigures::drum_m + 1e-3) << "the ratchet keeps all but a tooth";
  EXPECT_LT(lowest_stone_m, 0.1) << "it was dropped to the ground";
  EXPECT_GE(stone_taken, 2);
}

TEST(CatapultVisits, TheHandsWorkIsInTheSpringsAndFrictionTakesTheRest) {
  const state::WorldDescription& world = catapult().description();
  const JointId axle = world.find_joint("AXLE");
  const BodyId winch = world.find_body("WINCH");
  const Vec3 p_WA = world.bodies[winch.index()].X_WB.p;
  double work_j = 0, held_j = 0, angle = 0;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const state::Grasp& grasp = state.users[0].grasp;
    if (!grasp.active || grasp.body != winch) return;
    const Vec3 p_AG_W = state[winch].X_WB * grasp.p_BG - p_WA;
    const double felt_nm = -(p_AG_W.cross(grasp.reaction_W.f) + grasp.reaction_W.t).x();
    work_j += felt_nm / world.effort_scale * state[axle].velocity * kTickSeconds;
    held_j = catapult().value(state, "energy");
    angle = catapult().value(state, "angle");
  };
  const test::PlayedVisit visit = catapult().play("shooting", options);
  const double expected_j = CatapultFigures::energy_j(angle);
  EXPECT_GT(angle, 0.8) << visit;
  EXPECT_NEAR(held_j, expected_j, 0.01 * expected_j) << "the area under the torque; the heel takes a little";
  EXPECT_GT(work_j, held_j) << "no energy is made";
  EXPECT_LT(work_j, 1.08 * held_j) << "the bearing, the rails: some 50 N on the slider, 3 N m on the axle";
}

TEST(CatapultVisits, TheStoneGetsItsShareAndFliesAsBallisticsSay) {
  using F = CatapultFigures;
  const BodyId stone = catapult().description().find_body("STONE");
  double held_j = 0, fastest = 0, flight_s = 0;
  Vec3 from = Vec3::Zero(), blow = Vec3::Zero();
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const bool shot = catapult().value(state, "shots") > 0.5;
    if (!shot) {
      held_j = catapult().value(state, "energy");
      from = state[stone].X_WB.p;
      return;
    }
    fastest = std::max(fastest, state[stone].V_WB.v.norm());
    if (catapult().value(state, "struck") > 0.5) return;
    blow = state[stone].X_WB.p;
    flight_s = catapult().value(state, "flight");
  };
  const test::PlayedVisit visit = catapult().play("shooting", options);
  ASSERT_EQ(visit.quantities.at("shots"), 1) << visit;
  const double given_j = visit.quantities.at("shot_energy");
  EXPECT_NEAR(given_j, F::efficiency * held_j, 0.01 * held_j);
  EXPECT_LE(0.5 * F::stone_kg * fastest * fastest, held_j) << "never more than was wound up";
  const double speed = std::sqrt(2 * given_j / F::stone_kg);
  EXPECT_NEAR(fastest, speed, 0.05);
  // Along the flight: x = ln(1 + k v t) / k. Down: air hardly slows so slow a fall.
  const double area = kPi * F::stone_m * F::stone_m / 4;
  const double k_per_m = 0.5 * machines::kAirDensity_kg_m3 * F::drag_coefficient * area / F::stone_kg;
  const double time_s = flight_s + kTickSeconds;
  EXPECT_NEAR(from.z() - blow.z(), std::log(1 + k_per_m * speed * time_s) / k_per_m, 2 * speed * kTickSeconds);
  EXPECT_NEAR(from.y() - blow.y(), 0.5 * machines::kGravity_m_s2 * time_s * time_s, 0.01);
  EXPECT_LT(visit.quantities.at("speed"), speed) << "air takes, it does not give";
}

TEST(CatapultVisits, WithoutItsPawlTheWinchRunsBack) {
  const auto visit =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { test::switch_off(world, "RATCHET"); });
  EXPECT_EQ(visit.stopped_at, "wind") << visit;
  EXPECT_LT(visit.quantities.at("drawn"), 0.3) << visit;
}

TEST(CatapultVisits, WithItsRopeCutNothingIsWound) {
  const auto visit =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { test::switch_off(world, "ROPE"); });
  EXPECT_EQ(visit.stopped_at, "wind") << visit;
  EXPECT_GT(visit.quantities.at("turns"), 3) << "the drum turns, but lifts and draws nothing";
}

TEST(CatapultVisits, AHandWithoutStrengthWindsNothing) {
  const auto visit = catapult().play_changed(
      "shooting", [](state::WorldDescription& world) { body_of(world, "WINCH").haptic.stiffness_n_per_m = 0; });
  EXPECT_EQ(visit.stopped_at, "wind") << visit;
  EXPECT_LT(visit.quantities.at("drawn"), 0.01) << visit;
}

TEST(CatapultVisits, WithoutItsStringNothingIsThrown) {
  const auto visit =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { test::switch_off(world, "CLAW"); });
  EXPECT_EQ(visit.stopped_at, "wall") << visit;
  EXPECT_LT(visit.quantities.at("shot_energy"), 1e-3) << "the slider goes back alone, and the springs hold nothing";
}

TEST(CatapultVisits, SlackSpringsThrowNothingAndWeakOnesTooShort) {
  const auto slack =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { weaken_springs(world, 0); });
  EXPECT_EQ(slack.stopped_at, "wall") << slack;
  EXPECT_EQ(slack.quantities.at("shots"), 0) << slack;
  const auto weak =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { weaken_springs(world, 0.01); });
  EXPECT_EQ(weak.stopped_at, "wall") << weak;
  EXPECT_EQ(weak.quantities.at("shots"), 1) << weak;
  EXPECT_LT(weak.quantities.at("range"), 5) << "it falls before the wall";
  EXPECT_NEAR(weak.quantities.at("top_middle"), 1.1, 0.01) << weak;
}

TEST(CatapultVisits, WithoutAStoneThereIsNothingToLayIn) {
  const auto visit =
      catapult().play_changed("shooting", [](state::WorldDescription& world) { test::take_away(world, "STONE"); });
  EXPECT_EQ(visit.stopped_at, "load") << visit;
}

TEST(CatapultVisits, AShotWithoutAStoneLeavesTheWallStanding) {
  const auto visit = catapult().play_changed("shooting", [](state::WorldDescription& world) {
    test::take_away(world, "STONE");
    state::StepDescription& load = world.steps[world.find_step("load").index()];
    load.triggers.at(0).value = 0;  // as if the step were skipped: it goes on, seated or not
  });
  EXPECT_EQ(visit.stopped_at, "wall") << visit;
  EXPECT_EQ(visit.quantities.at("fired"), 1) << visit;
  EXPECT_LT(visit.quantities.at("angle"), 0.01) << "the arms went home";
  EXPECT_NEAR(visit.quantities.at("top_middle"), 1.1, 0.01) << visit;
}

}  // namespace
}  // namespace mechane
