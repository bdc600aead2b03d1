// The client's haptic loop against a server of the test's own: what the device renders when answers stop and come back.
#include "client-sdk/haptic/haptic_loop.hpp"

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

constexpr Duration kTick = 1ms;
constexpr double kPressN = 2;

/// A joined client whose server's answers are put in by the test.
class ScriptedClient final : public client::Client {
 public:
  std::optional<client::ForceSample> arrived;

  [[nodiscard]] client::LinkState state() const override { return client::LinkState::joined; }
  [[nodiscard]] bool wait_for(client::LinkState wanted, Duration) override { return wanted == state(); }
  [[nodiscard]] std::string refusal() const override { return {}; }
  [[nodiscard]] std::uint64_t session() const override { return 1; }
  bool send(const client::HandSample&) noexcept override { return ++sent_ > 0; }
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept override { return sent_; }
  [[nodiscard]] std::optional<client::ForceSample> newest_force() noexcept override {
    return std::exchange(arrived, std::nullopt);
  }
  [[nodiscard]] std::optional<client::ForceSample> wait_force(Duration) override { return newest_force(); }
  [[nodiscard]] bool newest_frame(client::Frame&) override { return false; }
  [[nodiscard]] bool interpolated_frame(TimePoint, Duration, client::Frame&) override { return false; }
  [[nodiscard]] std::vector<client::SceneObject> objects() const override { return {}; }
  [[nodiscard]] std::optional<client::WorldStatus> world_status() const override { return {}; }
  [[nodiscard]] std::shared_ptr<const client::WorldPresentation> presentation() const override { return {}; }
  [[nodiscard]] std::optional<client::ServerStatus> server_status() const override { return {}; }
  [[nodiscard]] std::vector<client::WorldEvent> take_events() override { return {}; }
  std::uint64_t start_activity(const std::string&) override { return 0; }
  std::uint64_t restart_activity() override { return 0; }
  std::uint64_t next_step() override { return 0; }
  std::uint64_t click(const std::string&) override { return 0; }
  std::uint64_t open_exhibit(const std::string&) override { return 0; }
  std::uint64_t answer(const client::VisitAnswer&) override { return 0; }
  std::uint64_t tell_language(const std::string&) override { return 0; }

 private:
  std::uint64_t sent_ = 0;
};

/// A device that stands still and bears any force asked for here.
class StillDevice final : public Device {
 public:
  Vec3 force_W = Vec3::Zero();

  [[nodiscard]] Expected<void> open() override { return {}; }
  [[nodiscard]] client::HandSample read(Duration) noexcept override { return {}; }
  void write(const hand::HandForce& force) noexcept override { force_W = force.force_W.f; }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }
};

class HapticLoopTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto made = HapticLoop::create(client_, device_, RenderMode::server);
    ASSERT_TRUE(made.has_value()) << made.error().to_string();
    loop_ = std::move(*made);
  }
  /// The next tick, `dt` after the last one; the server answers it with kPressN, or not at all. Returns the rendered
  /// force, N.
  double tick(bool answered, Duration dt = kTick) {
    now_ += dt;
    if (answered) {
      client_.arrived = client::ForceSample{};
      client_.arrived->sequence = ++sequence_;
      client_.arrived->received = now_;
      client_.arrived->force_W.f = Vec3(0, kPressN, 0);
    }
    loop_->tick(now_, dt);
    return device_.force_W.norm();
  }
  double tick_for(Duration time, bool answered) {
    double force_n = 0;
    for (Duration past{0}; past < time; past += kTick)
      force_n = tick(answered);
    return force_n;
  }
  /// From zero, by no more than the ramp of a visit's start allows, to all of it.
  void expect_ramp() {
    const double ramp_s = device_.limits().ramp_up_s;
    for (double t_s = 0; t_s < ramp_s; t_s += to_seconds(kTick))
      ASSERT_LE(tick(true), kPressN * (t_s + 4 * to_seconds(kTick)) / ramp_s) << t_s << " s after the first answer";
    EXPECT_NEAR(tick_for(20ms, true), kPressN, 1e-9);
  }

  ScriptedClient client_;
  StillDevice device_;
  std::unique_ptr<HapticLoop> loop_;
  TimePoint now_{1h};
  std::uint64_t sequence_ = 0;
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

TEST_F(HapticLoopTest, AnAnswerThatIsMissedNowAndThenIsNoSilence) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  for (int i = 0; i < 100; ++i) {
    ASSERT_NEAR(tick_for(5ms, false), kPressN, 1e-9);
    ASSERT_NEAR(tick(true), kPressN, 1e-9);
  }
}

TEST_F(HapticLoopTest, ALoopThatStoodStillBeginsFromZeroThoughAnAnswerIsThereAtOnce) {
  ASSERT_NEAR(tick_for(1s, true), kPressN, 1e-9);
  EXPECT_LE(tick(true, 4s), 0.01 * kPressN)
      << "a stopped process goes on, and finds an answer from before in its socket";
  expect_ramp();
}

TEST_F(HapticLoopTest, TicksWithoutAForceThatIsNewEnoughAreCounted) {
  tick_for(100ms, false);  // nobody was there yet
  tick_for(100ms, true);
  tick_for(60ms, false);
  tick_for(100ms, true);
  EXPECT_EQ(loop_->stats().silent_ticks, 11u) << "from the 50th millisecond on";
}

}  // namespace
}  // namespace mechane::haptic
