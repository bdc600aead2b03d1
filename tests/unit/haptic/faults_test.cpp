// Faults of network, server, loop and device in the middle of presses, some hundred of them: what is written to the device.
#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "tests/support/fault_play.hpp"

namespace mechane::haptic {
namespace {

class HapticFaults : public ::testing::TestWithParam<RenderMode> {};

TEST_P(HapticFaults, NeverPutOutMoreThanTheDevicesLimitAndEndInZero) {
  test::FaultPlay play(GetParam(), static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  const test::FaultFindings& found = play.play(100'000);
  EXPECT_GT(found.pressed, 2u) << "of " << found.faults;
  EXPECT_EQ(found.over_limit, 0u);
  EXPECT_EQ(found.over_slew, 0u);
  EXPECT_EQ(found.over_ramp, 0u);
  EXPECT_LE(found.zero_ms_max, 41) << "the loop's 40 ms, and a tick";
}

INSTANTIATE_TEST_SUITE_P(Modes, HapticFaults, ::testing::Values(RenderMode::server, RenderMode::local));

}  // namespace
}  // namespace mechane::haptic
