// The crossbow with its winch, played by its own visits; the laws of bow, winch and flight; and what fails, and where, once something
// is broken.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

// What the page and the file have.
constexpr double kBowFull_n = 1000, kBowDraw_m = 0.45, kToArrow = 0.8;
constexpr double kArrow_kg = 0.1, kArrowShaft_m = 0.012, kArrowDrag = 2, kToTarget_m = 15, kStraw_n = 1200;
constexpr double kWinchDrum_m = 0.03, kWinchCrank_m = 0.25, kWinchBearing_nm = 0.8, kWinchViscous_nm_s = 0.1;
constexpr double kSlideFriction_n = 12, kSlideViscous_n_s = 20, kBarPitch_m = 0.015;

const test::Exhibit& crossbow() {
  static const test::Exhibit kExhibit("crossbow");
  return kExhibit;
}

/// The step that the visit came to and did not get over. A visitor who pulls the trigger too early is sent back to the first step, so
/// that where he stands in the end does not tell.
std::string failed_at(const test::PlayedVisit& visit) {
  if (visit.done) return {};
  std::string farthest = "none";
  for (const char* name : {"home", "wind", "lay", "shoot", "fly"}) {
    if (std::ranges::any_of(visit.steps, [&](const test::PlayedStep& step) { return step.name == name; }))
      farthest = name;
  }
  return farthest;
}

TEST(CrossbowVisits, TheArrowSticksInTheTargetAndTwiceTheSame) {
  const state::WorldDescription& world = crossbow().description();
  const BodyId arrow = world.find_body("ARROW"), slider = world.find_body("SLIDER");
  double drawn_ns = 0, near_s = 0;  // by the channel, besides the arrow's weight
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    const state::UserState& user = state.users[0];
    const Vec3 home_W = state[slider].X_WB * Vec3(0, 0, -0.23) - state[arrow].X_WB.p;
    if (!user.grasp.active || user.grasp.body != arrow || home_W.norm() > 0.15) return;
    drawn_ns += kTickSeconds * home_W.normalized().dot(user.output.force_W.f - kArrow_kg * world.gravity_W);
    near_s += kTickSeconds;
  };
  const test::PlayedVisit visit = crossbow().play("shooting", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << visit;
  for (const auto& move : visit.moves)
    EXPECT_TRUE(move.ok) << move.name;
  EXPECT_GT(drawn_ns / near_s, 0.4) << "the channel draws the arrow in";
  EXPECT_EQ(crossbow().play("shooting").state_hash, visit.state_hash);
}

TEST(CrossbowVisits, ShotsTooSoonCranksLetGoAndArrowsDroppedEndWell) {
  double drawn_m = 0, lost_m = 0;
  int shots_without_arrow = 0, arrows_taken = 0;
  double lowest_m = 1;
  test::PlayOptions options;
  const BodyId arrow = crossbow().description().find_body("ARROW");
  options.watch = [&](const state::WorldState& state) {
    const double now_m = crossbow().value(state, "drawn");
    if (crossbow().value(state, "caught") > 0.5) lost_m = std::max(lost_m, drawn_m - now_m);
    drawn_m = crossbow().value(state, "caught") > 0.5 ? std::max(drawn_m, now_m) : 0;
    if (crossbow().value(state, "shots") < 0.5) lowest_m = std::min(lowest_m, state[arrow].X_WB.p.y());
    for (const state::Event& event : state.event_span()) {
      if (event.kind == state::EventKind::fired && crossbow().value(state, "laid") < 0.5) ++shots_without_arrow;
      if (event.kind == state::EventKind::grasped && event.object == arrow.index()) ++arrows_taken;
    }
  };
  const test::PlayedVisit visit = crossbow().play("mistakes-use", options);
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(shots_without_arrow, 1);
  EXPECT_EQ(std::ranges::count(visit.steps, "home", &test::PlayedStep::name), 2) << "the string leapt home: begin anew";
  EXPECT_EQ(arrows_taken, 2);
  EXPECT_LT(lowest_m, 0.02) << "it fell to the ground";
  EXPECT_LT(lost_m, kBarPitch_m) << "the bars hold what was let go: it loses less than a tooth";
  EXPECT_EQ(visit.quantities.at("shots"), 1);
  EXPECT_EQ(crossbow().play("mistakes-use").state_hash, visit.state_hash);
}

TEST(CrossbowVisits, AHandThatMissesEverythingByTheSameLittleGetsThere) {
  test::PlayOptions options;
  options.player.offset_W = Vec3(0.012, 0.008, -0.010);
  const test::PlayedVisit visit = crossbow().play("shooting", options);
  EXPECT_TRUE(visit.done) << visit;
}

/// What the hand does on the crank, in real units, while the string is drawn from 0.15 to 0.42 m.
struct Winding {
  double handle_n = 0;  // mean, of the hand's torque about the axle over the crank
  double asked_n = 0;   // mean, by the law of the winch
  double work_j = 0;    // of the hand, from the beginning
  double stored_j = 0;  // by the bow at most
  double shot_j = 0;    // of the arrow
  std::size_t ticks = 0;
};

Winding measure_winding() {
  const state::WorldDescription& world = crossbow().description();
  const JointId axle = world.find_joint("AXLE"), guide = world.find_joint("GUIDE");
  const BodyId drum = world.find_body("DRUM");
  const Vec3 p_WA = world.bodies[drum.index()].X_WB.p;
  Winding winding;
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    winding.stored_j = std::max(winding.stored_j, crossbow().value(state, "energy"));
    winding.shot_j = std::max(winding.shot_j, crossbow().value(state, "shot"));
    const state::Grasp& grasp = state.users[0].grasp;
    if (!grasp.active || grasp.body != drum) return;
    const Vec3 p_AG_W = state[drum].X_WB * grasp.p_BG - p_WA;
    const double felt_nm = -(p_AG_W.cross(grasp.reaction_W.f) + grasp.reaction_W.t).x();
    winding.work_j += felt_nm / world.effort_scale * state[axle].velocity * kTickSeconds;
    const double drawn_m = crossbow().value(state, "drawn");
    if (drawn_m < 0.15 || drawn_m > 0.42) return;
    ++winding.ticks;
    winding.handle_n += felt_nm / world.effort_scale / kWinchCrank_m;
    const double rope_n =
        kBowFull_n * drawn_m / kBowDraw_m + kSlideFriction_n + kSlideViscous_n_s * state[guide].velocity;
    winding.asked_n +=
        (rope_n * kWinchDrum_m + kWinchBearing_nm + kWinchViscous_nm_s * state[axle].velocity) / kWinchCrank_m;
  };
  EXPECT_TRUE(crossbow().play("shooting", options).done);
  winding.handle_n /= static_cast<double>(std::max<std::size_t>(winding.ticks, 1));
  winding.asked_n /= static_cast<double>(std::max<std::size_t>(winding.ticks, 1));
  return winding;
}

TEST(CrossbowVisits, TheHandFeelsTheBowByDrumOverCrankAndTheArrowGetsNoMoreThanItGave) {
  const Winding winding = measure_winding();
  ASSERT_GT(winding.ticks, 1000u);
  EXPECT_NEAR(winding.handle_n, winding.asked_n, 0.03 * winding.asked_n);
  EXPECT_GT(winding.work_j, winding.stored_j) << "no energy is made";
  const double full_j = kBowFull_n * kBowDraw_m / 2;
  EXPECT_GT(winding.stored_j, 0.97 * full_j);
  EXPECT_GT(winding.shot_j, 0.97 * kToArrow * full_j);
  EXPECT_LE(winding.shot_j, kToArrow * winding.stored_j) << "four fifths of what it held";
}

TEST(CrossbowVisits, TheArrowSlowsByDragDropsByItsWeightAndGoesInByItsEnergy) {
  double first_m_s = 0, last_m_s = 0, energy_j = 0, gone_m = 0;
  Vec3 p_WSeat = Vec3::Zero();
  const BodyId arrow = crossbow().description().find_body("ARROW"),
               target = crossbow().description().find_body("TARGET");
  test::PlayOptions options;
  options.watch = [&](const state::WorldState& state) {
    if (crossbow().value(state, "flying") < 0.5) {
      if (first_m_s == 0) p_WSeat = state[arrow].X_WB.p;
      return;
    }
    energy_j = crossbow().value(state, "shot");
    const double now_m_s = state[arrow].V_WB.v.norm();
    if (first_m_s == 0) first_m_s = now_m_s;
    const double way_m = (state[arrow].X_WB.p - p_WSeat).norm();
    if (way_m > kToTarget_m - 0.1) return;  // the straw may have it
    gone_m = way_m;
    last_m_s = now_m_s;
  };
  const test::PlayedVisit visit = crossbow().play("shooting", options);
  ASSERT_TRUE(visit.done) << visit;
  EXPECT_NEAR(first_m_s, std::sqrt(2 * energy_j / kArrow_kg), 0.1);
  const double drag_kg_per_m = 0.5 * 1.2 * kArrowDrag * kPi * kArrowShaft_m * kArrowShaft_m / 4;
  const double arrives_m_s = first_m_s * std::exp(-drag_kg_per_m / kArrow_kg * kToTarget_m);
  ASSERT_GT(gone_m, kToTarget_m - 0.2);
  const double taken_m_s = first_m_s * (1 - std::exp(-drag_kg_per_m / kArrow_kg * gone_m));
  EXPECT_NEAR(first_m_s - last_m_s, taken_m_s, 0.1 * taken_m_s) << "what the air takes";
  EXPECT_NEAR(visit.quantities.at("range"), kToTarget_m, 0.01);
  const double drop_m = 0.5 * 9.81 * std::pow(visit.quantities.at("flight"), 2);
  const double off_m = crossbow().description().bodies[target.index()].X_WB.p.y() - (p_WSeat.y() - drop_m);
  EXPECT_NEAR(visit.quantities.at("off_centre"), std::abs(off_m), 0.01);
  EXPECT_LT(visit.quantities.at("off_centre"), 0.05) << "in the bull";
  const double depth_m = 0.5 * kArrow_kg * arrives_m_s * arrives_m_s / kStraw_n;
  EXPECT_NEAR(visit.quantities.at("depth"), depth_m, 0.05 * depth_m);
}

TEST(CrossbowVisits, ABowOfAQuarterOfTheForceShootsHalfAsFast) {
  const test::PlayedVisit full = crossbow().play("shooting");
  const test::PlayedVisit quarter = crossbow().play_changed("shooting", [](state::WorldDescription& world) {
    test::set_parameter(world, "BOW", "fullForce", std::vector<double>{kBowFull_n / 4});
  });
  EXPECT_NEAR(full.quantities.at("shot") / quarter.quantities.at("shot"), 4, 0.1);
  EXPECT_EQ(failed_at(quarter), "fly") << "it drops four times as far: under the target";
}

TEST(CrossbowVisits, WithThePawlsOffTheSliderRunsForwardAgain) {
  double drawn_m = 0, released_m = -1;
  test::PlayOptions options;
  options.change = [](state::WorldDescription& world) { test::switch_off(world, "RATCHET"); };
  options.watch = [&](const state::WorldState& state) {
    drawn_m = std::max(drawn_m, crossbow().value(state, "drawn"));
    if (drawn_m > 0.4 && crossbow().value(state, "caught") > 0.5) released_m = crossbow().value(state, "drawn");
  };
  const test::PlayedVisit visit = crossbow().play("shooting", options);
  EXPECT_EQ(failed_at(visit), "wind") << visit;
  EXPECT_GT(drawn_m, 0.44) << "as long as the hand held the crank";
  EXPECT_LT(released_m, 0.05) << visit;
}

TEST(CrossbowVisits, WithTheStringCutTheClawFindsNothing) {
  const test::PlayedVisit visit = crossbow().play_changed(
      "shooting", [](state::WorldDescription& world) { test::set_parameter(world, "BOW", "strung", false); });
  EXPECT_EQ(failed_at(visit), "home") << visit;
  EXPECT_EQ(visit.quantities.at("shots"), 0);
}

TEST(CrossbowVisits, ABowWithoutForceLetsTheArrowFallAtItsFeet) {
  const test::PlayedVisit visit = crossbow().play_changed("shooting", [](state::WorldDescription& world) {
    test::set_parameter(world, "BOW", "fullForce", std::vector<double>{1});
  });
  EXPECT_EQ(failed_at(visit), "fly") << visit;
  EXPECT_LT(visit.quantities.at("range"), 2);
}

TEST(CrossbowVisits, WithTheRopeOfTheWinchCutNothingIsDrawn) {
  const test::PlayedVisit visit =
      crossbow().play_changed("shooting", [](state::WorldDescription& world) { test::switch_off(world, "ROPE"); });
  EXPECT_EQ(failed_at(visit), "wind") << visit;
  EXPECT_GT(visit.quantities.at("turns"), 2) << "the drum turns, but lifts and draws nothing";
}

TEST(CrossbowVisits, WithoutAnArrowThereIsNothingToLayIn) {
  const test::PlayedVisit visit =
      crossbow().play_changed("shooting", [](state::WorldDescription& world) { test::take_away(world, "ARROW"); });
  EXPECT_EQ(failed_at(visit), "lay") << visit;
  EXPECT_EQ(visit.quantities.at("shots"), 0);
}

TEST(CrossbowVisits, ATriggerThatHoldsOnShootsNothing) {
  const test::PlayedVisit visit =
      crossbow().play_changed("shooting", [](state::WorldDescription& world) { test::switch_off(world, "FIRE"); });
  EXPECT_EQ(visit.stopped_at, "shoot") << visit;
}

TEST(CrossbowVisits, AHandWithoutStrengthPushesAndWindsNothing) {
  const test::PlayedVisit soft = crossbow().play_changed("shooting", [](state::WorldDescription& world) {
    for (state::BodyDescription& body : world.bodies)
      body.haptic.stiffness_n_per_m = 0;
  });
  EXPECT_EQ(soft.stopped_at, "home") << soft;
  const test::PlayedVisit weak = crossbow().play_changed("shooting", [](state::WorldDescription& world) {
    test::set_parameter(world, "HOLD", "forceLimit", std::vector<double>{1});
  });
  EXPECT_EQ(failed_at(weak), "wind") << weak;
}

}  // namespace
}  // namespace mechane
