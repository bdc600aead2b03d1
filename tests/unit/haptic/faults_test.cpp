// Faults of network, server, loop and device in the middle of presses, some hundred of them: what is written to the device, with each hand
// and answer sent and with a deadband.
#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "tests/support/fault_play.hpp"

namespace mechane::haptic {
namespace {

class HapticFaults : public ::testing::TestWithParam<std::tuple<RenderMode, double>> {};

TEST_P(HapticFaults, NeverPutOutMoreThanTheDevicesLimitAndEndInZero) {
  const auto [mode, deadband] = GetParam();
  test::FaultPlay play(mode, static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()), deadband);
  const test::FaultFindings& found = play.play(100'000);
  EXPECT_GT(found.pressed, 2u) << "of " << found.faults;
  EXPECT_EQ(found.over_limit, 0u);
  EXPECT_EQ(found.over_slew, 0u);
  EXPECT_EQ(found.over_ramp, 0u);
  const double held_back_ms = deadband > 0 ? 1e3 * to_seconds(hand::kKeepAlive) : 0;  // an answer from before the fault
  EXPECT_LE(found.zero_ms_max, 41 + held_back_ms) << "the loop's 40 ms, and a tick";
  const std::uint64_t most_answers = deadband > 0 ? found.ticks / 2 : found.ticks;
  EXPECT_LT(found.answers, most_answers) << "there is something to leave out";
}

INSTANTIATE_TEST_SUITE_P(Modes, HapticFaults,
                         ::testing::Combine(::testing::Values(RenderMode::server, RenderMode::local),
                                            ::testing::Values(0.0, 0.1)));

}  // namespace
}  // namespace mechane::haptic
