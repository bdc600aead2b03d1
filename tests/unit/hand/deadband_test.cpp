// What deadband coding leaves out: never more than the share, never for longer than its time, never what is not a matter of degree.
#include "server/hand/deadband.hpp"

#include <functional>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/hand/local_contact_model.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::hand {
namespace {

using namespace std::chrono_literals;
using test::any_unit;
using test::between;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr TimePoint kStart{1h};

double any_share() {
  return *between(0.01, kMaxDeadband);
}

HandSample any_sample() {
  HandSample sample;
  sample.X_WH.p = 0.3 * any_unit();
  sample.V_WH.v = 0.2 * any_unit();
  return sample;
}

HapticOutput any_answer() {
  HapticOutput answer;
  answer.force_W = {2 * any_unit(), 0.1 * any_unit()};
  answer.finger_force_n = {1, 2, 0, 0, 0};
  answer.contact_count = 1;
  answer.contacts[0] = {.n_W = any_unit(),
                        .depth_m = *between(-0.02, 0.01),
                        .curvature_per_m = *between(-20, 20),
                        .stiffness_n_per_m = 600,
                        .damping_ns_per_m = 1.5,
                        .static_friction = 0.5,
                        .dynamic_friction = 0.3};
  return answer;
}

RC_GTEST_PROP(InputDeadband, AServerNeverHasAHandThatIsOffByMoreThanTheShareNorAnOldOne, ()) {
  const double share = any_share();
  InputDeadband deadband(share);
  HandSample hand = any_sample(), received;
  TimePoint now = kStart, received_at;
  int sent = 0;
  for (int i = 0; i < 50; ++i, now += kTickPeriod) {
    const double reach = *between(0, 0.02);
    hand.X_WH.p += *between(0, 2e-3) * any_unit();
    if (deadband.is_due(hand, reach, now)) {
      deadband.note_sent(received = hand, received_at = now);
      ++sent;
    }
    RC_ASSERT((received.X_WH.p - hand.X_WH.p).norm() <= kFineWay_m + share * reach);
    RC_ASSERT(now - received_at < kKeepAlive);
  }
  RC_ASSERT(sent >= 12);
}

TEST(InputDeadband, SendsAHandAtRestEachFourMilliseconds) {
  InputDeadband deadband(0.1);
  const HandSample hand;
  int sent = 0;
  for (int i = 0; i < 100; ++i) {
    const TimePoint now = kStart + i * kTickPeriod + (i % 2) * 100us;
    if (!deadband.is_due(hand, 0, now)) continue;
    deadband.note_sent(hand, now);
    ++sent;
  }
  EXPECT_EQ(sent, 25);
}

TEST(InputDeadband, ButtonsFingersAndGraspAndWhatIsNotANumberNeverWait) {
  const std::vector<std::function<void(HandSample&)>> changes{[](HandSample& s) { s.buttons ^= 4; },
                                                              [](HandSample& s) { s.grasp_intent = 0.01; },
                                                              [](HandSample& s) { s.joints[7] = 1e-6; },
                                                              [](HandSample& s) { s.kind = HandKind::glove; },
                                                              [](HandSample& s) { s.hand_scale = 1.01; },
                                                              [](HandSample& s) { s.X_WH.p.y() = kNaN; },
                                                              [](HandSample& s) { s.X_WH.R.w() = kNaN; },
                                                              [](HandSample& s) { s.V_WH.v.x() = kNaN; },
                                                              [](HandSample& s) { s.V_WH.w.z() = kNaN; },
                                                              [](HandSample& s) { s.joints[3] = kNaN; },
                                                              [](HandSample& s) { s.grasp_intent = kNaN; },
                                                              [](HandSample& s) { s.V_WH.v.x() = 10; },
                                                              [](HandSample& s) { s.X_WH.R = Quat(0, 1, 0, 0); }};
  InputDeadband deadband(kMaxDeadband);
  deadband.note_sent({}, kStart);
  ASSERT_FALSE(deadband.is_due({}, 0.02, kStart + 1ms));
  EXPECT_TRUE(deadband.is_due({}, kNaN, kStart + 1ms));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    HandSample hand;
    changes[i](hand);
    EXPECT_TRUE(deadband.is_due(hand, 0.02, kStart + 1ms)) << "change " << i;
  }
}

RC_GTEST_PROP(OutputDeadband, AClientNeverHasAForceOrASurfaceThatIsOffByMoreThanTheShare, ()) {
  const double share = any_share();
  OutputDeadband deadband;
  HapticOutput answer = any_answer(), received;
  Vec3 p_WH = Vec3::Zero(), p_WH_received;
  TimePoint now = kStart, received_at;
  for (int i = 0; i < 50; ++i, now += kTickPeriod) {
    ++answer.echo_sequence;
    p_WH += *between(0, 1e-3) * any_unit();
    answer.force_W.f += *between(0, 0.2) * any_unit();
    LocalContact& contact = answer.contacts[0];
    contact.depth_m += *between(-5e-4, 5e-4);
    contact.n_W = (contact.n_W + *between(0, 0.05) * any_unit()).normalized();
    if (deadband.is_due(share, answer, p_WH, now))
      deadband.note_sent(received = answer, p_WH_received = p_WH, received_at = now);
    RC_ASSERT(now - received_at < kKeepAlive);
    const Vec3 off_n = received.force_W.f - answer.force_W.f;
    RC_ASSERT(off_n.norm() <= kFineForce_n + share * answer.force_W.f.norm());
    const LocalContact& known = received.contacts[0];
    const Overlap seen = overlap_of(known, p_WH_received + known.depth_m * known.n_W, p_WH);
    RC_ASSERT(std::abs(seen.depth_m - contact.depth_m) <= kFineWay_m + share * std::abs(contact.depth_m) + 1e-12);
    RC_ASSERT((seen.n_W - contact.n_W).norm() <= share + 1e-12);
  }
}

/// A hand that goes round a ball, and a wall that comes towards a hand: what the client makes of one answer is enough.
TEST(OutputDeadband, WhatTheClientFindsOutByItselfIsLeftOut) {
  constexpr double kBall_m = 0.05;
  HapticOutput around;
  around.contact_count = 1;
  around.contacts[0] = {.depth_m = 0.002, .curvature_per_m = 1 / kBall_m, .stiffness_n_per_m = 600};
  HapticOutput approached = around;
  approached.contacts[0] = {.v_W = Vec3(0.2, 0, 0), .depth_m = 0.002, .stiffness_n_per_m = 600};
  const auto place = [](double angle_rad) {
    return Vec3((kBall_m - 0.002) * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0));
  };
  OutputDeadband ball, wall;
  ball.note_sent(around, place(0), kStart);
  wall.note_sent(approached, Vec3::Zero(), kStart);
  for (int ms = 1; ms < 4; ++ms) {
    const double angle_rad = 0.05 * ms;  // 2.5 mm: the normal turns by more than the share
    around.contacts[0].n_W = place(angle_rad).normalized();
    EXPECT_FALSE(ball.is_due(0.01, around, place(angle_rad), kStart + ms * 1ms)) << ms;
    approached.contacts[0].depth_m += 0.0002;
    EXPECT_FALSE(wall.is_due(0.01, approached, Vec3::Zero(), kStart + ms * 1ms)) << ms;
  }
}

TEST(OutputDeadband, AnswersToTheSameSampleKeepNothingAlive) {
  OutputDeadband deadband;
  HapticOutput answer;
  answer.echo_sequence = 7;
  deadband.note_sent(answer, Vec3::Zero(), kStart);
  EXPECT_FALSE(deadband.is_due(0.1, answer, Vec3::Zero(), kStart + 100ms));
  ++answer.echo_sequence;
  EXPECT_FALSE(deadband.is_due(0.1, answer, Vec3::Zero(), kStart + 3ms));
  EXPECT_TRUE(deadband.is_due(0.1, answer, Vec3::Zero(), kStart + 4ms));
}

TEST(OutputDeadband, EventsAndWhatIsNotANumberNeverWait) {
  const std::vector<std::function<void(HapticOutput&)>> changes{
      [](HapticOutput& a) { a.reasons = kRamping; },
      [](HapticOutput& a) { a.holding = false; },
      [](HapticOutput& a) { ++a.clicks.count; },
      [](HapticOutput& a) { a.contact_count = 2; },
      [](HapticOutput& a) { a.held.kind = HeldPath::Kind::none; },
      [](HapticOutput& a) { a.held.along_n = 2; },
      [](HapticOutput& a) { a.held.along_n = kNaN; },
      [](HapticOutput& a) { a.held.p_W.x() = 0.001; },
      [](HapticOutput& a) { a.held.axis_W = Vec3::UnitZ(); },
      [](HapticOutput& a) { a.force_W.t.x() = 0.1; },
      [](HapticOutput& a) { a.force_W.f.x() = kNaN; },
      [](HapticOutput& a) { a.force_W.t.z() = kNaN; },
      [](HapticOutput& a) { a.finger_force_n[2] = 1; },
      [](HapticOutput& a) { a.finger_force_n[4] = kNaN; },
      [](HapticOutput& a) { a.contacts[0].depth_m = kNaN; },
      [](HapticOutput& a) { a.contacts[0].v_W.y() = kNaN; },
      [](HapticOutput& a) { a.contacts[0].stiffness_n_per_m = 1800; },
      [](HapticOutput& a) { a.contacts[0].grooves.phase_rad = 2; },
      [](HapticOutput& a) { a.contacts[0].validity = 1ms; }};
  HapticOutput before;
  before.holding = true;
  before.held = {
      .kind = HeldPath::Kind::circle, .radius_m = 0.1, .along_n = 0.1, .stiffness_n_per_m = 600, .limit_n = 6};
  before.contact_count = 1;
  before.contacts[0].stiffness_n_per_m = 600;
  OutputDeadband deadband;
  deadband.note_sent(before, Vec3::Zero(), kStart);
  ASSERT_FALSE(deadband.is_due(kMaxDeadband, before, Vec3::Zero(), kStart + 1ms));
  EXPECT_TRUE(deadband.is_due(0, before, Vec3::Zero(), kStart + 1ms)) << "off";
  EXPECT_TRUE(deadband.is_due(kMaxDeadband, before, Vec3(kNaN, 0, 0), kStart + 1ms));
  for (std::size_t i = 0; i < changes.size(); ++i) {
    HapticOutput answer = before;
    changes[i](answer);
    EXPECT_TRUE(deadband.is_due(kMaxDeadband, answer, Vec3::Zero(), kStart + 1ms)) << "change " << i;
  }
}

/// From outside and from inside; and at a grip.
TEST(Deadband, AReachIsTheWayToTheNearestSurfaceOrTheStretchOfTheGrip) {
  HapticOutput answer;
  EXPECT_EQ(reach_m(answer, Vec3::Zero(), Vec3::Zero()), 0.02);
  answer.force_W.f.x() = 0.6;
  EXPECT_DOUBLE_EQ(reach_m(answer, Vec3::Zero(), Vec3::Zero()), 0.001) << "contacts are not always told";
  answer.contact_count = 1;
  answer.contacts[0] = {.n_W = Vec3::UnitY(), .depth_m = -0.01};
  EXPECT_DOUBLE_EQ(reach_m(answer, Vec3::Zero(), Vec3(0.5, -0.006, 0)), 0.004);
  EXPECT_DOUBLE_EQ(reach_m(answer, Vec3::Zero(), Vec3(0, -0.012, 0)), 0.002);
  answer.holding = true;
  answer.force_W.f.x() = 0.3;
  EXPECT_DOUBLE_EQ(reach_m(answer, Vec3::Zero(), Vec3::Zero()), 0.0005);
  answer.held = {.kind = HeldPath::Kind::line, .stiffness_n_per_m = 1200};
  EXPECT_DOUBLE_EQ(reach_m(answer, Vec3::Zero(), Vec3::Zero()), 0.00025);
}

}  // namespace
}  // namespace mechane::hand
