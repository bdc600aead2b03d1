// How fast a device gives states, as its thread counts them.
#include "client-sdk/haptic/device_thread.hpp"

#include <gtest/gtest.h>

#include "tests/support/driver_trace.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

/// A device, its thread, and looks at its pace until one is as wanted.
class DeviceThreadTest : public ::testing::Test {
 protected:
  void start(const std::string& options) {
    device_.emplace(DriverProcessConfig{.device = parse_device_name(test::fake_device(options))});
    const auto opened = device_->open();
    ASSERT_TRUE(opened) << opened.error().to_string();
    thread_.emplace(*device_, 0, [this](TimePoint, Duration dt) { (void)device_->read(dt); });
    pace_.emplace(*thread_, clock_.now());
  }
  template <class Wanted>
  bool look_until(const Wanted& wanted) {
    for (const TimePoint end = clock_.now() + 20s; clock_.now() < end;) {
      clock_.sleep_until(clock_.now() + 100ms);  // sleeps: between two looks
      if (wanted(pace_->look(clock_.now()))) return true;
    }
    return false;
  }

  SystemClock clock_;
  std::optional<DriverProcess> device_;
  std::optional<DeviceThread> thread_;
  std::optional<DevicePace> pace_;
};

TEST_F(DeviceThreadTest, CountsStatesOfASlowDriverAndNotItsOwnTimeOuts) {
  start("after=300,fault=slow");
  ASSERT_TRUE(look_until([](const auto& pace) { return pace.rate_hz > 100; })) << "first it is fast";
  ASSERT_TRUE(look_until([](const auto& pace) { return pace.rate_hz > 0 && pace.rate_hz < 5; }));
  ASSERT_TRUE(look_until([](const auto& pace) { return pace.longest > 290ms; }));
  EXPECT_GE(device_->longest_read(), 300ms);
  thread_->stop();
  EXPECT_GE(thread_->intervals().max(), 290ms);
  EXPECT_GT(thread_->without_state(), 10u);
}

TEST_F(DeviceThreadTest, ADeviceThatIsGoneHasNoRateAndGetsLaterAndLater) {
  start("after=300,fault=unplugged");
  ASSERT_TRUE(look_until([](const auto& pace) { return pace.rate_hz > 100; }));
  ASSERT_TRUE(look_until([](const auto& pace) { return pace.rate_hz == 0; }));
  EXPECT_GT(pace_->look(clock_.now()).longest, 900ms);
  thread_->stop();
  EXPECT_GT(thread_->intervals().max(), 900ms) << "it did not come back";
}

}  // namespace
}  // namespace mechane::haptic
