// The driver of LucidGloves against firmware at the other end of a pseudo-terminal, and its encoding.
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>

#include "client-sdk/drivers/lucidgloves/alpha.hpp"
#include "client-sdk/drivers/lucidgloves/brake.hpp"
#include "tests/support/driver_under_test.hpp"
#include "tests/support/fake_serial_glove.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using test::DriverUnderTest;

constexpr double kLucidNaN = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kLucidHand = "A0B1000C2000D3000E4095F2047G2047P0";

/// Firmware of LucidGloves as its sources have it: one line out, one line of the host's in; what a line leaves out
/// becomes 0.
class LucidFirmware {
 public:
  struct Orders {
    std::string says = kLucidHand;  // empty: nothing
    bool waits_for_host = true;     // as the firmware does; else it sends all the time
    std::string at_start{};         // what a board says of itself before
  };

  explicit LucidFirmware(Orders orders) : orders_(std::move(orders)) {}
  LucidFirmware() : LucidFirmware(Orders()) {}

  [[nodiscard]] const std::string& port() const { return line_.port(); }
  void unplug() { line_.unplug(); }
  void says(const std::string& text) {
    const std::lock_guard lock(mutex_);
    orders_.says = text;
  }
  [[nodiscard]] std::vector<int> limits() const {
    const std::lock_guard lock(mutex_);
    return limits_;
  }
  [[nodiscard]] int lines_heard() const {
    const std::lock_guard lock(mutex_);
    return lines_heard_;
  }
  [[nodiscard]] int lines_said() const {
    const std::lock_guard lock(mutex_);
    return lines_said_;
  }
  [[nodiscard]] bool was_started() const {
    const std::lock_guard lock(mutex_);
    return started_;
  }

 private:
  std::string step(std::string_view heard) {
    const std::lock_guard lock(mutex_);
    bool came = false;
    for (const char c : heard) {
      if (c != '\n') {
        partial_ += c;
        continue;
      }
      take(partial_);
      partial_.clear();
      came = true;
    }
    if (orders_.says.empty() || (orders_.waits_for_host && !came)) return {};
    ++lines_said_;
    return std::exchange(orders_.at_start, "") + orders_.says + "\n";
  }
  void take(const std::string& line) {
    ++lines_heard_;
    started_ = started_ || line == "(ZA)";
    for (std::size_t f = 0; f < limits_.size(); ++f) {
      const std::size_t at = line.find(static_cast<char>('A' + f));
      limits_[f] = at == std::string::npos ? 0 : std::atoi(line.c_str() + at + 1);
    }
  }

  mutable std::mutex mutex_;  // the glove's thread and the test's
  Orders orders_;
  std::string partial_;
  std::vector<int> limits_ = std::vector<int>(MECHANE_FINGERS, -1);
  int lines_heard_ = 0;
  int lines_said_ = 0;
  bool started_ = false;
  test::FakeSerialGlove line_{[this](std::string_view heard) { return step(heard); }};  // last: it calls the others
};

/// The driver as its process serves it. Each call comes back with what is so far from being well; empty: nothing.
class LucidTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string open(const LucidFirmware& glove, const std::string& more = "", const char* wait_s = "1") {
    return driver_.open("port=" + glove.port() + ",wait=" + wait_s + more);
  }
  /// Reads and writes in turn until `done`, or a fault.
  [[nodiscard]] std::string serve(const std::function<bool()>& done, const mechane_device_force& force = {}) {
    const auto until = std::chrono::steady_clock::now() + 5s;
    while (!done()) {
      if (std::chrono::steady_clock::now() > until) return "it never came to this";
      if (std::string fault = driver_.read(state_); !fault.empty()) return fault;
      if (std::string fault = driver_.write(force); !fault.empty()) return fault;
      ::poll(nullptr, 0, 1);
    }
    return {};
  }

  static void expect_soon(const std::function<bool()>& done) {
    const auto until = std::chrono::steady_clock::now() + 5s;
    while (!done() && std::chrono::steady_clock::now() < until)
      ::poll(nullptr, 0, 1);
    EXPECT_TRUE(done());
  }

  DriverUnderTest driver_{"lucidgloves"};
  mechane_device_state state_{};
};

mechane_device_force lucid_hold(std::size_t finger, double force_n) {
  mechane_device_force force{};
  force.finger_n[finger] = force_n;
  return force;
}

TEST_F(LucidTest, TheDeviceIsAGloveThatBrakes) {
  const LucidFirmware glove;
  ASSERT_EQ(open(glove, ",hand=left"), "");
  mechane_device_info info;
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.hand, MECHANE_HAND_GLOVE);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FINGER_BRAKE);
  EXPECT_NE(std::string(info.name).find("left"), std::string::npos);
  EXPECT_EQ(info.side, MECHANE_HAND_LEFT);
  EXPECT_TRUE(glove.was_started());
}

TEST_F(LucidTest, TheHandIsInRadians) {
  const LucidFirmware glove;
  ASSERT_EQ(open(glove), "");
  ASSERT_EQ(driver_.read(state_), "");
  constexpr double degree = std::numbers::pi / 180;
  EXPECT_EQ(state_.flags, MECHANE_STATE_READY);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(state_.joints_rad[k], 0) << "the thumb is open";
  EXPECT_NEAR(state_.joints_rad[4 * 4 + 1], 90 * degree, 1e-9);
  EXPECT_NEAR(state_.joints_rad[4 * 4 + 2], 100 * degree, 1e-9);
  EXPECT_NEAR(state_.joints_rad[4 * 4 + 3], 90 * degree, 1e-9);
  EXPECT_NEAR(state_.joints_rad[4 * 1 + 1], 1000 / 4095.0 * 90 * degree, 1e-9);
  EXPECT_NEAR(state_.grasp, (1000 + 2000 + 3000 + 4095) / 4095.0 / 4, 1e-9);
  EXPECT_EQ(state_.orientation_wxyz[0], 1);
}

TEST_F(LucidTest, ABrakeStopsTheStringWhereTheFingerIs) {
  LucidFirmware glove({.says = "A0B2457C0D0E0"});  // the index finger at 0.6
  ASSERT_EQ(open(glove), "");
  const auto index_stops_at = [&](int limit) {
    return [&glove, limit] { return glove.limits() == std::vector<int>{0, limit, 0, 0, 0}; };
  };
  EXPECT_EQ(serve(index_stops_at(0)), "");
  EXPECT_EQ(serve(index_stops_at(400), lucid_hold(1, 3)), "");

  glove.says("A0B3276C0D0E0");  // pulls on: it is held at 0.6 all the same
  EXPECT_EQ(serve([&] { return state_.grasp > 0.7 / 4; }, lucid_hold(1, 3)), "");
  EXPECT_TRUE(index_stops_at(400)());
  glove.says("A0B819C0D0E0");  // opens to 0.2: the stop comes along
  EXPECT_EQ(serve(index_stops_at(800), lucid_hold(1, 0.001)), "");
  EXPECT_EQ(serve(index_stops_at(0)), "");
  EXPECT_EQ(serve(index_stops_at(800), lucid_hold(1, 3)), "");
  EXPECT_EQ(serve(index_stops_at(0), lucid_hold(1, kLucidNaN)), "");
}

TEST_F(LucidTest, AHandIsAnsweredAtOnceAndOnce) {
  const LucidFirmware glove;
  ASSERT_EQ(open(glove), "");
  const auto begun = std::chrono::steady_clock::now();
  const int before = glove.lines_heard();
  EXPECT_EQ(serve([&] { return glove.lines_heard() >= before + 30; }), "");
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 1s) << "only the keep-alive makes it go on";
  // One more where the keep-alive came first, and one to start with.
  const auto alive = (std::chrono::steady_clock::now() - begun) / 50ms;
  EXPECT_LE(glove.lines_heard() - before, glove.lines_said() + alive + 2);
}

TEST_F(LucidTest, LimitsAreRepeatedToAGloveThatSaysNothing) {
  LucidFirmware glove({.says = "A0B2457C0D0E0"});
  ASSERT_EQ(open(glove), "");
  ASSERT_EQ(serve([&] { return glove.limits()[1] == 400; }, lucid_hold(1, 3)), "");
  glove.says("");
  const int before = glove.lines_heard();
  expect_soon([&] {
    EXPECT_EQ(driver_.write(lucid_hold(1, 3)), "");
    return glove.lines_heard() >= before + 3;
  });
  EXPECT_EQ(glove.limits()[1], 400);
}

TEST_F(LucidTest, ClosingReleasesAllFingers) {
  const LucidFirmware glove({.says = "A2047B2047C2047D2047E2000"});
  ASSERT_EQ(open(glove), "");
  mechane_device_force all{};
  for (double& force : all.finger_n)
    force = 1;
  ASSERT_EQ(serve([&] { return glove.limits()[4] > 500; }, all), "");
  driver_.close();
  expect_soon([&] { return glove.limits() == std::vector<int>(5, 0); });
}

TEST_F(LucidTest, AGloveThatFallsSilentIsAFault) {
  LucidFirmware glove({.waits_for_host = false});
  ASSERT_EQ(open(glove), "");
  ASSERT_EQ(driver_.read(state_), "");
  glove.says("");
  const auto silent = std::chrono::steady_clock::now();
  EXPECT_NE(serve([] { return false; }).find("sends nothing"), std::string::npos);
  EXPECT_GT(std::chrono::steady_clock::now() - silent, 50ms);
  EXPECT_LT(std::chrono::steady_clock::now() - silent, 2s);
}

TEST_F(LucidTest, AGloveThatIsPulledOutIsAFault) {
  LucidFirmware glove;
  ASSERT_EQ(open(glove), "");
  glove.unplug();
  EXPECT_NE(serve([] { return false; }), "it never came to this");
}

TEST_F(LucidTest, TornLinesAreLeftOut) {
  LucidFirmware glove({.says = "A0B0C0D0E100\nA0B40A0B0C0D0E4095\n95C0D0E4095\nA0B0C0", .waits_for_host = false});
  ASSERT_EQ(open(glove), "");
  const int before = glove.lines_said();
  EXPECT_EQ(serve([&] {
              EXPECT_LT(state_.grasp, 100 / 4095.0 / 4 + 1e-9);
              return glove.lines_said() > before + 20;
            }),
            "");
}

TEST_F(LucidTest, NothingButTornLinesIsAFault) {
  LucidFirmware glove({.waits_for_host = false});
  ASSERT_EQ(open(glove), "");
  glove.says("A0B40C0D");
  EXPECT_NE(serve([] { return false; }), "it never came to this");
}

TEST_F(LucidTest, AnotherFullScaleIsNoticed) {
  const LucidFirmware glove({.waits_for_host = false});
  EXPECT_NE(open(glove, ",range=1023", "0.2").find("range"), std::string::npos);
}

TEST_F(LucidTest, ABoardOfEightBitsHasItsOwnFullScale) {
  const LucidFirmware glove({.says = "A0B1023C1023D1023E1023"});
  ASSERT_EQ(open(glove, ",range=1023"), "");
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_EQ(state_.grasp, 1);
}

TEST_F(LucidTest, WhatABoardSaysWhenItStartsIsPassedOver) {
  const std::string long_text(700, 'B');
  const LucidFirmware glove({.at_start = "ets Jun  8 2016 00:22:57\r\n\r\nrst:0x1\n" + long_text + "\n"});
  ASSERT_EQ(open(glove), "");
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_GT(state_.grasp, 0.5);
}

TEST_F(LucidTest, AHandThatIsNotCalibratedIsNotReady) {
  LucidFirmware glove({.says = "A2047B2047C2047D2047E2047"});  // no finger has moved yet
  ASSERT_EQ(open(glove), "");
  ASSERT_EQ(driver_.read(state_), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_UNCALIBRATED);
  glove.says("A2047B2100C2047D2047E2047");
  EXPECT_EQ(serve([&] { return state_.flags == MECHANE_STATE_READY; }), "");
  glove.says("A2047B2100C2047D2047E2047HO");  // it is being calibrated
  EXPECT_EQ(serve([&] { return state_.flags == MECHANE_STATE_UNCALIBRATED; }), "");
  EXPECT_EQ(state_.buttons, 0x81u);
}

TEST_F(LucidTest, OneGloveIsOneProgramsAlone) {
  const LucidFirmware glove;
  ASSERT_EQ(open(glove), "");
  DriverUnderTest second("lucidgloves");
  EXPECT_NE(second.open("port=" + glove.port()), "");
}

TEST_F(LucidTest, WhatCannotBeOpenedSaysSo) {
  const LucidFirmware mute({.says = ""});
  EXPECT_NE(driver_.open("port=" + mute.port() + ",wait=0.1"), "");
  EXPECT_NE(driver_.open("port=" + mute.port() + ",hand=both"), "");
  EXPECT_NE(driver_.open("port=" + mute.port() + ",range=100"), "");
  EXPECT_NE(driver_.open("port=/dev/no-such-port"), "");
  EXPECT_NE(driver_.open("port=/dev/null"), "");
}

AlphaLine lucid_decode(const std::string& line, AlphaHand& hand) {
  return decode_alpha(line, 4095, hand);
}

TEST(LucidAlpha, SingleJointsAndSplayStandOverTheCurl) {
  AlphaHand hand;
  ASSERT_EQ(lucid_decode("(AB)4095A4095B0C0D0E0(BB)0(BAA)1(BAB)4095(BAD)2047(AAA)0(CC)7(QQ)Q5\r", hand),
            AlphaLine::hand);
  EXPECT_EQ(hand.splay, (std::array<double, 5>{1, -1, 0, 0, 0}));
  EXPECT_EQ(hand.flexion[0], (std::array<double, 3>{0, 1, 1})) << "the thumb's first is its root";
  EXPECT_EQ(hand.flexion[1], (std::array<double, 3>{1, 0, 2047 / 4095.0})) << "a finger's second is its knuckle";
  double joints[MECHANE_HAND_JOINTS] = {};
  place_joints(hand, joints);
  EXPECT_NEAR(joints[0], 20 * std::numbers::pi / 180, 1e-9);
  EXPECT_NEAR(joints[4], -20 * std::numbers::pi / 180, 1e-9);
}

TEST(LucidAlpha, WhatIsNotAWholeHandChangesNothing) {
  AlphaHand hand;
  ASSERT_EQ(lucid_decode("A1B2C3D4E5H", hand), AlphaLine::hand);
  for (const char* line : {"A1B2C3D4", "B2C3D4E5", "A1B2C3D4E", "A1B2C3D4E5E5", "A1B2C3D4E5F", "A-1B2C3D4E5",
                           "A1B2C3D4E5H1", "A1B2C3D4E5(AB)", "A1B2C3D4E5(AB", "A1B2C3D4E5()3", "1A1B2C3D4E5",
                           "A1 B2C3D4E5", "A1B2C3D4E99999", "a1b2c3d4e5", "A1B2C3D4E5(A(AB)1"})
    EXPECT_EQ(lucid_decode(line, hand), AlphaLine::malformed) << line;
  EXPECT_EQ(lucid_decode("A1B2C3D4E4096", hand), AlphaLine::beyond_range);
  EXPECT_EQ(lucid_decode("Z(ZV)1(ZG)0(ZH)1", hand), AlphaLine::other);
  EXPECT_EQ(lucid_decode("\r", hand), AlphaLine::other);
  EXPECT_EQ(hand.curl[4], 5 / 4095.0);
  EXPECT_EQ(hand.buttons, 1u);
}

TEST(LucidAlpha, LinesAreTheSameHoweverTheirBytesArrive) {
  const std::string bytes = "7C1\nA1B2C3D4E5\n\r\nA1B2C3D4E6K\r\nnoise\nA1B2C3D4E7\nA1B2";
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    AlphaStream stream(4095);
    for (std::size_t at = 0; at < bytes.size(); at += piece)
      stream.add(std::string_view(bytes).substr(at, piece));
    EXPECT_EQ(stream.hands(), 3u) << piece;
    EXPECT_EQ(stream.hand().curl[4], 7 / 4095.0) << piece;
    EXPECT_EQ(stream.trouble(), AlphaLine::hand) << piece;
  }
}

TEST(LucidAlpha, AllFiveLimitsGoEachTime) {
  AlphaText text;
  EXPECT_EQ(encode_limits({0, 1000, 7, 0, 250}, text), "A0B1000C7D0E250\n");
  EXPECT_EQ(encode_limits({-2147483647, -2147483647, 0, 0, 0}, text).back(), '\n');
}

TEST(LucidBrakes, AnUnsteadyFingerIsNotPulledOpen) {
  FingerBrakes brakes;
  const double held[MECHANE_FINGERS] = {0, 1, 0, 0, 0};
  const int limit = brakes.follow({0, 0.50, 0, 0, 0}, held)[1];
  EXPECT_EQ(limit, 500);
  for (const double noise : {0.49, 0.51, 0.485, 0.5})
    EXPECT_EQ(brakes.follow({0, noise, 0, 0, 0}, held)[1], limit);
  EXPECT_EQ(brakes.follow({0, 0.4, 0, 0, 0}, held)[1], 600);
  const double released[MECHANE_FINGERS] = {0, -1, 0, 0, 0};
  EXPECT_EQ(brakes.follow({0, 0.4, 0, 0, 0}, released), StringLimits{});
}

}  // namespace
}  // namespace mechane::drivers
