// A hand that presses a wall with a deadband both ways: what it feels, what is left out, and that its force is never lowered for it.
#include <algorithm>

#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

class DeadbandTest : public ::testing::TestWithParam<RenderMode> {
 protected:
  static constexpr double kShare = 0.1;
  static constexpr double kFloor_n_per_m = 600;

  void SetUp() override { loop_ = HapticLoop::create(client_, stylus_, GetParam(), kShare).value(); }

  struct Felt {
    double low_n = 1e9, high_n = 0;
    int stale_ticks = 0;
  };
  /// The hand goes to `y_m` and stays there. A server answers, and each fifth of its answers is lost.
  Felt press(double y_m, Duration time) {
    Felt felt;
    for (Duration past{0}; past < time; past += kTickPeriod) {
      now_ += kTickPeriod;
      answer();
      y_m_ += std::clamp(y_m - y_m_, -1e-4, 1e-4);
      HandIntent intent;
      intent.X_WH.p.y() = y_m_;
      stylus_.intend(intent);
      loop_->tick(now_, kTickPeriod);
      const double force_n = loop_->rendered().force_W.f.norm();
      felt.low_n = std::min(felt.low_n, force_n);
      felt.high_n = std::max(felt.high_n, force_n);
      felt.stale_ticks += (loop_->rendered().reasons & hand::kStale) != 0;
    }
    return felt;
  }

  test::ScriptedClient client_;
  SimulatedStylus stylus_{{.hand = ArmConfig{}}, Vec3(0, 0.02, 0)};
  std::unique_ptr<HapticLoop> loop_;
  std::uint64_t answers_ = 0;
  TimePoint now_{1h};

 private:
  void answer() {
    client_.answer_with_floor(kFloor_n_per_m, now_);
    if (!deadband_.is_due(kShare, *client_.arrived, client_.hand.X_WH.p, now_)) return client_.arrived.reset();
    deadband_.note_sent(*client_.arrived, client_.hand.X_WH.p, now_);
    if (++answers_ % 5 == 0) client_.arrived.reset();
  }

  hand::OutputDeadband deadband_;
  double y_m_ = 0.02;
};

TEST_P(DeadbandTest, APressIsSteadyAndMostMessagesAreLeftOut) {
  press(0.02, 1s);
  const Felt down = press(-0.008, 1s);
  const Felt steady = press(-0.008, 2s);
  press(0.02, 1s);
  EXPECT_GT(steady.low_n, 2.2) << "hand and wall are equally stiff: 2.4 N";
  EXPECT_LT(steady.high_n - steady.low_n, kShare * 2.4);
  EXPECT_LT(down.high_n, 2.7);
  EXPECT_EQ(down.stale_ticks + steady.stale_ticks, 0) << "one lost message lowers no force";
  const std::uint64_t ticks = loop_->stats().ticks;
  EXPECT_LT(loop_->stats().sent, ticks / 2);
  EXPECT_LT(answers_, ticks / 2);
}

/// A deadband holds back for 4 ms at most: what an answer waited beyond that is delay.
TEST_P(DeadbandTest, TheDelayOfALateServerCounts) {
  loop_->tick(now_, kTickPeriod);
  const std::uint64_t answered = client_.sent_sequence();
  for (int i = 0; i < 20; ++i)
    loop_->tick(now_ += kTickPeriod, kTickPeriod);
  client::ForceSample& answer = client_.next_answer(now_);
  answer.echo_sequence = answered;
  answer.waited = 20ms;
  loop_->tick(now_, kTickPeriod);
  EXPECT_GT(loop_->round_trip().max(), 15ms);
}

INSTANTIATE_TEST_SUITE_P(Modes, DeadbandTest, ::testing::Values(RenderMode::server, RenderMode::local));

}  // namespace
}  // namespace mechane::haptic
