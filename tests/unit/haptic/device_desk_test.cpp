// What staff ask of a device while its loop runs, with the fake driver in a process of its own.
#include "client-sdk/haptic/device_desk.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "tests/support/driver_trace.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;
using client::DeviceAction;

/// A stylus that goes down once sink() is called, in a loop whose server answers nothing.
class DeviceDeskTest : public ::testing::Test {
 protected:
  void SetUp() override {
    loop_ = std::move(*HapticLoop::create(client_, device_, RenderMode::local));
    turns_.emplace(*loop_, nullptr);
    thread_ = std::make_unique<DeviceThread>(
        device_, 0, [this](TimePoint now, Duration dt) { turns_->turn(now, dt, device_.state().temperature); });
    desk_.emplace(client_, device_, *loop_, *turns_, *thread_, told_, now());
  }
  void TearDown() override { thread_->stop(); }
  static TimePoint now() { return std::chrono::steady_clock::now(); }

  /// Looks until the condition holds. False: not within some seconds.
  bool looks_until(const std::function<bool()>& holds) {
    SystemClock clock;
    for (const TimePoint end = now() + 20s; now() < end;) {
      desk_->look(now());
      if (holds()) return true;
      clock.sleep_until(now() + 20ms);  // sleeps: the pace of the looks
    }
    return false;
  }
  void ask(DeviceAction action, const client::DevicePlace& place = {}) {
    client_.requests.push_back({++asked_, 0, action, place});
    desk_->look(now());
    EXPECT_EQ(client_.details.answered, asked_);
  }

  void sink() { std::ofstream(sinks_) << "now"; }
  bool is_there() {
    return looks_until([&] { return device_.condition() == DeviceCondition::ready && client_.details.rate_hz > 0; });
  }

  test::ScratchFolder folder_;
  std::filesystem::path sinks_ = folder_.path() / "sinks";
  test::ScriptedClient client_;
  DriverProcess device_{{.device = parse_device_name(test::fake_device("sinks=" + sinks_.string()))}};
  client::DeviceDetails told_;
  std::unique_ptr<HapticLoop> loop_;
  std::optional<LoopTurns> turns_;
  std::unique_ptr<DeviceThread> thread_;
  std::optional<DeviceDesk> desk_;
  std::uint64_t asked_ = 0;
};

TEST_F(DeviceDeskTest, TellsWhatTheDeviceIsAndHowItFares) {
  sink();
  ASSERT_TRUE(looks_until([&] { return client_.details.rate_hz > 100 && client_.details.p_WH.y() < -0.001; }));
  EXPECT_EQ(client_.details.limits.peak_force_n, 2);
  EXPECT_EQ(client_.details.limits.continuous_force_n, 1);
  EXPECT_GT(client_.details.limits.wanted_hz, 0);
  EXPECT_EQ(client_.details.answered, 0U);
}

TEST_F(DeviceDeskTest, PutsTheWorkspaceElsewhere) {
  ASSERT_TRUE(is_there());
  ask(DeviceAction::place, {.p_WD = Vec3(1, 2, 3)});
  EXPECT_EQ(client_.details.refusal, "");
  EXPECT_EQ(told_.place.p_WD, Vec3(1, 2, 3)) << "it stays so where the device is opened anew";
  EXPECT_TRUE(looks_until([&] { return client_.hand.X_WH.p.y() > 1.5; })) << "the world hears of it";
}

TEST_F(DeviceDeskTest, TestsTheDeviceForAWhileAndGoesOn) {
  ASSERT_TRUE(is_there());
  ask(DeviceAction::test);
  EXPECT_TRUE(client_.details.testing);
  ask(DeviceAction::place, {.p_WD = Vec3(1, 2, 3)});
  EXPECT_NE(client_.details.refusal.find("tested"), std::string::npos) << client_.details.refusal;
  const std::uint64_t sent = client_.sent_sequence();
  sink();
  ASSERT_TRUE(looks_until([&] { return client_.details.test_force_n > 0.01; })) << "it goes down into the floor";
  EXPECT_LE(client_.details.test_force_n, 1);
  EXPECT_EQ(client_.sent_sequence(), sent) << "the world's hand rests meanwhile";
  ask(DeviceAction::end_test);
  EXPECT_FALSE(client_.details.testing);
  EXPECT_TRUE(looks_until([&] { return client_.sent_sequence() > sent; }));
}

TEST_F(DeviceDeskTest, FitsOnlyAGlove) {
  ask(DeviceAction::calibrate);
  EXPECT_FALSE(desk_->fits());
  EXPECT_NE(client_.details.refusal.find("glove"), std::string::npos) << client_.details.refusal;
}

}  // namespace
}  // namespace mechane::haptic
