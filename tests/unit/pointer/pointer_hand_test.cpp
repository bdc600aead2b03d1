#include "client-sdk/pointer/pointer_hand.hpp"

#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::pointer {
namespace {

constexpr double kTick_s = 0.002;

double drawn(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

picture::Sight sight_from(const Vec3& p_WC, const Vec3& p_WT) {
  picture::Camera camera;
  camera.p_WC = p_WC;
  camera.p_WT = p_WT;
  return {picture::eye_view(camera, picture::Eye::middle, 16.0 / 9), {1280, 720}};
}

/// A thing that goes wherever the hand takes it, or on its axle or track; grasped by a hand that closes within 1 cm of its grip.
struct Thing {
  PointerSenses senses;
  Vec3 p_BG = Vec3::Zero();

  void follow(const client::HandSample& hand) {
    const Vec3 p_WG = senses.X_WB * p_BG;
    if (!senses.holding && hand.grasp_intent > 0.5 && (hand.X_WH.p - p_WG).norm() < 0.01) {
      senses.holding = true;
      X_HB_ = hand.X_WH.inverse() * senses.X_WB;
      from_ = senses.X_WB;
      p_WG_from_ = hand.X_WH.p;
    }
    if (hand.grasp_intent < 0.3) senses.holding = false;
    if (!senses.holding) return;
    if (senses.leeway.axle) {
      const AffordanceLine& axle = *senses.leeway.axle;
      const Vec3 x = across(p_WG_from_, axle), y = axle.a_W.cross(x), now = across(hand.X_WH.p, axle);
      const double before = angle;
      angle += std::remainder(std::atan2(now.dot(y), now.dot(x)) - before, 2 * kPi);
      const Quat turn(Eigen::AngleAxisd(angle, axle.a_W));
      senses.X_WB = {axle.p_W + turn * (from_.p - axle.p_W), turn * from_.R};
    } else if (senses.leeway.track) {
      const Vec3& a = senses.leeway.track->a_W;
      senses.X_WB.p = from_.p + a * a.dot(hand.X_WH.p - p_WG_from_);
    } else {
      senses.X_WB = hand.X_WH * X_HB_;
    }
  }
  [[nodiscard]] static Vec3 across(const Vec3& p_W, const AffordanceLine& axle) {
    const Vec3 arm = p_W - axle.p_W;
    return arm - arm.dot(axle.a_W) * axle.a_W;
  }

  /// Turns in the grip, about its own place.
  void slip(const Vec3& turn) { X_HB_.R = (quat_from_rotation_vector(turn) * X_HB_.R).normalized(); }

  double angle = 0;

 private:
  Pose X_HB_;
  Pose from_;
  Vec3 p_WG_from_ = Vec3::Zero();
};

/// Lets `seconds` pass; what the hand did is held against its limits all the way.
void pass(PointerHand& hand, Thing& thing, double seconds) {
  Vec3 last = Vec3::Zero();
  bool moved = false;
  for (int k = 0; k < static_cast<int>(seconds / kTick_s); ++k) {
    const auto input = hand.advance(kTick_s, thing.senses);
    if (!input) {
      moved = false;
      continue;
    }
    ASSERT_TRUE(input->X_WH.p.allFinite());
    ASSERT_TRUE(input->V_WH.v.allFinite() && input->V_WH.w.allFinite());
    ASSERT_NEAR(input->X_WH.R.norm(), 1, 1e-9);
    ASSERT_LE(input->V_WH.v.norm(), 2.001) << "no hand goes so fast";
    if (moved) {
      ASSERT_LE((input->X_WH.p - last).norm(), 2.001 * kTick_s);
    }
    moved = true;
    last = input->X_WH.p;
    thing.follow(*input);
  }
}

/// Presses on a point of a thing and waits until it is held.
void take(PointerHand& hand, Thing& thing, const picture::Sight& sight, const Vec3& p_WT) {
  thing.p_BG = thing.senses.X_WB.inverse() * p_WT;
  thing.senses.leeway.taken = true;
  hand.press(sight, *pixel_of(sight, p_WT), {7, p_WT});
  pass(hand, thing, 1.2);
  ASSERT_EQ(hand.view().phase, PointerView::Phase::holding);
}

double pixels_off(const picture::Sight& sight, const Vec3& p_W, picture::PixelPlace place) {
  const auto seen = picture::pixel_of(sight, p_W);
  return seen ? std::hypot(seen->x - place.x, seen->y - place.y) : 1e9;
}

RC_GTEST_PROP(PointerHand, what_is_dragged_is_seen_under_the_pointer, ()) {
  const picture::Sight sight = sight_from({drawn(-1, 1), drawn(0.5, 2), drawn(2, 4)}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  take(hand, thing, sight, {drawn(-0.4, 0.4), drawn(0.8, 1.2), drawn(-0.3, 0.3)});
  const double depth = picture::depth_of(sight, hand.view().p_WH);
  const picture::PixelPlace to{drawn(10, 1270), drawn(10, 710)};
  hand.move(to);
  pass(hand, thing, 4);
  RC_ASSERT(pixels_off(sight, hand.view().p_WH, to) < 1);
  RC_ASSERT(std::abs(picture::depth_of(sight, hand.view().p_WH) - depth) < 0.001);
  RC_ASSERT(pixels_off(sight, thing.senses.X_WB * thing.p_BG, to) < 12);
}

RC_GTEST_PROP(PointerHand, depth_stays_in_bounds_whatever_the_wheel_says, ()) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  take(hand, thing, sight, {0.1, 1, 0});
  const double depth = picture::depth_of(sight, hand.view().p_WH);
  for (const int hundredths : *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(-900, 900)))
    hand.deepen(hundredths / 100.0);
  hand.deepen(std::numeric_limits<double>::quiet_NaN());
  hand.deepen(std::numeric_limits<double>::infinity());
  pass(hand, thing, 12);
  const double now = picture::depth_of(sight, hand.view().p_WH);
  RC_ASSERT(now >= depth / 4 - 1e-6);
  RC_ASSERT(now <= depth * 4 + 1e-6);
}

RC_GTEST_PROP(PointerHand, round_the_middle_of_a_cranks_picture_is_round_its_axle, ()) {
  const Vec3 a_W = Vec3(drawn(-1, 1), drawn(-1, 1), drawn(-1, 1));
  RC_PRE(a_W.norm() > 0.2);
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  Thing thing;
  thing.senses.leeway.axle = AffordanceLine{{0, 1, 0}, a_W.normalized()};
  const Vec3 arm = 0.25 * thing.senses.leeway.axle->a_W.unitOrthogonal();
  const Quat about(Eigen::AngleAxisd(drawn(0, 2 * kPi), thing.senses.leeway.axle->a_W));
  PointerHand hand;
  take(hand, thing, sight, Vec3(0, 1, 0) + about * arm);
  const bool faces = thing.senses.leeway.axle->a_W.z() > 0;
  const picture::PixelPlace from = hand.view().pointer;
  const double r = 120, start = std::atan2(360 - from.y, from.x - 640);
  const int turns = *rc::gen::inRange(-2, 3);
  // From where the crank was taken, out to a wide circle and round.
  for (int k = 0; k <= 100 * std::abs(turns); ++k) {
    const double angle = start + (turns < 0 ? -1 : 1) * 2 * kPi * k / 100;
    hand.move({640 + r * std::cos(angle), 360 - r * std::sin(angle)});
    pass(hand, thing, 0.03);
  }
  pass(hand, thing, 1);
  // On the picture of an axle that faces the viewer anticlockwise is positive; at its edge either may be meant.
  if (std::abs(thing.senses.leeway.axle->a_W.z()) < 0.1) return;
  RC_ASSERT(std::abs(thing.angle / (2 * kPi) - (faces ? turns : -turns)) < 0.2);
}

TEST(PointerHand, ATrackTakesWhatIsDraggedAlongItAndNotBesideIt) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  Thing thing;
  thing.senses.leeway.track = AffordanceLine{{0, 1, 0}, Vec3(1, 0, -1).normalized()};
  PointerHand hand;
  take(hand, thing, sight, {0, 1, 0});
  const Vec3 goal = 0.3 * Vec3(1, 0, -1).normalized() + hand.view().p_WH;
  picture::PixelPlace to = *pixel_of(sight, goal);
  hand.move(to);
  pass(hand, thing, 2);
  EXPECT_LT((hand.view().p_WH - goal).norm(), 0.003);
  to.y += 90;
  hand.move(to);
  pass(hand, thing, 2);
  EXPECT_NEAR(hand.view().p_WH.y(), 1, 0.005) << "off the track";
}

TEST(PointerHand, NearToItsPlaceAThingGoesToThePlacesDepth) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  Thing thing;
  thing.senses.X_WB.p = {0, 1, 0.5};
  PointerHand hand;
  const Pose place{{0.6, 1.2, -0.7}, Quat(Eigen::AngleAxisd(0.5, Vec3::UnitY()))};
  thing.senses.leeway.goals.push_back({place, true});
  take(hand, thing, sight, {0, 1, 0.5});
  hand.move(*pixel_of(sight, place.p));
  pass(hand, thing, 3);
  EXPECT_LT((thing.senses.X_WB.p - place.p).norm(), 0.01);
  EXPECT_LT(rotation_vector(thing.senses.X_WB.R * place.R.conjugate()).norm(), 0.02);
}

TEST(PointerHand, WhatDriftsAwayIsTaken) {
  const picture::Sight sight = sight_from({0, 1.2, 3}, {0, 1, 0});
  for (const Vec3& v_WB : {Vec3(0, 0, -0.05), Vec3(0, 0, -0.1), Vec3(0.03, 0, -0.2), Vec3(0, -0.05, -0.4)}) {
    PointerHand hand;
    Thing thing;
    thing.senses.X_WB.p = {0.2, 1, 0};
    thing.p_BG = {0, 0, 0.05};
    thing.senses.leeway.taken = true;
    const Vec3 p_WT = thing.senses.X_WB * thing.p_BG;
    hand.press(sight, *pixel_of(sight, p_WT), {7, p_WT});
    // Frames come more seldom than the hand moves.
    constexpr int kTicksInAFrame = 8;
    for (int k = 0; k < static_cast<int>(6 / kTick_s) && !thing.senses.holding; ++k) {
      const auto input = hand.advance(kTick_s, thing.senses);
      ASSERT_TRUE(input);
      ASSERT_LE(input->V_WH.v.norm(), 2.001);
      if (k % kTicksInAFrame == 0) thing.senses.X_WB.p += v_WB * (kTicksInAFrame * kTick_s);
      thing.follow(*input);
    }
    EXPECT_TRUE(thing.senses.holding) << v_WB.transpose();
  }
}

TEST(PointerHand, ItSendsNothingBeforeATouchNorAfterIt) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  EXPECT_FALSE(hand.advance(kTick_s, thing.senses));
  hand.move({3, 3});
  hand.deepen(3);
  hand.turn(1);
  hand.release();
  EXPECT_FALSE(hand.advance(kTick_s, thing.senses));
  take(hand, thing, sight, {0, 1, 0});
  hand.release();
  const auto open = hand.advance(kTick_s, thing.senses);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->grasp_intent, 0);
  pass(hand, thing, 1);
  EXPECT_FALSE(hand.advance(kTick_s, thing.senses));
}

TEST(PointerHand, NumbersThatAreNoneAreAsIfNotSaid) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  const double none = std::numeric_limits<double>::quiet_NaN();
  PointerHand hand;
  Thing thing;
  hand.press(sight, {none, 4}, {7, {0, 1, 0}});
  hand.press(sight, {1e9, 4}, {7, {0, 1, 0}});
  hand.press(sight, {4, 4}, {7, {0, none, 0}});
  hand.press({}, {4, 4}, {7, {0, 1, 0}});
  EXPECT_EQ(hand.view().phase, PointerView::Phase::resting);
  take(hand, thing, sight, {0, 1, 0});
  const Vec3 before = hand.view().p_WH;
  hand.move({none, none});
  hand.move({-1e9, 2});
  EXPECT_TRUE(hand.advance(kTick_s, thing.senses));
  EXPECT_FALSE(hand.advance(none, thing.senses));
  EXPECT_FALSE(hand.advance(-1, thing.senses));
  pass(hand, thing, 0.5);
  EXPECT_LT((hand.view().p_WH - before).norm(), 0.005);
}

TEST(PointerHand, WhatIsHeavierThanAPointerFeelsIsNotTornFromTheHand) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  take(hand, thing, sight, {0, 1, 0});
  const PointerSenses stuck = thing.senses;  // it does not follow
  hand.move({1270, 20});
  for (int k = 0; k < 2000; ++k) {
    const auto input = hand.advance(kTick_s, stuck);
    ASSERT_TRUE(input);
    ASSERT_LT((input->X_WH.p - stuck.X_WB * thing.p_BG).norm(), 0.06);
  }
}

/// A wall that a carried thing cannot enter; it comes off it without friction.
struct BeforeAWall {
  double wall_x_m = 0;   // the thing stays on the right of it, while it is
  double front_z_m = 0;  // behind this

  void hold_up(Thing& thing, const Vec3& before_W) const {
    Vec3& p_W = thing.senses.X_WB.p;
    if (p_W.z() < front_z_m && before_W.x() >= wall_x_m) p_W.x() = std::max(p_W.x(), wall_x_m);
  }
};

RC_GTEST_PROP(PointerHand, what_is_dragged_against_a_flank_is_drawn_out_and_passes_before_it, ()) {
  const picture::Sight sight = sight_from({0, drawn(1, 1.6), 3}, {0, 1, 0});
  const BeforeAWall wall{drawn(-0.1, 0.3), drawn(0.1, 0.4)};
  PointerHand hand;
  Thing thing;
  thing.senses.X_WB.p = {0.5, 1, 0};
  take(hand, thing, sight, {0.5, 1, 0});
  const picture::PixelPlace to = *pixel_of(sight, {-0.5, 1, 0});
  hand.move(to);
  for (int k = 0; k < 3000; ++k) {
    const auto input = hand.advance(kTick_s, thing.senses);
    ASSERT_TRUE(input && input->X_WH.p.allFinite());
    const Vec3 before_W = thing.senses.X_WB.p;
    thing.follow(*input);
    wall.hold_up(thing, before_W);
    ASSERT_LT((input->X_WH.p - thing.senses.X_WB * thing.p_BG).norm(), 0.06) << "torn out of the hand";
  }
  RC_ASSERT(thing.senses.holding);
  RC_ASSERT(pixels_off(sight, thing.senses.X_WB * thing.p_BG, to) < 20);
}

TEST(PointerHand, WhatCannotBePassedIsNotDrawnAwayForEver) {
  const picture::Sight sight = sight_from({0, 1.2, 3}, {0, 1, 0});
  const BeforeAWall wall{0.3, 100};
  PointerHand hand;
  Thing thing;
  thing.senses.X_WB.p = {0.5, 1, 0};
  take(hand, thing, sight, {0.5, 1, 0});
  hand.move(*pixel_of(sight, {-0.5, 1, 0}));
  double nearest = 10;
  for (int k = 0; k < 10'000; ++k) {
    const auto input = hand.advance(kTick_s, thing.senses);
    ASSERT_TRUE(input);
    const Vec3 before_W = thing.senses.X_WB.p;
    thing.follow(*input);
    wall.hold_up(thing, before_W);
    nearest = std::min(nearest, picture::depth_of(sight, thing.senses.X_WB.p));
  }
  EXPECT_GT(nearest, 1.9) << "no more than a long arm";
  EXPECT_TRUE(thing.senses.holding);
}

RC_GTEST_PROP(PointerHand, what_was_knocked_comes_back_to_how_it_was_laid_out, ()) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  thing.senses.X_WB.p = {0, 1, 0};
  const auto any_turn = [] { return quat_from_rotation_vector(Vec3(drawn(-1, 1), drawn(-1, 1), drawn(-1, 1))); };
  thing.senses.R_WB_rest = any_turn();
  const Quat knock = any_turn();
  RC_PRE(rotation_vector(knock).norm() > 0.25);
  thing.senses.X_WB.R = (knock * *thing.senses.R_WB_rest).normalized();
  take(hand, thing, sight, {0, 1, 0});
  pass(hand, thing, 4);
  RC_ASSERT(rotation_vector(thing.senses.X_WB.R * thing.senses.R_WB_rest->conjugate()).norm() < 0.05);
}

RC_GTEST_PROP(PointerHand, what_turned_in_the_grip_comes_upright_all_the_same, ()) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  thing.senses.X_WB.p = {0, 1, 0};
  thing.senses.R_WB_rest = Quat::Identity();
  take(hand, thing, sight, {0, 1, 0});
  const Vec3 turn(drawn(-1, 1), drawn(-1, 1), drawn(-1, 1));
  RC_PRE(turn.norm() > 0.7);
  thing.slip(turn);
  pass(hand, thing, 12);
  RC_ASSERT(rotation_vector(thing.senses.X_WB.R).norm() < 0.05);
}

TEST(PointerHand, WhatSlippedIsFetchedAgainWhileTheFingerIsDown) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  take(hand, thing, sight, {0, 1, 0});
  thing.senses.holding = false;
  for (int k = 0; k < 130; ++k)
    (void)hand.advance(kTick_s, thing.senses);
  EXPECT_EQ(hand.view().phase, PointerView::Phase::reaching);
  pass(hand, thing, 1);
  EXPECT_EQ(hand.view().phase, PointerView::Phase::holding);
}

TEST(PointerHand, WhatItsPlaceTookOutOfTheHandStaysThere) {
  const picture::Sight sight = sight_from({0, 1, 3}, {0, 1, 0});
  PointerHand hand;
  Thing thing;
  take(hand, thing, sight, {0, 1, 0});
  thing.senses.leeway.goals.push_back({thing.senses.X_WB, true});
  thing.senses.holding = false;
  for (int k = 0; k < 400; ++k)
    (void)hand.advance(kTick_s, thing.senses);
  EXPECT_EQ(hand.view().phase, PointerView::Phase::resting);
}

TEST(PointerSenses, AnObjectIsWhereTheFrameHasItAndLiesAsItWasLaidOut) {
  client::SceneObject stone;
  stone.index = 7;
  stone.movable = true;
  stone.X_WB = {{0, 1, 0}, Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()))};
  client::Frame frame;
  client::WorldPresentation presentation;
  presentation.affordances = {{client::Affordance::Kind::taken, "HOLD", 7, {}, {}, {}}};
  const std::vector<std::string> enabled{"HOLD"};
  PointerWorld world{nullptr, {&stone, 1}, &presentation, enabled};
  const auto laid_out = senses_of(world, 7, false);
  ASSERT_TRUE(laid_out && laid_out->R_WB_rest);
  EXPECT_EQ(laid_out->X_WB.p, stone.X_WB.p);
  EXPECT_TRUE(laid_out->leeway.taken);
  frame.bodies = {{7, {{2, 1, 0}, Quat::Identity()}}};
  world.frame = &frame;
  const auto moved = senses_of(world, 7, true);
  ASSERT_TRUE(moved && moved->R_WB_rest);
  EXPECT_TRUE(moved->holding);
  EXPECT_EQ(moved->X_WB.p, Vec3(2, 1, 0));
  EXPECT_TRUE(moved->R_WB_rest->isApprox(stone.X_WB.R));
  EXPECT_FALSE(senses_of(world, 8, false)) << "not in the manifest";
  world.presentation = nullptr;
  EXPECT_FALSE(senses_of(world, 7, false)) << "it has not come yet";
}

}  // namespace
}  // namespace mechane::pointer
