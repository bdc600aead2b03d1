#include "server/hand/governor.hpp"

#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"

namespace mechane::hand {
namespace {

using namespace std::chrono_literals;

constexpr Duration kDt = 1ms;
constexpr double kDt_s = 1e-3;
constexpr std::uint32_t kSafetyDrop = kStale | kRamping | kDamped | kNotFinite;

/// One hand's rules and what they remember.
struct OneHand {
  explicit OneHand(const GovernorConfig& config = {}) : governor(ForceGovernor::make(config).value()) {}
  HandForce apply(const GovernorInput& input, Duration dt = kDt) { return governor.apply(state, input, dt); }

  ForceGovernor governor;
  GovernorState state = governor.start();
};

// A governor that has finished ramping up with a force of `wanted` in x on the device.
OneHand settled(double wanted_n, GovernorConfig config = {}) {
  OneHand governor(config);
  GovernorInput input;
  input.wanted_W.f.x() = wanted_n;
  for (int i = 0; i < 1000; ++i)
    (void)governor.apply(input);
  return governor;
}

double number(int from, int to, double scale) {
  return scale * *rc::gen::inRange(from, to);
}

Vec3 vector(double scale) {
  return {number(-1000, 1001, scale), number(-1000, 1001, scale), number(-1000, 1001, scale)};
}

// Anything that a device, a network or a bug may come up with.
GovernorInput wild_input() {
  GovernorInput in;
  in.wanted_W.f = vector(0.02);
  in.wanted_W.t = vector(0.001);
  in.weight_W.f = vector(0.005);
  in.weight_W.t = vector(0.0002);
  in.V_WH.v = vector(0.002);
  in.V_WH.w = vector(0.01);
  for (double& f : in.finger_force_n)
    f = number(-100, 1000, 0.03);
  in.age = *rc::gen::element<Duration>(0ms, 1ms, 5ms, 10ms, 12ms, 25ms, 40ms, 49ms, 50ms, 60ms, Duration::max());
  in.engaged = *rc::gen::weightedElement<bool>({{9, true}, {1, false}});
  const double odd = *rc::gen::element(std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(), 1e300, -1e308);
  switch (*rc::gen::inRange(0, 60)) {
    case 0:
      in.wanted_W.f.y() = odd;
      break;
    case 1:
      in.wanted_W.t.z() = odd;
      break;
    case 2:
      in.V_WH.v.x() = odd;
      break;
    case 3:
      in.V_WH.w.x() = odd;
      break;
    case 4:
      in.finger_force_n[2] = odd;
      break;
    default:
      break;
  }
  return in;
}

bool is_zero(const HandForce& out) {
  bool fingers = true;
  for (const double f : out.finger_force_n)
    fingers = fingers && f == 0;
  return fingers && out.force_W.f == Vec3::Zero() && out.force_W.t == Vec3::Zero();
}

RC_GTEST_PROP(ForceGovernor, NeverLeavesItsLimitsWhateverComesIn, ()) {
  GovernorConfig config;
  config.passivity = *rc::gen::arbitrary<bool>();
  config.ramp_up_s = *rc::gen::element(0.0, 0.01, 0.5);
  config.ramp_down_s = *rc::gen::element(0.0, 0.01, 0.1);
  OneHand governor(config);
  HandForce last;
  for (int i = 0; i < 60; ++i) {
    const GovernorInput in = wild_input();
    const HandForce out = governor.apply(in);
    RC_ASSERT(out.force_W.f.norm() <= config.max_force_n * (1 + 1e-12));
    RC_ASSERT(out.force_W.t.norm() <= config.max_torque_nm * (1 + 1e-12));
    for (const double f : out.finger_force_n)
      RC_ASSERT(f >= 0 && f <= config.max_finger_force_n * (1 + 1e-12));
    if (in.age >= config.zero_by) RC_ASSERT(is_zero(out));
    if ((out.reasons & kNotFinite) != 0) RC_ASSERT(is_zero(out));

    const double change = (out.force_W.f - last.force_W.f).norm();
    const double step = config.max_slew_n_per_s * kDt_s * (1 + 1e-9) + 1e-12;
    if ((out.reasons & kSafetyDrop) == 0) RC_ASSERT(change <= step);
    // A safety drop may fall as fast as it likes; nothing ever rises faster, but for the observer's damping: once more the step.
    const double steps = (out.reasons & kDamped) != 0 ? 2 : 1;
    RC_ASSERT(out.force_W.f.norm() <= last.force_W.f.norm() + steps * step);
    const double torque_step = config.max_torque_slew_nm_per_s * kDt_s * (1 + 1e-9) + 1e-12;
    RC_ASSERT(out.force_W.t.norm() <= last.force_W.t.norm() + torque_step);
    last = out;
  }
}

TEST(ForceGovernor, LeavesAModestForceAlone) {
  OneHand governor = settled(1.5);
  GovernorInput input;
  input.wanted_W.f = Vec3(1.5, 0, 0);
  const HandForce out = governor.apply(input);
  EXPECT_EQ(out.force_W.f, Vec3(1.5, 0, 0));
  EXPECT_EQ(out.reasons, kNone);
}

TEST(ForceGovernor, ClampsTheVectorAndKeepsItsDirection) {
  OneHand governor;
  GovernorInput input;
  input.wanted_W.f = Vec3(30, -40, 0);
  HandForce out;
  for (int i = 0; i < 1000; ++i)
    out = governor.apply(input);
  EXPECT_NEAR(out.force_W.f.norm(), 3.0, 1e-12);
  EXPECT_TRUE(out.force_W.f.normalized().isApprox(Vec3(0.6, -0.8, 0), 1e-12));
  EXPECT_EQ(out.reasons, kClamped);
  EXPECT_EQ(governor.state.count(kClamped), 1000u);
}

TEST(ForceGovernor, HoldsTo10msFallsAtOnceAndIsZeroBy50msHoweverSlowTheSlew) {
  GovernorConfig config;
  config.max_slew_n_per_s = 10;  // 0.01 N a tick: the decay must not wait for it
  OneHand governor = settled(2.0, config);
  GovernorInput input;
  input.wanted_W.f = Vec3(2, 0, 0);
  for (int ms = 0; ms <= 60; ++ms) {
    input.age = std::chrono::milliseconds(ms);
    const HandForce out = governor.apply(input);
    EXPECT_NEAR(out.force_W.f.x(), 2.0 * freshness(input.age), 1e-9) << ms << " ms";
    EXPECT_EQ(out.force_W.f.x() == 0.0, ms >= 50);
    EXPECT_EQ((out.reasons & kStale) != 0, ms > 10);
  }
  input.age = 0ms;
  EXPECT_LE(governor.apply(input).force_W.f.x(), 0.01 + 1e-12) << "back again, the slew limit holds";
}

TEST(ForceGovernor, RampsUpAtTheStartAndDownAtTheEnd) {
  OneHand governor;
  GovernorInput input;
  input.wanted_W.f = Vec3(1, 0, 0);
  EXPECT_LT(governor.apply(input).force_W.f.x(), 0.01);
  HandForce out;
  for (int i = 1; i < 250; ++i)
    out = governor.apply(input);
  EXPECT_NEAR(out.force_W.f.x(), 0.5, 0.01);
  EXPECT_NE(out.reasons & kRamping, 0u);
  for (int i = 0; i < 300; ++i)
    out = governor.apply(input);
  EXPECT_EQ(out.force_W.f.x(), 1.0);
  input.engaged = false;
  for (int i = 0; i < 101; ++i)
    out = governor.apply(input);
  EXPECT_TRUE(is_zero(out));
}

TEST(ForceGovernor, ALateCallDoesNotMakeUpForTheTimeItMissed) {
  GovernorInput input;
  input.wanted_W.f.x() = 3;
  OneHand starting;
  (void)starting.apply(input, 4s);
  EXPECT_LE(starting.apply(input, 4s).force_W.f.norm(), 3 * 2 * to_seconds(ForceGovernor::kLongestStep) / 0.5);
  OneHand pressing = settled(0.5);
  EXPECT_LE(pressing.apply(input, 20ms).force_W.f.norm(), 0.5 + 1000 * to_seconds(ForceGovernor::kLongestStep));
}

/// From zero, by no more than the ramp allows, to all of `wanted_n` in x.
void expect_ramp(OneHand& governor, double wanted_n) {
  GovernorInput input;
  input.wanted_W.f.x() = wanted_n;
  const double ramp_s = governor.governor.config().ramp_up_s;
  for (int i = 1; i <= 490; ++i) {
    const double force_n = governor.apply(input).force_W.f.x();
    ASSERT_LE(force_n, wanted_n * (i + 1) * kDt_s / ramp_s) << i << " ms";
  }
  for (int i = 0; i < 12; ++i)
    (void)governor.apply(input);
  EXPECT_NEAR(governor.apply(input).force_W.f.x(), wanted_n, 1e-12);
}

TEST(ForceGovernor, ANumberThatIsNotFiniteIsNoForceAtAllAndTheNextForceIsRampedUp) {
  OneHand governor = settled(2.0);
  GovernorInput input;
  input.wanted_W.f = Vec3(std::nan(""), 0, 0);
  const HandForce out = governor.apply(input);
  EXPECT_TRUE(is_zero(out));
  EXPECT_EQ(out.reasons, kNotFinite);
  EXPECT_EQ(governor.state.count(kNotFinite), 1u);
  expect_ramp(governor, 2.0);
}

TEST(ForceGovernor, ANumberThatIsNotFiniteAHundredTimesASecondIsNearlyNoForce) {
  OneHand governor = settled(2.0);
  for (int ms = 0; ms < 1000; ++ms) {
    GovernorInput input;
    input.wanted_W.f.x() = ms % 10 == 0 ? std::nan("") : 2.0;
    ASSERT_LE(governor.apply(input).force_W.f.x(), 2.0 * 10 * kDt_s / governor.governor.config().ramp_up_s) << ms;
  }
}

TEST(ForceGovernor, ARampUpWaitsWhileTheHandIsInContactAndARampDownDoesNot) {
  OneHand governor;
  GovernorInput input;
  input.wanted_W.f.x() = 2.0;
  input.touching = true;
  for (int ms = 0; ms < 1000; ++ms)
    ASSERT_TRUE(is_zero(governor.apply(input))) << ms;
  expect_ramp(governor, 2.0);
  EXPECT_NEAR(governor.apply(input).force_W.f.x(), 2.0, 1e-12) << "a contact that is made later";
  input.engaged = false;
  for (int ms = 0; ms < 101; ++ms)
    (void)governor.apply(input);
  EXPECT_TRUE(is_zero(governor.apply(input)));
}

TEST(ForceGovernor, AForceThatWasLostToAnOldSampleIsRampedUp) {
  OneHand governor = settled(2.0);
  GovernorInput input;
  input.wanted_W.f.x() = 2.0;
  input.age = 50ms;
  EXPECT_TRUE(is_zero(governor.apply(input)));
  expect_ramp(governor, 2.0);
}

// A virtual wall whose force comes late: the classic way to make a haptic system put out energy. The hand is a mass that flies against
// it. The account is kept from the outside, with the positions.
struct Bounce {
  double energy_out_j;  // given to the hand
  double peak_out_j;    // the most that was ever given out
  double speed_out;     // over the speed of arrival
};

Bounce bounce(bool passivity, int delay_ticks, double stiffness, double speed, double mass = 0.3, double slew = 20'000,
              double credit_j = 0, bool strict_energy = false) {
  GovernorConfig config;
  config.passivity = passivity;
  config.strict_energy = strict_energy;
  config.max_force_n = 20;
  config.max_slew_n_per_s = slew;
  config.ramp_up_s = 0;
  OneHand governor(config);
  governor.state.credit_j = std::max(governor.state.credit_j, credit_j);
  std::deque<double> late(static_cast<std::size_t>(delay_ticks), 0.0);
  double x = 0.01, v = -speed, force = 0, out_j = 0, peak_j = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x_before = x;
    v += force / mass * kDt_s;
    x += v * kDt_s;
    out_j += force * (x - x_before);
    peak_j = std::max(peak_j, out_j);
    late.push_back(x < 0 ? -stiffness * x : 0);
    GovernorInput input;
    input.wanted_W.f.x() = late.front();
    late.pop_front();
    input.V_WH.v.x() = (x - x_before) / kDt_s;
    force = governor.apply(input).force_W.f.x();
  }
  return {out_j, peak_j, std::abs(v) / speed};
}

TEST(ForceGovernor, TheDelayedWallWithoutObserverGivesOutEnergy) {
  const Bounce b = bounce(false, 10, 1500, 0.2);
  EXPECT_GT(b.energy_out_j, 0.005) << "or the next test proves nothing";
  EXPECT_GT(b.speed_out, 1.3);
}

RC_GTEST_PROP(ForceGovernor, TheObserverBoundsTheEnergyOfADelayedWall, ()) {
  const int delay = *rc::gen::inRange(1, 30);
  const double stiffness = number(100, 2000, 1.0);
  const double speed = number(5, 50, 0.01);
  const double slew = number(100, 2000, 10.0);
  const Bounce b = bounce(true, delay, stiffness, speed, 0.3, slew);
  // The margin, and what one tick's force does over the change of velocity that the tick could not foresee.
  const double unforeseen_j = 20.0 * (20.0 / 0.3 * kDt_s) * kDt_s;
  RC_ASSERT(b.peak_out_j <= GovernorConfig{}.energy_margin_j + 2 * unforeseen_j);
}

TEST(ForceGovernor, WhatAHandPutInPaysForNothingOnceItIsFree) {
  const double credit_j = GovernorConfig{}.energy_credit_j;
  EXPECT_GT(bounce(true, 10, 1500, 0.2, 0.3, 20'000, credit_j).peak_out_j, 0.005) << "or the next line proves nothing";
  EXPECT_LE(bounce(true, 10, 1500, 0.2, 0.3, 20'000, credit_j, true).peak_out_j, 0.003);
}

TEST(ForceGovernor, AnOverdrawnAccountLetsNoForceRiseOnAHandAtRest) {
  GovernorConfig config;
  config.strict_energy = true;
  OneHand governor = settled(1.0, config);
  governor.state.credit_j = -0.001;
  GovernorInput input;
  input.touching = true;
  input.wanted_W.f.x() = 2.0;
  HandForce out;
  for (int ms = 0; ms < 100; ++ms)
    out = governor.apply(input);
  EXPECT_EQ(out.force_W.f.x(), 1.0);
  EXPECT_NE(out.reasons & kDamped, 0u);
  input.V_WH.v.x() = -0.01;  // it presses in, and so pays
  for (int ms = 0; ms < 10; ++ms)
    out = governor.apply(input);
  EXPECT_GE(out.force_W.f.x(), 2.0);
}

TEST(ForceGovernor, DampingOnADeviceKeepsToTheSlewLimit) {
  GovernorConfig config;
  config.strict_energy = true;
  OneHand governor = settled(0.0, config);
  governor.state.credit_j = -0.1;
  GovernorInput input;
  input.touching = true;
  input.wanted_W.f.x() = 3.0;
  input.V_WH.v.x() = -0.3;  // it presses in, and is damped for what it owes
  const HandForce out = governor.apply(input);
  EXPECT_NE(out.reasons & kDamped, 0u);
  EXPECT_NEAR(out.force_W.f.x(), config.max_slew_n_per_s * kDt_s, 1e-9);

  OneHand pressed = settled(2.5, config);
  pressed.state.credit_j = -0.1;
  const Vec3 before = pressed.state.last.force_W.f;
  input.wanted_W.f = before + Vec3(0, 1, 0);
  input.V_WH.v = Vec3(0, -0.3, 0);
  const Vec3 after = pressed.apply(input).force_W.f;
  EXPECT_LE((after - before).norm(), config.max_slew_n_per_s * kDt_s + 1e-9) << "nor across the force";
}

/// A hand sinks under what it carries, and something else pushes it down, too.
TEST(ForceGovernor, AWeightIsGivenToAHandThatSinksAndNothingElseIs) {
  for (const bool strict : {false, true}) {
    OneHand governor({.strict_energy = strict});
    GovernorInput input;
    input.wanted_W = input.weight_W = {Vec3(0, -2, 0), Vec3(0, 0, 0.05)};
    for (int i = 0; i < 1000; ++i)
      (void)governor.apply(input);
    input.V_WH.v = Vec3(0, -0.2, 0);
    input.V_WH.w = Vec3(0, 0, 1);
    input.wanted_W.f.y() = -2.5;
    HandForce felt;
    for (int i = 0; i < 500; ++i)
      felt = governor.apply(input);
    EXPECT_NEAR(felt.force_W.f.y(), -2, 1e-9);
    EXPECT_NEAR(felt.force_W.t.z(), 0.05, 1e-9);
    EXPECT_NE(felt.reasons & kDamped, 0u) << "the rest is held back";
    input.weight_W = {};
    for (int i = 0; i < 500; ++i)
      felt = governor.apply(input);
    EXPECT_GT(felt.force_W.f.y(), -0.01) << "the same push without a weight";
  }
}

/// What was lifted pays for another force, as the pull of a place, and up and down again leaves nothing.
TEST(ForceGovernor, WhatAHandLiftedIsPaidOutOnce) {
  const auto pushed_n = [](double lift_m_per_s, double then_m_per_s) {
    OneHand governor({.strict_energy = true});
    GovernorInput input;
    input.wanted_W.f = input.weight_W.f = Vec3(0, -2, 0);
    const auto go = [&](const Vec3& v_W, int ms) {
      input.V_WH.v = v_W;
      HandForce felt;
      for (int i = 0; i < ms; ++i)
        felt = governor.apply(input);
      return felt.force_W.f.x();
    };
    go(Vec3::Zero(), 1000);
    go(Vec3(0, lift_m_per_s, 0), 500);
    go(Vec3(0, then_m_per_s, 0), 500);
    input.wanted_W.f.x() = 1;
    return go(Vec3(0.1, 0, 0), 300);  // 30 mJ
  };
  EXPECT_NEAR(pushed_n(0.1, 0), 1, 1e-9) << "100 mJ were put in";
  EXPECT_LT(pushed_n(0.1, -0.1), 0.1) << "they were given back";
  EXPECT_LT(pushed_n(-0.1, 0.1), 0.1) << "sunk first, and lifted to where it was";
  EXPECT_LT(pushed_n(-0.1, 0), 0.1);
}

TEST(ForceGovernor, APassiveWallIsNotDamped) {
  const Bounce with = bounce(true, 1, 300, 0.1, 1.0);
  EXPECT_NEAR(with.speed_out, 1.0, 0.05);
}

TEST(ForceGovernor, RefusesSettingsOutOfRangeByName) {
  using mechane::test::is_error;
  const auto error_of = [](auto change) {
    GovernorConfig config;
    change(config);
    const auto made = ForceGovernor::make(config);
    return made ? Error{} : made.error();
  };
  EXPECT_EQ(error_of([](auto&) {}).what, "");
  EXPECT_THAT(error_of([](auto& c) { c.max_force_n = -1; }),
              is_error(ErrorCode::invalid_value, 0, {"max_force_n", "-1", "from 0"}));
  EXPECT_THAT(error_of([](auto& c) { c.max_slew_n_per_s = std::nan(""); }),
              is_error(ErrorCode::invalid_value, 0, {"max_slew_n_per_s"}));
  EXPECT_THAT(error_of([](auto& c) { c.energy_credit_j = 0; }),
              is_error(ErrorCode::invalid_value, 0, {"energy_credit_j"}));
  EXPECT_THAT(error_of([](auto& c) { c.zero_by = c.hold; }), is_error(ErrorCode::conflict, 0, {"zero_by"}));
}

/// A push that the observer must damp, with every field of the state in use.
GovernorInput lively_input(int i) {
  GovernorInput input;
  input.wanted_W = {Vec3(2, std::sin(0.1 * i), 0), Vec3(0, 0.1, 0)};
  input.finger_force_n = {1, 2, 3, 4, 5};
  input.V_WH.v.x() = 0.1;
  input.age = std::chrono::milliseconds(i % 30);
  return input;
}

TEST(ForceGovernor, GoesOnFromACopiedStateToTheSameBits) {
  OneHand one;
  for (int i = 0; i < 300; ++i)
    (void)one.apply(lively_input(i));
  OneHand other;
  other.state = one.state;
  for (int i = 300; i < 600; ++i) {
    const HandForce a = one.apply(lively_input(i));
    const HandForce b = other.apply(lively_input(i));
    ASSERT_EQ(a.force_W.f, b.force_W.f) << i;
    ASSERT_EQ(a.force_W.t, b.force_W.t) << i;
    ASSERT_EQ(a.finger_force_n, b.finger_force_n) << i;
    ASSERT_EQ(a.reasons, b.reasons) << i;
  }
  EXPECT_EQ(one.state.counts, other.state.counts);
}

TEST(ForceGovernor, AResetKeepsTheCountsAndNothingElse) {
  OneHand hand;
  for (int i = 0; i < 300; ++i)
    (void)hand.apply(lively_input(i));
  const auto counts = hand.state.counts;
  ASSERT_GT(counts[2], 0u) << "the observer must have damped";
  hand.governor.reset(hand.state);
  EXPECT_EQ(hand.state.counts, counts);
  EXPECT_EQ(hand.state.credit_j, hand.governor.start().credit_j);
  EXPECT_EQ(hand.state.gain, 0);
  EXPECT_EQ(hand.state.ramp, 0);
  EXPECT_TRUE(is_zero(hand.state.last));
}

TEST(ForceGovernor, AllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  OneHand governor;
  GovernorInput input;
  input.wanted_W.f = Vec3(30, 1, 2);
  input.V_WH.v = Vec3(0.3, 0, 0);
  const test::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) {
    input.age = std::chrono::milliseconds(i % 70);
    (void)governor.apply(input);
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

}  // namespace
}  // namespace mechane::hand
