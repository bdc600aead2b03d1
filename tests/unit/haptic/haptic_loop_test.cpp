// The client's haptic loop against a server of the test's own: what the device renders when answers stop and come back.
#include "client-sdk/haptic/haptic_loop.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "client-sdk/haptic/virtual_device.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;
using test::ScriptedClient;

constexpr double kPressN = 2;

/// A device that stands still.
class StillDevice final : public Device {
 public:
  Vec3 force_W = Vec3::Zero();
  bool there = true;
  DeviceCondition now = DeviceCondition::ready;
  bool has_motors = true;
  double continuous_n = hand::GovernorConfig{}.max_force_n;
  int opened = 0;
  int closed = 0;

  [[nodiscard]] Expected<void> open() override {
    if (!there) return fail(ErrorCode::not_found, "no device", "the test", "connect one");
    ++opened;
    return {};
  }
  void close() noexcept override { ++closed; }
  [[nodiscard]] client::HandSample read(Duration) noexcept override { return {}; }
  void write(const hand::HandForce& force) noexcept override { force_W = force.force_W.f; }
  [[nodiscard]] DeviceCondition condition() const noexcept override { return now; }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }
  [[nodiscard]] double continuous_force_n() const override { return continuous_n; }
  [[nodiscard]] bool renders() const override { return has_motors; }
};

class HapticLoopTest : public ::testing::Test {
 protected:
  void SetUp() override { render(RenderMode::server); }
  void render(RenderMode mode) {
    loop_.reset();
    auto made = HapticLoop::create(client_, device_, mode);
    ASSERT_TRUE(made.has_value()) << made.error().to_string();
    loop_ = std::move(*made);
  }
  /// The next tick, `dt` after the last one; the server answers the sample before it with kPressN, or not at all.
  /// Returns the rendered force, N.
  double tick(bool answered, Duration dt = kTickPeriod) {
    if (answered) return tick_answered(client_.sent_sequence(), dt);
    now_ += dt;
    loop_->tick(now_, dt);
    return device_.force_W.norm();
  }
  /// The same, with an answer to the sample `echo`: as a force, and as a contact.
  double tick_answered(std::uint64_t echo, Duration dt = kTickPeriod) {
    client::ForceSample& answer = client_.next_answer(now_ + dt);
    answer.echo_sequence = echo;
    answer.force_W.f = Vec3(0, kPressN, 0);
    answer.holding = holding_;
    answer.clicks = clicks_;
    if (holding_) answer.held = held_;
    answer.contact_count = touching_ ? 1 : 0;
    answer.contacts[0] = {.n_W = Vec3::UnitY(), .depth_m = 0.001, .stiffness_n_per_m = 1000 * kPressN};
    return tick(false, dt);
  }
  double tick_for(Duration time, bool answered) {
    double force_n = 0;
    for (Duration past{0}; past < time; past += kTickPeriod)
      force_n = tick(answered);
    return force_n;
  }
  /// A new loop, whose hand is free until the ramp is over and then in contact.
  void press(RenderMode mode) {
    render(mode);
    touching_ = false;
    tick_for(1s, true);
    touching_ = true;
    ASSERT_NEAR(tick_for(20ms, true), kPressN, 1e-9);
  }
  /// From zero, by no more than the ramp of a visit's start allows, to all of it.
  void expect_ramp() {
    const double ramp_s = device_.limits().ramp_up_s;
    for (double t_s = 0; t_s < ramp_s; t_s += to_seconds(kTickPeriod))
      ASSERT_LE(tick(true), kPressN * (t_s + 4 * to_seconds(kTickPeriod)) / ramp_s)
          << t_s << " s after the first answer";
    EXPECT_NEAR(tick_for(20ms, true), kPressN, 1e-9);
  }

  ScriptedClient client_;
  StillDevice device_;
  std::unique_ptr<HapticLoop> loop_;
  TimePoint now_{1h};
  bool holding_ = false;
  hand::HeldPath held_;
  hand::Clicks clicks_;
  bool touching_ = false;  // what answers say
};

TEST_F(HapticLoopTest, TheFirstForceIsRampedUpHoweverLongTheHandWaitedForIt) {
  EXPECT_EQ(tick_for(3s, false), 0);
  expect_ramp();
}

TEST_F(HapticLoopTest, AForceThatComesBackAfterASilenceBeginsFromZero) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  EXPECT_EQ(tick_for(60ms, false), 0);
  expect_ramp();
}

TEST_F(HapticLoopTest, AClickIsFeltBesideTheForceAndNotTwice) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  const auto furthest_n = [this] {
    double most_n = 0;
    for (int i = 0; i < 50; ++i)
      most_n = std::max(most_n, std::abs(tick(true) - kPressN));
    return most_n;
  };
  clicks_ = {.count = 1, .strength_n = 0.8};
  EXPECT_GT(furthest_n(), 0.4);
  EXPECT_NEAR(furthest_n(), 0, 1e-9);
}

TEST_F(HapticLoopTest, AnAnswerThatIsMissedNowAndThenIsNoSilence) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  for (int i = 0; i < 100; ++i) {
    ASSERT_NEAR(tick_for(5ms, false), kPressN, 1e-9);
    ASSERT_NEAR(tick(true), kPressN, 1e-9);
  }
}

TEST_F(HapticLoopTest, ALoopThatStoodStillForAMomentRendersNothingAtFirstThoughItsAnswerIsInTime) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  EXPECT_EQ(tick(true, 60ms), 0);
  EXPECT_LE(tick(true), 0.01 * kPressN) << "and then it is ramped up";
}

TEST_F(HapticLoopTest, ALoopThatStoodStillBeginsFromZeroThoughAnAnswerIsThereAtOnce) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  EXPECT_LE(tick(true, 4s), 0.01 * kPressN)
      << "a stopped process goes on, and finds an answer from before in its socket";
  expect_ramp();
}

TEST_F(HapticLoopTest, AServerThatAnswersButHearsNothingIsSilent) {
  for (const RenderMode mode : {RenderMode::server, RenderMode::local}) {
    ASSERT_NO_FATAL_FAILURE(press(mode));
    const std::uint64_t last_heard = client_.sent_sequence();
    for (int ms = 0; ms <= 9; ++ms)
      ASSERT_NEAR(tick_answered(last_heard), kPressN, 1e-9) << ms;
    for (int ms = 10; ms < 50; ++ms)
      ASSERT_LE(tick_answered(last_heard), kPressN) << ms;
    for (int ms = 50; ms < 400; ++ms)
      ASSERT_EQ(tick_answered(last_heard), 0) << ms;
    for (int ms = 0; ms < 1000; ++ms)
      ASSERT_EQ(tick(true), 0) << "still in contact, " << ms << " ms after it is heard again";
    touching_ = false;
    if (mode == RenderMode::server) expect_ramp();
    tick_for(1s, true);
    touching_ = true;
    EXPECT_NEAR(tick_for(20ms, true), kPressN, 1e-9);
  }
}

TEST_F(HapticLoopTest, AnAnswerToASampleThatWasNeverSentIsDropped) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  for (int ms = 0; ms < 60; ++ms)
    (void)tick_answered(client_.sent_sequence() + 50);
  EXPECT_EQ(device_.force_W.norm(), 0);
}

TEST_F(HapticLoopTest, TheForceIsLoweredWithTheDelayOfTheAnswers) {
  tick_for(1s, true);
  const auto settled_n = [this](std::uint64_t delay_ticks) {
    double force_n = 0;
    for (int ms = 0; ms < 3000; ++ms)
      force_n = tick_answered(client_.sent_sequence() - delay_ticks);
    return force_n;
  };
  EXPECT_NEAR(settled_n(4), kPressN, 1e-9);
  // The answer is taken a tick after it is made.
  EXPECT_NEAR(settled_n(19), kPressN * 5.5 / 20.5, 0.01);
  EXPECT_NEAR(settled_n(59), kPressN * 5.5 / 60.5, 0.01);
  EXPECT_NEAR(settled_n(0), kPressN, 0.01) << "and comes back";
}

TEST_F(HapticLoopTest, ThePullOfWhatIsHeldWithoutAPathIsLoweredWithTheDelayInEitherMode) {
  render(RenderMode::local);
  holding_ = true;
  tick_for(1s, true);
  double force_n = 0;
  for (int ms = 0; ms < 3000; ++ms)
    force_n = tick_answered(client_.sent_sequence() - 19);
  EXPECT_NEAR(force_n, kPressN * 5.5 / 20.5, 0.01);
}

/// The hand is 2 mm above the line, which pushes it along x.
class HapticLoopOnAPath : public HapticLoopTest {
 protected:
  void SetUp() override {
    render(RenderMode::local);
    holding_ = true;
    held_ = {.kind = hand::HeldPath::Kind::line,
             .p_W = Vec3(0, -0.002, 0),
             .axis_W = Vec3::UnitX(),
             .along_n = 1,
             .stiffness_n_per_m = 500,
             .limit_n = 6};
  }
  Vec3 settled_N(std::uint64_t delay_ticks) {
    for (int ms = 0; ms < 3000; ++ms)
      (void)tick_answered(client_.sent_sequence() - delay_ticks);
    return device_.force_W;
  }
};

TEST_F(HapticLoopOnAPath, OnlyTheForceAlongItIsLoweredWithTheDelay) {
  tick_for(1s, true);
  EXPECT_LT((settled_N(0) - Vec3(1, -1, 0)).norm(), 1e-6);
  EXPECT_LT((settled_N(19) - Vec3(5.5 / 20.5, -1, 0)).norm(), 0.01);
}

TEST_F(HapticLoopOnAPath, ContactsWithOtherThingsAreRenderedWithIt) {
  tick_for(1s, true);
  touching_ = true;
  EXPECT_LT((settled_N(0) - Vec3(1, -1 + kPressN, 0)).norm(), 1e-6);
}

TEST_F(HapticLoopOnAPath, TheServersForceIsRenderedWhereThatIsChosen) {
  render(RenderMode::server);
  tick_for(1s, true);
  EXPECT_LT((settled_N(0) - Vec3(0, kPressN, 0)).norm(), 1e-6);
}

TEST_F(HapticLoopOnAPath, APathThatAppearsComesInSlowly) {
  const hand::HeldPath path = std::exchange(held_, {});
  tick_for(1s, true);
  ASSERT_LT((device_.force_W - Vec3(0, kPressN, 0)).norm(), 1e-6);
  held_ = path;
  const Vec3 whole = Vec3(1, -1, 0) - device_.force_W;
  for (int ms = 0; ms < 110; ++ms) {
    const Vec3 before = device_.force_W;
    (void)tick(true);
    ASSERT_LE((device_.force_W - before).norm(), 0.0101 * whole.norm()) << ms;
  }
  EXPECT_LT((device_.force_W - Vec3(1, -1, 0)).norm(), 1e-6);
}

TEST_F(HapticLoopOnAPath, AWeightIsFeltInFullWhateverTheDelay) {
  held_ = {.kind = hand::HeldPath::Kind::free, .axis_W = Vec3::UnitY(), .along_n = 0.75 * kPressN};
  tick_for(1s, true);
  EXPECT_NEAR(settled_N(0).y(), kPressN, 1e-6);
  EXPECT_NEAR(settled_N(19).y(), (0.75 + 0.25 * 5.5 / 20.5) * kPressN, 0.01) << "the rest is lowered";
  render(RenderMode::server);
  tick_for(1s, true);
  EXPECT_NEAR(settled_N(19).y(), 5.5 / 20.5 * kPressN, 0.01);
}

TEST_F(HapticLoopOnAPath, AForceThatWasLostComesBackWhileTheThingIsHeld) {
  tick_for(1s, true);
  EXPECT_EQ(tick_for(60ms, false), 0);
  tick_for(1s, true);
  EXPECT_LT((device_.force_W - Vec3(1, -1, 0)).norm(), 1e-6);
}

TEST_F(HapticLoopTest, AnswersThatCameThroughALongQueueAreDropped) {
  for (const RenderMode mode : {RenderMode::server, RenderMode::local}) {
    ASSERT_NO_FATAL_FAILURE(press(mode));
    const std::uint64_t dropped = loop_->stats().too_late;
    for (int ms = 0; ms < 1000; ++ms)
      (void)tick_answered(client_.sent_sequence() - 500);
    EXPECT_EQ(device_.force_W.norm(), 0);
    EXPECT_EQ(loop_->stats().too_late, dropped + 1000);
  }
}

TEST_F(HapticLoopTest, AContactOfASampleTooLongAgoIsNotRendered) {
  ASSERT_NO_FATAL_FAILURE(press(RenderMode::local));
  for (int ms = 0; ms < 100; ++ms)  // a queue of 300 ms
    (void)tick_answered(client_.sent_sequence() - 300);
  EXPECT_EQ(device_.force_W.norm(), 0);
}

TEST_F(HapticLoopTest, ADeviceIsOpenedAndGivenZeroAndClosed) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  EXPECT_EQ(device_.opened, 1);
  EXPECT_EQ(device_.closed, 0);
  loop_.reset();
  EXPECT_EQ(device_.force_W, Vec3::Zero()) << "also without a release";
  EXPECT_EQ(device_.closed, 1);
}

TEST_F(HapticLoopTest, ADeviceThatIsNotThereIsAnError) {
  loop_.reset();
  device_.there = false;
  const auto made = HapticLoop::create(client_, device_, RenderMode::server);
  ASSERT_FALSE(made.has_value());
  EXPECT_EQ(made.error().code, ErrorCode::not_found);
}

TEST_F(HapticLoopTest, ADeviceThatIsNotReadyRendersNothingAndBeginsFromZero) {
  press(RenderMode::server);
  touching_ = false;
  for (const DeviceCondition condition : {DeviceCondition::not_ready, DeviceCondition::lost}) {
    device_.now = condition;
    EXPECT_EQ(tick(true), 0);
    EXPECT_EQ(tick(true), 0);
    device_.now = DeviceCondition::ready;
    expect_ramp();
  }
}

TEST_F(HapticLoopTest, VisitorsAreToldTheDevicesState) {
  using client::DeviceState;
  EXPECT_EQ(loop_->device_state(), DeviceState::preparing) << "before the first tick";
  const std::pair<DeviceCondition, DeviceState> states[] = {{DeviceCondition::ready, DeviceState::ready},
                                                            {DeviceCondition::clutched, DeviceState::ready},
                                                            {DeviceCondition::let_go, DeviceState::let_go},
                                                            {DeviceCondition::not_ready, DeviceState::not_ready},
                                                            {DeviceCondition::uncalibrated, DeviceState::uncalibrated},
                                                            {DeviceCondition::hot, DeviceState::hot},
                                                            {DeviceCondition::lost, DeviceState::lost}};
  for (const auto& [condition, state] : states) {
    device_.now = condition;
    tick(true);
    EXPECT_EQ(loop_->device_state(), state) << static_cast<int>(condition);
  }
  device_.has_motors = false;
  render(RenderMode::server);
  for (const DeviceCondition condition : {DeviceCondition::let_go, DeviceCondition::not_ready}) {
    device_.now = condition;
    tick(true);
    EXPECT_EQ(loop_->device_state(), DeviceState::ready) << "hand tracking that sees no hand is in order";
  }
}

TEST_F(HapticLoopTest, VisitorsAreToldThatTheForceIsLoweredUntilTheMotorsHaveCooled) {
  device_.continuous_n = kPressN / 4;
  press(RenderMode::server);
  EXPECT_EQ(loop_->device_state(), client::DeviceState::ready);
  tick_for(20s, true);
  EXPECT_EQ(loop_->device_state(), client::DeviceState::warm);
  device_.now = DeviceCondition::lost;
  tick(false);
  EXPECT_EQ(loop_->device_state(), client::DeviceState::lost);
  device_.now = DeviceCondition::ready;
  tick(false);
  EXPECT_EQ(loop_->device_state(), client::DeviceState::warm);
  tick_for(60s, false);
  EXPECT_EQ(loop_->device_state(), client::DeviceState::ready);
}

TEST_F(HapticLoopTest, AHandWhoseDeviceIsLostIsNotSent) {
  tick_for(10ms, true);
  device_.now = DeviceCondition::lost;
  const std::uint64_t sent = client_.sent_sequence();
  tick_for(10ms, false);
  EXPECT_EQ(client_.sent_sequence(), sent);
  device_.now = DeviceCondition::not_ready;
  tick_for(10ms, false);
  EXPECT_EQ(client_.sent_sequence(), sent + 10) << "it is still seen";
}

TEST_F(HapticLoopTest, TicksWithoutAForceThatIsNewEnoughAreCounted) {
  tick_for(100ms, false);  // nobody was there yet
  tick_for(100ms, true);
  tick_for(60ms, false);
  tick_for(100ms, true);
  EXPECT_EQ(loop_->stats().silent_ticks, 21u) << "from the 40th millisecond on";
}

/// Whose velocity is noise: one count of an encoder in a millisecond, to and fro.
class NoisyDevice final : public Device {
 public:
  Vec3 force_W = Vec3::Zero();
  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration) noexcept override {
    noise_ = -noise_;
    client::HandSample hand;
    hand.V_WH.v = Vec3(0, noise_ + 0.055, 0);
    return hand;
  }
  void write(const hand::HandForce& force) noexcept override { force_W = force.force_W.f; }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }

 private:
  double noise_ = 0.055;
};

TEST(HapticLoopOfANoisyDevice, TakesTheEnergyFromPlaces) {
  ScriptedClient client;
  NoisyDevice device;
  const auto loop = HapticLoop::create(client, device, RenderMode::server);
  ASSERT_TRUE(loop.has_value());
  for (int ms = 0; ms < 3000; ++ms) {
    const TimePoint now{1h + ms * kTickPeriod};
    client.next_answer(now).force_W.f = Vec3(0, kPressN, 0);
    (*loop)->tick(now, kTickPeriod);
    if (ms < 600) continue;
    ASSERT_NEAR(device.force_W.y(), kPressN, 1e-9) << "a hand at rest was given no energy, in " << ms << " ms";
  }
}

/// An arm that presses against a floor at y = 0, which the server renders.
class PressTest : public ::testing::Test {
 protected:
  static constexpr double kDepth_m = 0.008;  // of where the arm wants to be
  static constexpr double kFloor_n_per_m = 600;

  void SetUp() override {
    auto made = HapticLoop::create(client_, arm_, RenderMode::server);
    ASSERT_TRUE(made.has_value()) << made.error().to_string();
    loop_ = std::move(*made);
  }
  /// Of the force that is felt, N.
  struct Felt {
    double low = 1e9, high = 0;
    double largest_fall = 0;  ///< within a tick
    [[nodiscard]] double swing() const { return high - low; }
  };
  Felt press_for(Duration time, double y_wanted_m, bool answered = true) {
    Felt felt;
    for (Duration past{0}; past < time; past += kTickPeriod) {
      const double before_n = arm_.force_W().norm();
      now_ += kTickPeriod;
      if (answered) client_.answer_with_floor(kFloor_n_per_m, now_);
      intent_.X_WH.p.y() += std::clamp(y_wanted_m - intent_.X_WH.p.y(), -1e-4, 1e-4);
      arm_.intend(intent_);
      loop_->tick(now_, kTickPeriod);
      const double force_n = arm_.force_W().norm();
      felt.low = std::min(felt.low, force_n);
      felt.high = std::max(felt.high, force_n);
      felt.largest_fall = std::max(felt.largest_fall, before_n - force_n);
    }
    return felt;
  }
  /// Free for long enough, then pressing at rest.
  void expect_steady_press() {
    press_for(1s, 0.02);
    press_for(1s, -kDepth_m);
    const Felt felt = press_for(1s, -kDepth_m);
    EXPECT_NEAR(felt.low, 2.4, 0.01) << "arm and floor are equally stiff";
    EXPECT_LE(felt.swing(), 0.01);
  }

  ScriptedClient client_;
  VirtualDevice arm_;
  HandIntent intent_;
  std::unique_ptr<HapticLoop> loop_;
  TimePoint now_{1h};
};

TEST_F(PressTest, AContactThatResumesWithTheHandInsideDoesNotShake) {
  expect_steady_press();
  press_for(500ms, -kDepth_m, false);
  const Felt resumed = press_for(3s, -kDepth_m);
  EXPECT_LE(resumed.swing(), 0.3);
  EXPECT_LE(resumed.largest_fall, 0.1);
  expect_steady_press();
}

TEST_F(PressTest, ALoopThatStartsInsideAThingDoesNotShake) {
  intent_.X_WH.p.y() = -kDepth_m;
  const Felt felt = press_for(4s, -kDepth_m);
  EXPECT_LE(felt.swing(), 0.3);
  expect_steady_press();
}

TEST_F(PressTest, AContactMadeWhileTheForceIsRampedUpDoesNotShake) {
  intent_.X_WH.p.y() = 0.002;
  const Felt felt = press_for(4s, -kDepth_m);
  EXPECT_GT(felt.high, 0);
  EXPECT_LE(felt.largest_fall, 0.1);
  EXPECT_LE(press_for(1s, -kDepth_m).swing(), 0.01);
  expect_steady_press();
}

}  // namespace
}  // namespace mechane::haptic
