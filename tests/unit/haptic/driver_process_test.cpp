// A device behind a driver in a process of its own: each test starts that process.
#include "client-sdk/haptic/driver_process.hpp"

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/driver_trace.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;
using test::DriverTrace;

class DriverProcessTest : public ::testing::Test {
 protected:
  DriverProcess& open(const std::string& options) {
    device_.emplace(
        DriverProcessConfig{.device = parse_device_name(test::fake_device("trace=" + file_.string() + "," + options)),
                            .workspace = {.place = {.p_WD = Vec3(1, 2, 3), .scale = 2}, .clutch_button = 2},
                            .hand_scale = 1.1});
    const auto opened = device_->open();
    EXPECT_TRUE(opened) << (opened ? "" : opened.error().to_string());
    return *device_;
  }
  /// One tick of a loop that presses with this force.
  client::HandSample tick(double force_n) {
    (void)device_->wait(5ms);
    const client::HandSample hand = device_->read(kTickPeriod);
    hand::HandForce force;
    force.force_W.f.y() = force_n;
    device_->write(force);
    return hand;
  }
  /// Ticks until the condition holds. False: not within some seconds.
  bool tick_until(double force_n, const std::function<bool()>& holds) {
    for (const TimePoint end = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < end;) {
      tick(force_n);
      if (holds()) return true;
    }
    return false;
  }
  DriverTrace trace() const { return DriverTrace::read(file_); }
  bool pressed() const { return trace().largest_n() > 0; }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "trace";
  std::optional<DriverProcess> device_;
};

TEST_F(DriverProcessTest, GivesTheHandAndTakesTheForce) {
  DriverProcess& device = open("");
  EXPECT_EQ(device.limits().max_force_n, 2);
  EXPECT_EQ(device.continuous_force_n(), 1);
  client::HandSample hand;
  ASSERT_TRUE(tick_until(0.5, [&] { return (hand = tick(0.5)).X_WH.p.y() < 1.995; }));
  EXPECT_EQ(device.condition(), DeviceCondition::ready);
  EXPECT_EQ(hand.X_WH.p.x(), 1);
  EXPECT_LT(hand.V_WH.v.y(), 0) << "it moves down";
  ASSERT_TRUE(tick_until(0.5, [&] { return trace().largest_n() == 0.25; })) << "half the force for twice the way";
}

TEST_F(DriverProcessTest, WithTheClutchDownTheHandStaysAndNothingIsRendered) {
  DriverProcess& device = open("fault=clutch,after=750");
  ASSERT_TRUE(tick_until(0, [&] { return device.condition() == DeviceCondition::clutched; }));
  const Vec3 held = tick(0).X_WH.p;
  ASSERT_TRUE(tick_until(0, [&] { return device.state().position_m[1] < -0.015; })) << "the device is moved on";
  EXPECT_EQ(tick(0).X_WH.p, held);
}

TEST_F(DriverProcessTest, IsPutElsewhereAndItsHandDoesNotRushThere) {
  DriverProcess& device = open("");
  ASSERT_TRUE(tick_until(0, [&] { return device.condition() == DeviceCondition::ready; }));
  device.put({.p_WD = Vec3(-1, 0, 0), .turn_rad = kPi / 2, .scale = 1});
  client::HandSample hand;
  double fastest_m_s = 0;
  ASSERT_TRUE(tick_until(0, [&] {
    hand = tick(0);
    fastest_m_s = std::max(fastest_m_s, hand.V_WH.v.norm());
    return hand.X_WH.p.x() < 0;
  }));
  EXPECT_NEAR(hand.X_WH.p.x(), -1, 1e-9);
  EXPECT_LT(std::abs(hand.X_WH.p.y()), 0.05) << "where the device itself is";
  EXPECT_LT(fastest_m_s, 1) << "it was put there, and has not moved";
}

TEST_F(DriverProcessTest, TellsWhichHandItIsAndItsSize) {
  const auto is_heard = [&](client::HandSide side, double scale) {
    return tick_until(0, [&] {
      const client::HandSample hand = tick(0);
      return hand.side == side && std::abs(hand.hand_scale - scale) < 1e-9;
    });
  };
  open("side=left");
  EXPECT_TRUE(is_heard(client::HandSide::left, 1.1)) << "nobody has measured it but staff";
  open("palm=0.0756");
  EXPECT_TRUE(is_heard(client::HandSide::right, 0.8));
}

TEST_F(DriverProcessTest, ALoopOnItAllocatesNothing) {
  DriverProcess device({.device = parse_device_name(test::fake_device(""))});
  test::ScriptedClient client;
  auto loop = HapticLoop::create(client, device, RenderMode::local);
  ASSERT_TRUE(loop) << loop.error().to_string();
  for (int i = 0; i < 3; ++i) {
    const test::AllocationGuard guard;
    for (int tick = 0; tick < 500; ++tick) {
      (void)device.wait(5ms);
      const TimePoint now = std::chrono::steady_clock::now();
      client.answer_with_floor(600, now);
      (*loop)->tick(now, kTickPeriod);
    }
    EXPECT_EQ(guard.allocations() + guard.frees(), 0u);
  }
  EXPECT_GT((*loop)->stats().ticks_with_force, 100u);
}

TEST_F(DriverProcessTest, AtItsEndTheDeviceIsGivenZeroAndClosed) {
  open("");
  ASSERT_TRUE(tick_until(1, [&] { return pressed(); }));
  device_.reset();
  EXPECT_EQ(trace().forces.back().force_n, 0);
  EXPECT_EQ(trace().closed, 1);
}

TEST_F(DriverProcessTest, ALoopThatNoLongerTurnsIsFollowedByZero) {
  open("");
  ASSERT_TRUE(tick_until(1, [&] { return pressed(); }));
  const TimePoint last = std::chrono::steady_clock::now();
  while (trace().forces.back().force_n != 0 && std::chrono::steady_clock::now() < last + 20s) {
  }
  const DriverTrace written = trace();
  std::size_t zero = written.forces.size() - 1;
  while (written.forces[zero - 1].force_n == 0)
    --zero;
  // The last force that is not zero was written before it was too old; the time after it is the machine's.
  EXPECT_LE(written.forces[zero - 1].at_ns, static_cast<std::int64_t>(to_ns(last + DriverLink::kSilent)) + 1'000'000);
  ASSERT_TRUE(tick_until(1, [&] { return trace().forces.back().force_n > 0; })) << "it is heard again";
}

TEST_F(DriverProcessTest, ADeviceThatIsNotReadyRendersNothingAndTellsWhy) {
  const std::pair<const char*, DeviceCondition> faults[] = {{"let_go", DeviceCondition::let_go},
                                                            {"not_ready", DeviceCondition::not_ready},
                                                            {"uncalibrated", DeviceCondition::uncalibrated},
                                                            {"hot", DeviceCondition::hot}};
  for (const auto& [fault, condition] : faults) {
    open(std::string("after=1,fault=") + fault);
    ASSERT_TRUE(tick_until(1, [&] { return trace().forces.size() > 50; }));
    EXPECT_EQ(device_->condition(), condition) << fault;
    device_.reset();
    EXPECT_LE(std::ranges::count_if(trace().forces, [](const auto& w) { return w.force_n > 0; }), 1) << fault;
    std::filesystem::remove(file_);
  }
}

TEST_F(DriverProcessTest, AConditionThatLastsIsToldOnce) {
  open("after=1,fault=hot");
  std::vector<std::string> told;
  const auto hear = [&] {
    const auto news = device_->check();
    EXPECT_TRUE(news);
    if (news && *news) told.push_back(**news);
  };
  ASSERT_TRUE(tick_until(0, [&] { return hear(), !told.empty(); }));
  const TimePoint end = std::chrono::steady_clock::now() + 1200ms;
  ASSERT_TRUE(tick_until(0, [&] { return hear(), std::chrono::steady_clock::now() > end; }));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("too warm"), std::string::npos) << told[0];
}

TEST_F(DriverProcessTest, ADeviceThatFailsIsClosedAndOpenedAgain) {
  open("after=100,fault=gone");
  std::vector<std::string> told;
  ASSERT_TRUE(tick_until(1, [&] {
    const auto news = device_->check();
    EXPECT_TRUE(news);
    if (news && *news) told.push_back(**news);
    return told.size() == 2;
  }));
  EXPECT_NE(told[0].find("cable was pulled"), std::string::npos);
  EXPECT_EQ(trace().closed, 1);
  ASSERT_TRUE(tick_until(1, [&] { return device_->condition() == DeviceCondition::ready; }));
}

TEST_F(DriverProcessTest, AnotherDeviceInItsPlaceIsAnError) {
  open("after=10,fault=other");
  Expected<std::optional<std::string>> news = std::optional<std::string>();
  ASSERT_TRUE(tick_until(0, [&] { return !(news = device_->check()); }));
  EXPECT_EQ(news.error().code, ErrorCode::conflict);
}

TEST_F(DriverProcessTest, ADriverThatCrashesIsAnErrorAndTheDeviceIsLost) {
  open("after=100,fault=crash");
  Expected<std::optional<std::string>> news = std::optional<std::string>();
  ASSERT_TRUE(tick_until(1, [&] { return !(news = device_->check()); }));
  EXPECT_EQ(news.error().code, ErrorCode::failed_process);
  ASSERT_TRUE(tick_until(1, [&] { return device_->condition() == DeviceCondition::lost; }));
}

TEST_F(DriverProcessTest, ADriverThatEndsIsAnErrorWithItsStatus) {
  open("after=100,fault=exit");
  Expected<std::optional<std::string>> news = std::optional<std::string>();
  ASSERT_TRUE(tick_until(1, [&] { return !(news = device_->check()); }));
  EXPECT_EQ(news.error().what, "the driver's process ended with status 3");
}

TEST_F(DriverProcessTest, ADriverThatHangsIsAnErrorAndIsEnded) {
  open("after=10,fault=hang");
  Expected<std::optional<std::string>> news = std::optional<std::string>();
  ASSERT_TRUE(tick_until(0, [&] { return !(news = device_->check()); }));
  EXPECT_EQ(news.error().code, ErrorCode::timed_out);
}

TEST_F(DriverProcessTest, ADeviceThatDoesNotOpenSaysWhy) {
  DriverProcess absent({.device = parse_device_name(test::fake_device("fault=absent"))});
  const auto opened = absent.open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().what.find("plug it in"), std::string::npos);
  DriverProcess unknown({.device = {.driver = "nobody-has-this", .options = ""}});
  EXPECT_FALSE(unknown.open());
}

}  // namespace
}  // namespace mechane::haptic
