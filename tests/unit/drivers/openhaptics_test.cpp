// The driver of OpenHaptics against a stub of the vendor's library (tests/support/fake_hd.cpp), and its conversions.
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "client-sdk/drivers/openhaptics/mailbox.hpp"
#include "client-sdk/drivers/openhaptics/servo.hpp"
#include "client-sdk/drivers/vectors.hpp"
#include "tests/support/driver_on_fake.hpp"

namespace mechane::test {
namespace {

constexpr double kHdNan = std::numeric_limits<double>::quiet_NaN();

class OpenHapticsDriver : public DriverOnFake {
 protected:
  OpenHapticsDriver() : DriverOnFake("openhaptics", "hd") {
    find(turn_, "fake_hd_turn");
    find(run_, "fake_hd_run");
  }
  void TearDown() override {
    if (get_ == nullptr) return;
    close();
    reset_();
  }

  /// One tick by hand, and what the driver says of it.
  std::string tick() {
    turn_(1);
    return read();
  }
  /// A force, and the tick that renders it. On a busy machine the force can be too old by then: then again.
  std::string render(const mechane_device_force& force) {
    for (;;) {
      const auto asked = std::chrono::steady_clock::now();
      std::string fault = driver_.write(force);
      fault += tick();
      if (!fault.empty() || std::chrono::steady_clock::now() - asked < std::chrono::milliseconds(15)) return fault;
    }
  }
  std::string render(double x, double y, double z) { return render(force_of(x, y, z)); }
  void close() {
    if (get_("running") != 0 && !thread_runs_) run();  // the driver waits for a last tick
    driver_.close();
  }
  void run() {
    thread_runs_ = true;
    run_();
  }
  [[nodiscard]] bool hot() const { return (state_.flags & MECHANE_STATE_HOT) != 0; }

  void (*turn_)(int) = nullptr;
  void (*run_)() = nullptr;

 private:
  bool thread_runs_ = false;
};

TEST_F(OpenHapticsDriver, DescribesTheArmInSiUnits) {
  ASSERT_EQ(open(), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_STREQ(info.name, "Fake Arm");
  EXPECT_EQ(info.hand, MECHANE_HAND_POINT);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FORCE);
  EXPECT_EQ(info.paces, 1u);
  EXPECT_DOUBLE_EQ(info.rate_hz, 1000);
  EXPECT_DOUBLE_EQ(info.peak_force_n, 3.3);
  EXPECT_DOUBLE_EQ(info.continuous_force_n, 0.88);
  EXPECT_DOUBLE_EQ(info.peak_torque_nm, 0);
  EXPECT_DOUBLE_EQ(info.max_stiffness_n_per_m, 500);
  EXPECT_DOUBLE_EQ(info.max_damping_ns_per_m, 4);
  EXPECT_DOUBLE_EQ(info.workspace_min_m[0], -0.08);
  EXPECT_DOUBLE_EQ(info.workspace_max_m[1], 0.06);
  EXPECT_DOUBLE_EQ(info.workspace_max_m[2], 0.035);
  EXPECT_EQ(get_("enabled"), 1);
  EXPECT_EQ(get_("priority"), 65535);
}

TEST_F(OpenHapticsDriver, AnArmThatDoesNotKnowItsLimitsIsTakenForTheWeakest) {
  set_("max_force", kHdNan);
  set_("continuous_force", -1);
  set_("stiffness", 1e9);
  ASSERT_EQ(open(), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_DOUBLE_EQ(info.peak_force_n, 3.3);
  EXPECT_DOUBLE_EQ(info.continuous_force_n, 0.88);
  EXPECT_DOUBLE_EQ(info.max_stiffness_n_per_m, 0);
}

TEST_F(OpenHapticsDriver, ReadsMetresFromTheMiddleOfTheWorkspace) {
  set_("centre_y", 20);
  ASSERT_EQ(open(), "");
  set_("x", 100);
  set_("y", 50);
  set_("z", -20);
  set_("turn_about_y", 0.5);
  set_("buttons", 2);
  set_("temperature", 0.4);
  ASSERT_EQ(tick(), "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.1);
  EXPECT_DOUBLE_EQ(state_.position_m[1], 0.03);
  EXPECT_DOUBLE_EQ(state_.position_m[2], -0.02);
  EXPECT_NEAR(state_.orientation_wxyz[0], std::cos(0.25), 1e-12);
  EXPECT_NEAR(state_.orientation_wxyz[1], 0, 1e-12);
  EXPECT_NEAR(state_.orientation_wxyz[2], std::sin(0.25), 1e-12);
  EXPECT_NEAR(state_.orientation_wxyz[3], 0, 1e-12);
  EXPECT_EQ(state_.buttons, 2u);
  EXPECT_DOUBLE_EQ(state_.temperature, 0.4);
  EXPECT_TRUE(ready());
  EXPECT_FALSE(hot());
}

TEST_F(OpenHapticsDriver, AnArmWithoutGimbalOrThermometerSaysSo) {
  set_("input_dof", 3);
  set_("turn_about_y", 0.5);
  set_("no_temperature", 1);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  EXPECT_DOUBLE_EQ(state_.orientation_wxyz[0], 1);
  EXPECT_DOUBLE_EQ(state_.orientation_wxyz[2], 0);
  EXPECT_LT(state_.temperature, 0);
  EXPECT_EQ(get_("misuse"), 0);
}

TEST_F(OpenHapticsDriver, RendersTheNewestForceWithinTheArmsRange) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  EXPECT_EQ(get_("fx"), 0);
  ASSERT_EQ(push(9, 9, 9), "");
  ASSERT_EQ(render(1, -2, 0.5), "");
  EXPECT_DOUBLE_EQ(get_("fx"), 1);
  EXPECT_DOUBLE_EQ(get_("fy"), -2);
  EXPECT_DOUBLE_EQ(get_("fz"), 0.5);
  ASSERT_EQ(render(30, 0, -40), "");
  EXPECT_NEAR(get_("fx"), 3.3 * 0.6, 1e-12);
  EXPECT_NEAR(get_("fz"), -3.3 * 0.8, 1e-12);
  ASSERT_EQ(render(1, kHdNan, 1), "");
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("fy"), 0);
  EXPECT_EQ(get_("misuse"), 0);
}

TEST_F(OpenHapticsDriver, SendsTorqueInMillinewtonMetresToAnArmThatTakesIt) {
  set_("output_dof", 6);
  ASSERT_EQ(open(), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_DOUBLE_EQ(info.peak_torque_nm, 0.188);
  ASSERT_EQ(tick(), "");
  mechane_device_force force{};
  force.torque_nm[1] = 0.05;
  ASSERT_EQ(render(force), "");
  EXPECT_DOUBLE_EQ(get_("ty"), 50);
  force.torque_nm[1] = -7;
  ASSERT_EQ(render(force), "");
  EXPECT_DOUBLE_EQ(get_("ty"), -188);
}

TEST_F(OpenHapticsDriver, AForceThatIsNotRenewedEnds) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  const auto asked = std::chrono::steady_clock::now();
  ASSERT_EQ(push(1, 0, 0), "");
  turn_(1);
  const double first = get_("fx");
  auto ended = asked;
  while (get_("fx") != 0 && ended - asked < std::chrono::seconds(1)) {
    turn_(1);
    ended = std::chrono::steady_clock::now();
  }
  // A busy machine may have needed more than those 20 ms for the first tick.
  EXPECT_TRUE(first == 0 || ended - asked >= std::chrono::milliseconds(20));
  EXPECT_EQ(get_("fx"), 0);
}

TEST_F(OpenHapticsDriver, ReadWaitsForTheNextTick) {
  ASSERT_EQ(open(), "");
  run();
  double before = get_("ticks");
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(driver_.read(state_), "");
    ASSERT_EQ(push(0.1, 0, 0), "");
  }
  EXPECT_GE(get_("ticks") - before, 19);  // one may have lain ready
}

TEST_F(OpenHapticsDriver, ASchedulerThatDoesNotCallIsAFault) {
  ASSERT_EQ(open(), "");
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(driver_.read(state_), "");
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
}

TEST_F(OpenHapticsDriver, ClosesWithoutForceInTheVendorsOrder) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  ASSERT_EQ(push(2, 0, 0), "");
  run();
  for (const double before = get_("ticks"); get_("ticks") == before;)
    std::this_thread::yield();
  close();
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("unscheduled"), 0);  // the callback had ended by itself, after a tick without force
  EXPECT_EQ(get_("running"), 0);
  EXPECT_EQ(get_("open"), 0);
  EXPECT_EQ(get_("misuse"), 0);
}

TEST_F(OpenHapticsDriver, ClosesAnArmThatNoLongerTicks) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  driver_.close();  // nobody turns the scheduler
  EXPECT_EQ(get_("unscheduled"), 1);
  EXPECT_EQ(get_("open"), 0);
  EXPECT_EQ(get_("running"), 0);
}

TEST_F(OpenHapticsDriver, OpensAgainAfterClosing) {
  for (int session = 0; session < 2; ++session) {
    ASSERT_EQ(open(), "");
    ASSERT_EQ(tick(), "");
    EXPECT_EQ(get_("open"), 1);
    driver_.close();
  }
}

TEST_F(OpenHapticsDriver, ReportsTheCauseOfALossAndTicksNoMore) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  set_("cause", 0x302);
  set_("internal", -28);
  set_("error", 0x402);
  const std::string fault = tick();
  EXPECT_NE(fault.find("0x302"), std::string::npos) << fault;
  EXPECT_NE(fault.find("-28"), std::string::npos) << fault;
  EXPECT_NE(fault.find("Fake communication error"), std::string::npos) << fault;
  const double ticks = get_("ticks");
  turn_(3);
  EXPECT_EQ(get_("ticks"), ticks);
}

TEST_F(OpenHapticsDriver, EveryErrorThatTheLibraryDoesNotHealByItselfIsALoss) {
  for (const unsigned code : {0x100u, 0x104u, 0x204u, 0x300u, 0x304u, 0x402u, 0x600u, 0x7777u}) {
    ASSERT_EQ(open(), "");
    set_("error", code);
    EXPECT_NE(tick(), "") << code;
    driver_.close();
  }
  ASSERT_EQ(open(), "");
  for (const unsigned code : {0x201u, 0x202u, 0x203u}) {
    set_("error", code);
    EXPECT_EQ(tick(), "") << code;
    EXPECT_TRUE(ready());
    EXPECT_FALSE(hot());
  }
}

TEST_F(OpenHapticsDriver, WarmMotorsAreHotAndGetNoForce) {
  ASSERT_EQ(open(), "");
  set_("temperature", 0.69);
  ASSERT_EQ(tick(), "");
  EXPECT_FALSE(hot());
  set_("temperature", 0.71);
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(hot());
  set_("temperature", 0.51);
  ASSERT_EQ(render(1, 0, 0), "");
  EXPECT_TRUE(hot());
  EXPECT_EQ(get_("fx"), 0);
  set_("temperature", 0.49);
  ASSERT_EQ(tick(), "");
  EXPECT_FALSE(hot());
  set_("error", 0x200);
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(hot());
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(hot());  // the warning holds for a while, whatever the temperature
}

TEST_F(OpenHapticsDriver, IsReadyOnlyWhenItIsCalibrated) {
  set_("calibration", 0x5002);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_UNCALIBRATED);
  ASSERT_EQ(render(1, 0, 0), "");
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("updates"), 0);  // a person has to move the stylus first
  set_("calibration", 0x5001);    // it has been put into the inkwell
  turn_(250);
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(ready());
  EXPECT_EQ(get_("updates"), 1);
  EXPECT_EQ(get_("update_style"), 4);
}

TEST_F(OpenHapticsDriver, ARefusedCalibrationIsTriedAgain) {
  set_("calibration", 0x5001);
  set_("update_helps", 0);
  ASSERT_EQ(open(), "");
  turn_(500);
  ASSERT_EQ(tick(), "");
  EXPECT_FALSE(ready());
  EXPECT_EQ(get_("updates"), 3);
}

TEST_F(OpenHapticsDriver, CalibratesNeverWhileItPushes) {
  set_("style", 2 | 4);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  set_("calibration", 0x5001);
  for (int i = 0; i < 600; ++i) {
    ASSERT_EQ(push(1, 0, 0), "");
    ASSERT_EQ(tick(), "");
    ASSERT_TRUE(ready());  // as it was calibrated before
  }
  ASSERT_EQ(push(0, 0, 0), "");
  for (int i = 0; i < 251; ++i)
    ASSERT_EQ(tick(), "");
  EXPECT_EQ(get_("updates_in_force"), 0);
  EXPECT_GE(get_("updates"), 1);
  EXPECT_EQ(get_("update_style"), 2);
}

TEST_F(OpenHapticsDriver, NeverResetsEncodersByItself) {
  set_("style", 1);
  set_("calibration", 0x5001);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  EXPECT_FALSE(ready());
  EXPECT_EQ(get_("updates"), 0);
}

TEST_F(OpenHapticsDriver, IsNotReadyInTheInkwellUnlessItsSwitchIsStuck) {
  set_("undocked", 0);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(ready());  // the model may have no such switch
  set_("undocked", 1);
  ASSERT_EQ(tick(), "");
  EXPECT_TRUE(ready());
  set_("undocked", 0);
  ASSERT_EQ(tick(), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_DEAD_MAN);
}

TEST_F(OpenHapticsDriver, SkipsImpossiblePositionsAndGivesUpWhenTheyGoOn) {
  ASSERT_EQ(open(), "");
  set_("x", kHdNan);
  run();
  std::thread heals([this] {
    for (const double seen = get_("ticks"); get_("ticks") < seen + 3;)
      std::this_thread::yield();
    set_("x", 10);
  });
  const std::string fault = driver_.read(state_);
  heals.join();
  EXPECT_EQ(fault, "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.01);
  set_("x", 1e5);
  std::string gives_up;
  for (int i = 0; i < 1000 && gives_up.empty(); ++i)
    gives_up = driver_.read(state_);  // some good ones may have been before
  EXPECT_NE(gives_up, "");
}

TEST_F(OpenHapticsDriver, OpensTheArmOfThatNameAtThatRate) {
  ASSERT_EQ(open(",name=Left Arm,rate=500"), "");
  EXPECT_EQ(get_("named"), 1);
  EXPECT_EQ(get_("rate"), 500);
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_DOUBLE_EQ(info.rate_hz, 500);
}

TEST_F(OpenHapticsDriver, SaysWhatDoesNotOpen) {
  set_("init_error", 0x302);
  set_("internal", -5);
  const std::string fault = open(",name=Left Arm");
  EXPECT_NE(fault.find("Left Arm"), std::string::npos) << fault;
  EXPECT_NE(fault.find("internal -5"), std::string::npos) << fault;
  set_("init_error", 0);
  set_("error", 0x302);  // lost in its first tick
  EXPECT_NE(open(), "");
  EXPECT_EQ(get_("open"), 0);
  set_("no_rate", 1);
  EXPECT_NE(open(",rate=1600"), "");
  EXPECT_EQ(get_("open"), 0);
  EXPECT_NE(open(",rate=50"), "");
}

TEST_F(OpenHapticsDriver, DoesNotOpenWhenTheSchedulerDoesNotStart) {
  set_("never_ticks", 1);
  EXPECT_NE(open(), "");
  EXPECT_EQ(get_("open"), 0);
  EXPECT_EQ(get_("running"), 0);
}

TEST_F(OpenHapticsDriver, NamesALibraryThatIsNotThereOrNotTheVendors) {
  EXPECT_NE(driver_.open("library=no_such_library.so").find("no_such_library.so"), std::string::npos);
  EXPECT_NE(driver_.open("library=libm.so.6").find("hdInitDevice"), std::string::npos);
}

TEST_F(OpenHapticsDriver, NeverUnloadsTheVendorsLibrary) {
  ASSERT_EQ(open(), "");
  close();
  let_go();  // the driver alone holds it now
  void* still_there = ::dlopen(file_.c_str(), RTLD_LAZY | RTLD_NOLOAD);
  ASSERT_NE(still_there, nullptr);
  ::dlclose(still_there);
}

TEST(OpenHapticsHeat, HoldsAWarningForTenSecondsWithoutAThermometer) {
  using namespace std::chrono_literals;
  drivers::hd::Heat heat;
  const drivers::hd::Clock::time_point start{100s};
  EXPECT_FALSE(heat.update(-1, false, start));
  EXPECT_TRUE(heat.update(-1, true, start));
  EXPECT_TRUE(heat.update(-1, false, start + 9s));
  EXPECT_FALSE(heat.update(-1, false, start + 10s));
  EXPECT_TRUE(heat.update(0.8, false, start + 11s));
  EXPECT_TRUE(heat.update(0.6, false, start + 60s));
  EXPECT_FALSE(heat.update(0.4, false, start + 61s));
}

TEST(OpenHapticsHeat, TheWarmestMotorCounts) {
  EXPECT_DOUBLE_EQ(drivers::hd::warmest(std::array{0.1, 0.6, -1.0, kHdNan}), 0.6);
  EXPECT_LT(drivers::hd::warmest(std::array{-1.0, kHdNan}), 0);
}

TEST(OpenHapticsVectors, QuaternionAndMatrixAgreeForAllTurns) {
  for (double w = -1; w <= 1; w += 0.5)
    for (double x = -1; x <= 1; x += 0.5)
      for (double y = -1; y <= 1; y += 0.5)
        for (double z = -1; z <= 1; z += 0.5) {
          const double n = std::sqrt(w * w + x * x + y * y + z * z);
          if (n == 0) continue;
          const double a = w / n, b = x / n, c = y / n, d = z / n;
          const std::array<double, 9> m = {1 - 2 * (c * c + d * d), 2 * (b * c - a * d),     2 * (b * d + a * c),
                                           2 * (b * c + a * d),     1 - 2 * (b * b + d * d), 2 * (c * d - a * b),
                                           2 * (b * d - a * c),     2 * (c * d + a * b),     1 - 2 * (b * b + c * c)};
          std::array<double, 4> q{};
          ASSERT_TRUE(drivers::quaternion_of(m, q));
          EXPECT_NEAR(std::abs(q[0] * a + q[1] * b + q[2] * c + q[3] * d), 1, 1e-12);  // q and -q are the same turn
        }
}

TEST(OpenHapticsVectors, RefusesWhatIsNoRotation) {
  std::array<double, 4> q{};
  EXPECT_FALSE(drivers::quaternion_of(std::array<double, 9>{}, q));
  EXPECT_FALSE(drivers::quaternion_of(std::array<double, 9>{-1, 0, 0, 0, 1, 0, 0, 0, 1}, q));  // a mirror
  EXPECT_FALSE(drivers::quaternion_of(std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, kHdNan}, q));
  EXPECT_FALSE(drivers::quaternion_of(std::array<double, 9>{1.1, 0, 0, 0, 1, 0, 0, 0, 1}, q));
  EXPECT_EQ(q, (std::array<double, 4>{}));
}

TEST(OpenHapticsMailbox, GivesTheNewestOnceAndWhole) {
  drivers::NewestValue<std::array<int, 16>> box;
  std::array<int, 16> got{};
  EXPECT_FALSE(box.take(got));
  constexpr int kLast = 20000;
  std::thread writer([&box] {
    for (int i = 1; i <= kLast; ++i) {
      std::array<int, 16> value{};
      value.fill(i);
      box.put(value);
    }
  });
  int newest = 0;
  bool torn = false, older = false;
  while (newest != kLast) {
    if (!box.take(got)) continue;
    for (const int part : got)
      torn = torn || part != got.front();
    older = older || got.front() <= newest;
    newest = got.front();
  }
  writer.join();
  EXPECT_FALSE(torn);
  EXPECT_FALSE(older);
  EXPECT_FALSE(box.take(got));
}

}  // namespace
}  // namespace mechane::test
