// The scripted hand by itself: where it goes, without a world.
#include "client-sdk/visitor/visit_player.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::visitor {
namespace {

using state::VisitMove;

constexpr double kArmM = 0.9;

/// A lever on a hinge along z through (0, 1, 0); its grip is `kArmM` out along x.
state::WorldDescription lever_world() {
  state::WorldDescription world;
  state::BodyDescription frame, lever;
  frame.name = "FRAME";
  frame.fixed = true;
  lever.name = "LEVER";
  lever.X_WB.p = Vec3(0, 1, 0);
  world.bodies = {frame, lever};
  state::JointDescription hinge;
  hinge.name = "PIVOT";
  hinge.body1 = BodyId(0);
  hinge.body2 = BodyId(1);
  hinge.X_B1J.p = Vec3(0, 1, 0);
  world.joints = {hinge};
  return world;
}

/// A millisecond in which the hand is where it is intended.
void step(VisitPlayer& player, std::span<const Pose> X_WB, bool holding, double felt_n) {
  player.advance(0.001, X_WB, {holding, felt_n, Vec3::Zero(), player.intent().X_WH.p, {}});
}

Pose lever_at(double angle_rad) {
  return {Vec3(0, 1, 0), Quat(Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()))};
}

VisitMove swing(double amplitude_rad, double cycles, double per_min) {
  VisitMove move;
  move.kind = VisitMove::Kind::swing;
  move.joint = JointId(0);
  move.amplitude_rad = amplitude_rad;
  move.cycles = cycles;
  move.cycles_per_min = per_min;
  return move;
}

RC_GTEST_PROP(VisitPlayerSwing, GoesToAndFroOnItsArcFromWhereTheLeverStands, ()) {
  const double amplitude = *rc::gen::element(0.1, 0.25, -0.25, 0.6);
  const double start = 0.01 * *rc::gen::inRange(-80, 81) * std::abs(amplitude);
  const int cycles = *rc::gen::inRange(1, 6);
  const double per_min = *rc::gen::inRange(5, 60);
  const state::WorldDescription world = lever_world();
  const Pose X_WL = lever_at(start);
  const state::VisitDescription visit{"", {}, {swing(amplitude, cycles, per_min)}};
  PlayerConfig config;
  config.X_WH_rest.p = X_WL * Vec3(kArmM, 0, 0);
  VisitPlayer player(world, visit, config);
  double least = start, most = start, last = start, fastest = 0, seconds = 0;
  int turns = 0, direction = amplitude > 0 ? 1 : -1;
  while (!player.finished()) {
    step(player, std::vector<Pose>{Pose{}, X_WL}, true, 0);
    const Vec3 arm = player.intent().X_WH.p - Vec3(0, 1, 0);
    RC_ASSERT(std::abs(arm.norm() - kArmM) < 1e-9);
    RC_ASSERT(std::abs(arm.z()) < 1e-12);
    const double angle = std::atan2(arm.y(), arm.x());
    fastest = std::max(fastest, std::abs(angle - last) / 0.001);
    if ((angle - last) * direction < 0) {
      ++turns;
      direction = -direction;
    }
    last = angle;
    least = std::min(least, angle);
    most = std::max(most, angle);
    seconds += 0.001;
    RC_ASSERT(seconds < 200);
  }
  // It reaches both ends, turns round at each, and comes back to where it began.
  RC_ASSERT(std::abs(most - std::abs(amplitude)) < 1e-4);
  RC_ASSERT(std::abs(least + std::abs(amplitude)) < 1e-4);
  RC_ASSERT(turns == 2 * cycles);
  RC_ASSERT(std::abs(last - start) < 1e-6);
  RC_ASSERT(fastest <= std::abs(amplitude) * 2 * kPi * per_min / 60 * 1.001);
  RC_ASSERT(seconds >= cycles * 60 / per_min);
  RC_ASSERT(player.results().size() == 1u);
  RC_ASSERT(player.results()[0].ok);
}

TEST(VisitPlayerSwing, AHandThatHoldsNothingSaysSo) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit{"", {}, {swing(0.2, 1, 60)}};
  PlayerConfig config;
  config.X_WH_rest.p = Vec3(kArmM, 1, 0);
  VisitPlayer player(world, visit, config);
  for (int i = 0; i < 5000 && !player.finished(); ++i)
    step(player, std::vector<Pose>{Pose{}, lever_at(0)}, i < 300, 0);
  ASSERT_EQ(player.results().size(), 1u);
  EXPECT_FALSE(player.results()[0].ok);
  EXPECT_EQ(player.results()[0].name, "swing PIVOT");
}

/// A visit that carries the lever's body a metre to the right.
state::VisitDescription carrying() {
  VisitMove reach, grasp, carry;
  reach.kind = VisitMove::Kind::reach;
  grasp.kind = VisitMove::Kind::grasp;
  carry.kind = VisitMove::Kind::move_to;
  for (VisitMove* move : {&reach, &grasp, &carry}) {
    move->body = BodyId(1);
    move->duration_s = 0.2;
  }
  carry.X_WB.p = Vec3(1, 1, 0);
  return {"", {}, {reach, grasp, carry}};
}

std::vector<MoveResult> carry_to(const Vec3& p_WB_at_the_end, bool holding, const PlayerConfig& config = {}) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  VisitPlayer player(world, visit, config);
  for (int i = 0; i < 20000 && !player.finished(); ++i) {
    const bool carries = player.results().size() % 3 == 2;
    const Pose X_WB{carries ? p_WB_at_the_end : Vec3(0, 1, 0), Quat::Identity()};
    step(player, std::vector<Pose>{Pose{}, X_WB}, holding || !carries, 0);
  }
  return {player.results().begin(), player.results().end()};
}

TEST(VisitPlayerCarry, WhatSlippedIsFetchedAgainAFewTimes) {
  const auto results = carry_to(Vec3(0.3, 1, 0), false);
  const auto tries = static_cast<std::size_t>(1 + PlayerConfig{}.fetch_again);
  ASSERT_EQ(results.size(), 3 * tries);
  for (std::size_t i = 0; i < results.size(); i += 3) {
    EXPECT_EQ(results[i].name, "reach LEVER");
    EXPECT_FALSE(results[i + 2].ok);
  }
}

TEST(VisitPlayerCarry, WhatASnapTookOrTheHandHoldsIsNotFetchedAgain) {
  EXPECT_EQ(carry_to(Vec3(0.95, 1, 0), false).size(), 3u);
  EXPECT_EQ(carry_to(Vec3(0.3, 1, 0), true).size(), 3u);
}

TEST(VisitPlayerCarry, AHandThatSeesFetchesAgainWhatDoesNotComeAlthoughItHoldsSomething) {
  PlayerConfig config;
  config.waits_for_lag_m = 0.03;
  EXPECT_GT(carry_to(Vec3(0, 1, 0), true, config).size(), 3u) << "it holds another thing";
  EXPECT_EQ(carry_to(Vec3(1, 1, 0), true, config).size(), 3u);
}

TEST(VisitPlayerGrasp, WhatCaughtNothingSaysHowNearItWasAndWhetherItFelt) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  for (const double felt_n : {0.0, 1.0}) {
    PlayerConfig config;
    config.offset_W = Vec3(0, 0, 0.3);
    VisitPlayer player(world, visit, config);
    while (player.results().size() < 2)
      step(player, std::vector<Pose>{Pose{}, lever_at(0)}, false, player.results().empty() ? 0 : felt_n);
    EXPECT_FALSE(player.results()[0].failed_grasp);
    ASSERT_TRUE(player.results()[1].failed_grasp);
    EXPECT_EQ(player.results()[1].failed_grasp->body, BodyId(1));
    EXPECT_NEAR(player.results()[1].failed_grasp->nearest_m, 0.3, 1e-9);
    EXPECT_EQ(player.results()[1].failed_grasp->touched, felt_n > 0);
  }
}

/// Seconds of a reach of one second for a thing a metre away, with a hand that feels something from then on.
double reach_that_feels_from(double felt_from_s) {
  const state::WorldDescription world = lever_world();
  state::VisitDescription visit = carrying();
  visit.moves[0].duration_s = 1;
  PlayerConfig config;
  config.X_WH_rest.p = Vec3(1, 1, 0);
  VisitPlayer player(world, visit, config);
  for (double t = 0; player.results().empty(); t += 0.001)
    step(player, std::vector<Pose>{Pose{}, lever_at(0)}, false, t < felt_from_s ? 0 : 1);
  return player.results()[0].seconds;
}

TEST(VisitPlayerReach, EndsWhereTheHandFeelsItsGoalButNotAtWhatItMeetsOnTheWay) {
  EXPECT_NEAR(reach_that_feels_from(0.9), 0.9, 0.01);
  EXPECT_GT(reach_that_feels_from(0.1), 0.5) << "four fifths of the way are left";
}

TEST(VisitPlayerReach, AHandOpensFirst) {
  const state::WorldDescription world = lever_world();
  state::VisitDescription slow = carrying();
  slow.moves[0].duration_s = 1;
  PlayerConfig config;
  config.X_WH_rest.p = Vec3(0.01, 1, 0);  // still at what it has just lost
  VisitPlayer player(world, slow, config);
  while (player.results().empty())
    step(player, std::vector<Pose>{Pose{}, lever_at(0)}, false, 1);
  EXPECT_NEAR(player.results()[0].seconds, 0.3, 0.01);
}

TEST(VisitPlayerReach, GoesOnToWhereTheThingFellMeanwhile) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  VisitPlayer player(world, visit, PlayerConfig{});
  for (int t = 0; player.results().empty(); ++t) {
    const Vec3 p_WB = t < 100 ? Vec3(0, 1, 0) : Vec3(0.1, 0.05, 0);
    step(player, std::vector<Pose>{Pose{}, Pose{p_WB, Quat::Identity()}}, false, 0);
    ASSERT_LT(t, 1000);
  }
  EXPECT_LT((player.intent().X_WH.p - Vec3(0.1, 0.05, 0)).norm(), 1e-3);
}

TEST(VisitPlayerReach, DoesNotChaseAThingForEver) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  VisitPlayer player(world, visit, PlayerConfig{});
  for (int t = 0; player.results().empty(); ++t) {
    step(player, std::vector<Pose>{Pose{}, Pose{Vec3(0.002 * t, 1, 0), Quat::Identity()}}, false, 0);
    ASSERT_LT(t, 2000);
  }
}

TEST(VisitPlayerCarry, WhatFellIsBroughtBackCalmly) {
  const state::WorldDescription world = lever_world();
  state::VisitDescription visit = carrying();
  visit.moves[2].X_WB.p = Vec3(0.1, 1, 0);
  VisitPlayer player(world, visit, PlayerConfig{});
  double fastest_m_per_s = 0;
  for (Vec3 before = player.intent().X_WH.p; !player.finished(); before = player.intent().X_WH.p) {
    const std::size_t moves = player.results().size();
    const Pose X_WB{moves < 2 ? Vec3(0, 1, 0) : Vec3(0, 0, 0), Quat::Identity()};  // it falls when it is first carried
    step(player, std::vector<Pose>{Pose{}, X_WB}, moves != 2, 0);
    if (moves == 5) fastest_m_per_s = std::max(fastest_m_per_s, (player.intent().X_WH.p - before).norm() / 0.001);
    if (moves == 6) break;
  }
  EXPECT_GT(fastest_m_per_s, 0.5) << "a metre up";
  EXPECT_LT(fastest_m_per_s, 0.8) << "at 0.4 m/s, and up to 15/8 of it with a hand's course";
}

TEST(VisitPlayerCarry, WhatFellIntoTheVoidIsGivenUp) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  VisitPlayer player(world, visit, PlayerConfig{});
  for (int t = 0; !player.finished(); ++t) {
    const bool carries = player.results().size() % 3 == 2;
    const Pose X_WB{carries ? Vec3(0, -1e6, 0) : Vec3(0, 1, 0), Quat::Identity()};
    step(player, std::vector<Pose>{Pose{}, X_WB}, !carries, 0);
    ASSERT_LT(t, 60'000);
  }
}

PlayerConfig whole_hand_at(const Vec3& p_WH_rest) {
  PlayerConfig config;
  config.kind = client::HandKind::glove;
  config.X_WH_rest.p = p_WH_rest;
  return config;
}

TEST(VisitPlayerReach, AWholeHandComesFromTheSideToWhatItTakesBelowTheMiddle) {
  state::WorldDescription world = lever_world();
  state::VisitDescription visit = carrying();
  visit.moves[0].p_BG = Vec3(0, -0.3, 0);
  VisitPlayer player(world, visit, whole_hand_at(Vec3(-0.7, 0.9, 0)));
  const std::vector<Pose> X_WB{Pose{}, lever_at(0)};
  const Vec3 grip = X_WB[1] * visit.moves[0].p_BG;
  while (player.results().empty())
    step(player, X_WB, false, 0);
  EXPECT_LT((player.intent().X_WH.p - (grip - Vec3(0.25, 0, 0))).norm(), 1e-9) << "it stops beside it";
  while (player.results().size() < 2)
    step(player, X_WB, false, 0);
  EXPECT_LT((player.intent().X_WH.p - grip).norm(), 1e-9) << "and goes on, closing";
}

TEST(VisitPlayerCarry, AWholeHandComesFromAboveOnWhatItTakes) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = carrying();
  const PlayerConfig config = whole_hand_at(Vec3(-0.7, 0.9, 0.1));
  VisitPlayer player(world, visit, config);
  const std::vector<Pose> X_WB{Pose{}, lever_at(0)};
  const Vec3 goal = X_WB[1] * visit.moves[0].p_BG;
  double highest_m = 0, last_m = config.X_WH_rest.p.y() - goal.y();
  while (player.results().empty()) {
    step(player, X_WB, false, 0);
    const Vec3 way = player.intent().X_WH.p - goal;
    // Its fingers reach 0.2 m before its wrist: by then they are well over it.
    const bool fingers_there = std::abs(way.x()) < 0.2 && std::abs(way.x()) > 0.1;
    EXPECT_TRUE(!fingers_there || way.y() > 0.06) << way.transpose();
    EXPECT_LT(std::abs(way.y() - last_m), 0.01) << "it does not leap";
    last_m = way.y();
    highest_m = std::max(highest_m, way.y());
  }
  EXPECT_GT(highest_m, 0.09);
  EXPECT_LT((player.intent().X_WH.p - goal).norm(), 1e-9);
}

/// A visit that takes the lever by its grip, turns it and lets go.
state::VisitDescription turning(double turns) {
  VisitMove reach, grasp, turn, release;
  reach.kind = VisitMove::Kind::reach;
  grasp.kind = VisitMove::Kind::grasp;
  release.kind = VisitMove::Kind::release;
  reach.body = grasp.body = BodyId(1);
  reach.p_BG = Vec3(kArmM, 0, 0);
  reach.duration_s = grasp.duration_s = release.duration_s = 0.2;
  turn.kind = VisitMove::Kind::turn;
  turn.joint = JointId(0);
  turn.turns = turns;
  turn.rate_rpm = 60;
  return {"", {}, {reach, grasp, turn, release}};
}

/// A lever that follows the hand once it is grasped, at most so far in a millisecond.
class FollowingLever {
 public:
  explicit FollowingLever(double most_rad_per_ms) : most_rad_(most_rad_per_ms) {}
  /// One millisecond of the player.
  void advance(VisitPlayer& player, bool held) {
    step(player, std::vector<Pose>{Pose{}, lever_at(angle_rad)}, held, 0);
    const Vec3 arm = player.intent().X_WH.p - Vec3(0, 1, 0);
    const double ahead_rad = std::remainder(std::atan2(arm.y(), arm.x()) - angle_rad, 2 * kPi);
    if (held) angle_rad += std::clamp(ahead_rad, -most_rad_, most_rad_);
  }
  double angle_rad = 0;

 private:
  double most_rad_;
};

TEST(VisitPlayerTurn, AHandThatSeesStaysWithWhatComesSlowly) {
  const state::WorldDescription world = lever_world();
  PlayerConfig config;
  config.waits_for_lag_m = 0.03;
  for (const double turns : {1.0, -1.0}) {
    const state::VisitDescription visit = turning(turns);
    VisitPlayer player(world, visit, config);
    FollowingLever lever(0.0005);  // for twelve seconds
    while (player.results().size() < 3) {
      const bool held = player.results().size() == 2;
      lever.advance(player, held);
      const Vec3 grip = lever_at(lever.angle_rad) * Vec3(kArmM, 0, 0);
      ASSERT_TRUE(!held || (player.intent().X_WH.p - grip).norm() < 0.04);
    }
    EXPECT_TRUE(player.results()[2].ok);
    EXPECT_NEAR(lever.angle_rad, turns * 2 * kPi, 0.04 / kArmM);
  }
}

TEST(VisitPlayerTurn, AHandThatSeesDoesNotWaitForEverForWhatIsStuck) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = turning(1);
  PlayerConfig config;
  config.waits_for_lag_m = 0.03;
  VisitPlayer player(world, visit, config);
  FollowingLever stuck(0);
  double seconds = 0;
  for (; player.results().size() < 3 && seconds < 60; seconds += 0.001)
    stuck.advance(player, player.results().size() == 2);
  EXPECT_LT(seconds, 10);
}

/// A force on a hand that is held off its goal, as by a spring of a grip and one of an arm.
HandSense held_off(const VisitPlayer& player, const Vec3& p_WH) {
  constexpr double kStiffness_n_per_m = 300;
  const Vec3 f_W = kStiffness_n_per_m * (p_WH - player.intent().X_WH.p);
  return {true, f_W.norm(), f_W, p_WH, {}};
}

TEST(VisitPlayerGrasp, AHandThatHasCaughtAThingPressesNoMore) {
  const state::WorldDescription world = lever_world();
  state::VisitDescription visit = carrying();
  visit.moves[1].duration_s = 1;
  VisitPlayer player(world, visit, PlayerConfig{});
  while (player.results().empty())
    step(player, std::vector<Pose>{Pose{}, lever_at(0)}, false, 0);
  const Vec3 p_WH = player.intent().X_WH.p + Vec3(0.01, 0, 0);
  while (player.results().size() == 1)
    player.advance(0.001, std::vector<Pose>{Pose{}, lever_at(0)}, held_off(player, p_WH));
  EXPECT_LT((player.intent().X_WH.p - p_WH).norm(), 1e-4);
}

TEST(VisitPlayerTurn, AHandleThatGoesRoundKeepsTheHandOnItsCircle) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = turning(2);
  for (const double wider_m : {0.02, -0.02}) {
    VisitPlayer player(world, visit, PlayerConfig{});
    double angle_rad = 0, across_m = 0;
    while (player.results().size() < 3) {
      const Vec3 p_WH = lever_at(angle_rad) * Vec3(kArmM + wider_m, 0, 0.01);
      player.advance(0.001, std::vector<Pose>{Pose{}, lever_at(angle_rad)}, held_off(player, p_WH));
      const Vec3 arm = player.intent().X_WH.p - Vec3(0, 1, 0);
      angle_rad = std::atan2(arm.y(), arm.x());
      across_m = (player.intent().X_WH.p - lever_at(angle_rad) * Vec3(kArmM + wider_m, 0, 0.01)).norm();
    }
    EXPECT_LT(across_m, 1e-4) << wider_m;
  }
}

/// A hand closes as soon as it feels something, so the handle may lie anywhere in it. Taken to lie in one place of the hand, it would be
/// twice as far off its way after half a turn.
RC_GTEST_PROP(VisitPlayerTurn, AHandleGoesRoundWhereverInTheHandItLies, ()) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = turning(*rc::gen::element(1, -1));
  const auto within_5_cm = [] { return 0.01 * *rc::gen::inRange(-5, 6); };
  const Vec3 p_HG(within_5_cm(), within_5_cm(), within_5_cm());
  VisitPlayer player(world, visit, whole_hand_at(Vec3(-0.7, 0.9, 0)));
  double angle_rad = 0, radius_m = 0;
  while (player.results().size() < 3) {
    const bool held = player.results().size() == 2;
    const HandSense sense{held, 0, Vec3::Zero(), player.intent().X_WH.p, held ? std::optional(p_HG) : std::nullopt};
    player.advance(0.001, std::vector<Pose>{Pose{}, lever_at(angle_rad)}, sense);
    if (!held) continue;
    const Vec3 arm = player.intent().X_WH * p_HG - lever_at(0).p;
    if (radius_m == 0) radius_m = arm.head<2>().norm();
    angle_rad = std::atan2(arm.y(), arm.x());
    RC_ASSERT(std::abs(arm.head<2>().norm() - radius_m) < 1e-9);
  }
}

TEST(VisitPlayerStep, IsTriedAgainFromTheReachBeforeIt) {
  const state::WorldDescription world = lever_world();
  const state::VisitDescription visit = turning(2);
  VisitPlayer player(world, visit, PlayerConfig{});
  FollowingLever lever(1);
  const auto play = [&](std::size_t moves_before) {
    for (int t = 0; t < 20'000 && !player.finished(); ++t) {
      const std::size_t moves = player.results().size() - moves_before;
      if (moves == 2) player.note_step();  // it begins while the lever turns
      lever.advance(player, moves == 2);
    }
  };
  play(0);
  ASSERT_EQ(player.results().size(), 4u);
  EXPECT_NEAR(lever.angle_rad, 2 * 2 * kPi, 0.05);
  player.try_step_again();
  EXPECT_FALSE(player.finished());
  EXPECT_EQ(player.intent().grasp_intent, 0);
  play(4);
  ASSERT_EQ(player.results().size(), 8u);
  EXPECT_EQ(player.results()[4].name, "reach LEVER");
  EXPECT_NEAR(lever.angle_rad, 4 * 2 * kPi, 0.1) << "all its turns once more";
}

TEST(VisitPlayerTurn, AHandleThatIsLostIsCaughtAgainAndTurnedForTheRest) {
  const state::WorldDescription world = lever_world();
  state::VisitDescription visit = turning(-3);
  visit.moves.pop_back();
  VisitPlayer player(world, visit, PlayerConfig{});
  double lever_rad = 0, last = 0;
  bool was_held = false;
  for (int t = 0; t < 20'000 && !player.finished(); ++t) {
    // The handle goes with the hand, slips out once in the middle of the first try, and stays where it is.
    const std::size_t moves = player.results().size();
    const bool held = ((moves == 1 || moves == 2) && t < 1500) || moves == 4 || moves == 5;
    step(player, std::vector<Pose>{Pose{}, lever_at(lever_rad)}, held, 0);
    const Vec3 arm = player.intent().X_WH.p - Vec3(0, 1, 0);
    const double angle = std::atan2(arm.y(), arm.x());
    const double share = moves < 3 ? 0.5 : 1;  // in the first try, it lags more and more
    if (held && was_held) lever_rad += share * std::remainder(angle - last, 2 * kPi);
    last = angle;
    was_held = held;
  }
  std::vector<std::string> names;
  for (const MoveResult& move : player.results())
    names.push_back(move.name + (move.ok ? "" : " lost"));
  EXPECT_EQ(names, (std::vector<std::string>{"reach LEVER", "grasp LEVER", "turn PIVOT lost", "reach LEVER",
                                             "grasp LEVER", "turn PIVOT"}));
  EXPECT_NEAR(lever_rad, -3 * 2 * kPi, 0.05);
}

}  // namespace
}  // namespace mechane::visitor
