// The driver of the Falcon against a stub of libftdi with a board behind it (tests/support/fake_ftdi.cpp), its frames
// and its kinematics.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "client-sdk/drivers/falcon/frame.hpp"
#include "client-sdk/drivers/falcon/kinematics.hpp"
#include "client-sdk/drivers/vectors.hpp"
#include "tests/support/driver_on_fake.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::test {
namespace {

using drivers::falcon::Triple;

constexpr double kFalconCounts = 400;  // for a newton

/// Somewhere in the workspace, in the base's frame.
Triple falcon_place(std::mt19937& random) {
  std::uniform_real_distribution<double> part(-0.035, 0.035);
  Triple p = drivers::falcon::kMiddle_m;
  for (double& x : p)
    x += part(random);
  return p;
}

/// How the thighs turn when the grip goes along `axis`, rad/m.
Triple falcon_turns(const Triple& p, std::size_t axis) {
  constexpr double kStep_m = 1e-6;
  Triple to = p, from = p, ahead{}, behind{};
  to[axis] += kStep_m, from[axis] -= kStep_m;
  EXPECT_TRUE(drivers::falcon::thigh_angles(to, ahead));
  EXPECT_TRUE(drivers::falcon::thigh_angles(from, behind));
  Triple turns{};
  for (std::size_t leg = 0; leg < 3; ++leg)
    turns[leg] = (ahead[leg] - behind[leg]) / (2 * kStep_m);
  return turns;
}

class FalconDriver : public DriverOnFake {
 protected:
  FalconDriver() : DriverOnFake("falcon", "ftdi") {}
  void TearDown() override {
    DriverOnFake::TearDown();
    EXPECT_EQ(get_("misuse"), 0);
    EXPECT_EQ(get_("open"), 0);
    EXPECT_EQ(get_("contexts"), 0);
  }

  /// A board that runs, with legs that know their angles.
  std::string open_running(const std::string& more = ",counts_per_newton=400") {
    set_("running", 1);
    return open(more);
  }
  /// Reads and pushes until the motors do something: on a busy machine a hand may be of a while ago.
  std::string render(const Triple& force_n) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    std::string fault;
    do {
      fault = read();
      if (fault.empty()) fault = push(force_n[0], force_n[1], force_n[2]);
    } while (fault.empty() && motors() == Triple{} && std::chrono::steady_clock::now() < deadline);
    return fault;
  }
  /// Puts the grip where in D it shall be.
  void go(double x, double y, double z) {
    const Triple& middle = drivers::falcon::kMiddle_m;
    Triple angles{};
    EXPECT_TRUE(drivers::falcon::thigh_angles({x + middle[0], y + middle[1], z + middle[2]}, angles));
    const double zero = drivers::falcon::thigh_angle(0), step = drivers::falcon::thigh_angle(1) - zero;
    std::size_t leg = 0;
    for (const char* encoder : {"e0", "e1", "e2"})
      set_(encoder, std::round((angles[leg++] - zero) / step));
  }
  /// While the device is read and pushes.
  template <class Condition>
  bool comes(const Condition& condition) {
    return DriverOnFake::comes(condition, [this] {
      fault_ = read();
      if (fault_.empty()) fault_ = push(0, 0, 1);
    });
  }
  bool fault_comes() {
    return comes([this] { return !fault_.empty(); });
  }
  [[nodiscard]] Triple motors() const { return {get_("m0"), get_("m1"), get_("m2")}; }
  /// The force at the grip for these motors, by the work that they do when it moves.
  [[nodiscard]] Triple force_of(const Triple& p_D, const Triple& motors) const {
    Triple p = drivers::falcon::kMiddle_m, force{};
    for (std::size_t i = 0; i < 3; ++i)
      p[i] += p_D[i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      force[axis] = -drivers::dot(motors, falcon_turns(p, axis)) * drivers::falcon::kThigh_m / kFalconCounts;
    return force;
  }

  ScratchFolder folder_;
  std::string image_ = folder_.write("image.bin", std::string(1000, 'f')).string();
  std::string fault_;
};

TEST_F(FalconDriver, LoadsTheFirmwareOnceAndThenFindsItRunning) {
  ASSERT_EQ(open(",firmware=" + image_), "");
  EXPECT_EQ(get_("uploads"), 1);
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
  driver_.close();
  ASSERT_EQ(open(""), "");
  EXPECT_EQ(get_("uploads"), 1);
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
}

TEST_F(FalconDriver, TriesAnUploadAgain) {
  for (const char* trouble : {"wrong_echoes", "short_echoes", "no_starts"}) {
    set_("running", 0);
    set_("uploads", 0);
    set_(trouble, 1);
    EXPECT_EQ(open(",firmware=" + image_), "") << trouble;
    EXPECT_EQ(get_("uploads"), 2) << trouble;
    driver_.close();
  }
  set_("running", 0);
  set_("deaf", 3);
  set_("no_cts", 1);
  EXPECT_EQ(open(",firmware=" + image_), "");
}

TEST_F(FalconDriver, GivesUpAnUploadAndSaysHowOftenItTried) {
  set_("wrong_echoes", 1000);
  const std::string fault = open(",firmware=" + image_);
  EXPECT_NE(fault.find(std::to_string(static_cast<int>(get_("uploads")))), std::string::npos) << fault;
  EXPECT_GT(get_("uploads"), 2);
}

TEST_F(FalconDriver, SaysWhatDoesNotOpen) {
  EXPECT_NE(open("").find("firmware=FILE"), std::string::npos);
  EXPECT_NE(open(",firmware=" + image_ + ".not"), "");
  EXPECT_NE(open(",counts_per_newton=many"), "");
  set_("timeout", 7);  // another libftdi
  EXPECT_NE(open_running(), "");
  set_("timeout", 5000);
  EXPECT_EQ(open_running(",device=1"), "");
  EXPECT_EQ(get_("index"), 1);
  driver_.close();
  EXPECT_NE(open(",device=2"), "");
  set_("absent", 1);
  EXPECT_NE(open(""), "");
  EXPECT_NE(driver_.open("library=no_such_library.so").find("no_such_library.so"), std::string::npos);
  EXPECT_NE(driver_.open("library=libm.so.6").find("ftdi_new"), std::string::npos);
}

TEST_F(FalconDriver, WithoutCountsPerNewtonItOnlyReads) {
  ASSERT_EQ(open_running(""), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.output, MECHANE_OUTPUT_NONE);
  EXPECT_EQ(info.peak_force_n, 0);
  EXPECT_NE(std::string(info.name).find("not calibrated"), std::string::npos);
  ASSERT_EQ(read(), "");
  ASSERT_EQ(push(1, 2, 3), "");
  EXPECT_EQ(motors(), Triple{});
}

TEST_F(FalconDriver, DescribesNoMoreForceThanItsMotorsGive) {
  go(0, 0, 0);
  mechane_device_info info{};
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FORCE);
  EXPECT_EQ(info.paces, 1u);
  const double peak_n = info.peak_force_n;
  EXPECT_GT(peak_n, 1);
  EXPECT_LE(peak_n, 8);
  EXPECT_LT(info.continuous_force_n, peak_n);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Triple wanted{};
    wanted[axis] = peak_n;
    ASSERT_EQ(push(0, 0, 0), "");
    ASSERT_EQ(render(wanted), "");
    EXPECT_NEAR(force_of({}, motors())[axis], peak_n, 0.01);
  }
  driver_.close();
  ASSERT_EQ(open_running(",counts_per_newton=4000"), "");
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_LT(info.peak_force_n, peak_n / 5);
}

TEST_F(FalconDriver, ReadsPositionAndButtons) {
  set_("buttons", 5);
  for (const Triple& p : {Triple{0.02, 0, 0}, Triple{0, 0.03, 0}, Triple{0.01, -0.01, -0.03}}) {
    go(p[0], p[1], p[2]);
    ASSERT_EQ(open_running(), "");
    ASSERT_EQ(read(), "");
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(state_.position_m[i], p[i], 5e-5);  // an encoder's step is 0.04 mm at the knee
    EXPECT_EQ(state_.buttons, 5u);
    EXPECT_TRUE(ready());
    EXPECT_EQ(state_.orientation_wxyz[0], 1);
    driver_.close();
  }
}

TEST_F(FalconDriver, IsNotReadyBeforeAllLegsAreHomed) {
  for (const int homed : {0, 1, 3, 6}) {
    set_("homed", homed);
    ASSERT_EQ(open_running(), "");
    ASSERT_EQ(read(), "");
    EXPECT_EQ(state_.flags, MECHANE_STATE_UNCALIBRATED) << homed;
    ASSERT_EQ(push(0, 0, 1), "");
    EXPECT_EQ(motors(), Triple{});
    EXPECT_EQ(get_("homing"), 1);
    EXPECT_EQ(get_("lights"), 2);  // red
    driver_.close();
  }
  ASSERT_EQ(open_running(), "");
  set_("homed", 7);
  go(0.01, 0, 0);
  ASSERT_TRUE(comes([this] { return ready() && motors() != Triple{}; }));
  EXPECT_EQ(get_("lights"), 4);  // green
}

TEST_F(FalconDriver, RendersTheForceThatItIsTold) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 50; ++i) {
    Triple p = falcon_place(random), wanted{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] -= drivers::falcon::kMiddle_m[k];
      wanted[k] = part(random);
    }
    go(p[0], p[1], p[2]);
    ASSERT_EQ(open_running(), "");
    ASSERT_EQ(render(wanted), "");
    const Triple got = force_of(p, motors());
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(got[k], wanted[k], 0.01);
    driver_.close();
  }
}

TEST_F(FalconDriver, KeepsTheDirectionOfAForceThatIsTooMuch) {
  const Triple p = {-0.03, 0.03, 0.03}, wanted = {-600, -300, 200};  // a long arm for the right leg
  go(p[0], p[1], p[2]);
  for (const char* counts : {"400", "1500"}) {  // more than the device bears; more than its motors can do
    ASSERT_EQ(open_running(std::string(",counts_per_newton=") + counts), "");
    ASSERT_EQ(render(wanted), "");
    double most = 0;
    for (const double motor : motors())
      most = std::max(most, std::abs(motor));
    EXPECT_EQ(most == 4095, counts == std::string_view("1500")) << most;
    const Triple got = force_of(p, motors());
    const double length = std::sqrt(drivers::dot(got, got)), cosine = drivers::dot(got, wanted) / length / 700;
    EXPECT_LE(length * kFalconCounts / std::stod(counts), 8.01);
    EXPECT_GT(cosine, 0.9999);
    ASSERT_EQ(read(), "");
    ASSERT_EQ(push(1, std::numeric_limits<double>::quiet_NaN(), 0), "");
    EXPECT_EQ(motors(), Triple{});
    driver_.close();
  }
}

TEST_F(FalconDriver, SkipsAnswersThatAreTornOrWrong) {
  go(0.01, 0.02, 0);
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(read(), "");
  for (const char* trouble : {"torn", "garbage", "wrong"}) {
    set_(trouble, 1);
    for (int i = 0; i < 4; ++i) {
      ASSERT_EQ(push(0, 0, 1), "");
      ASSERT_EQ(read(), "") << trouble;
      EXPECT_NEAR(state_.position_m[0], 0.01, 5e-5) << trouble;
      EXPECT_NEAR(state_.position_m[1], 0.02, 5e-5) << trouble;
    }
    EXPECT_TRUE(ready()) << trouble;
  }
}

TEST_F(FalconDriver, GivesUpWhenAnswersStayTornOrWrong) {
  for (const char* trouble : {"torn", "wrong", "mute"}) {
    ASSERT_EQ(open_running(), "");
    ASSERT_EQ(read(), "");
    set_(trouble, 1e9);
    ASSERT_TRUE(fault_comes()) << trouble;
    EXPECT_EQ(motors(), Triple{}) << trouble;  // no force on a hand that is not of now
    driver_.close();
    set_(trouble, 0);
    fault_.clear();
  }
}

TEST_F(FalconDriver, ALeapThatNoHandMakesIsBelievedOnlyWhenItLasts) {
  using Clock = std::chrono::steady_clock;
  ASSERT_EQ(open_running(), "");
  bool judged = false;
  while (!judged && fault_.empty()) {  // until the machine lets the test be fast enough
    go(-0.02, 0, 0);
    ASSERT_TRUE(comes([this] { return state_.position_m[0] < -0.0199; }));
    const auto begun = Clock::now();
    ASSERT_EQ(read(), "");
    go(0.02, 0, 0);
    ASSERT_EQ(push(0, 0, 0), "");
    ASSERT_EQ(read(), "");
    judged = Clock::now() - begun < std::chrono::milliseconds(10);  // 4 cm take 13 ms
    EXPECT_TRUE(!judged || state_.position_m[0] < -0.0199);
  }
  EXPECT_TRUE(comes([this] { return state_.position_m[0] > 0.0199; }));
  EXPECT_EQ(fault_, "");
}

TEST_F(FalconDriver, AnAnswerThatIsLateIsNotTakenForTheNext) {
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(read(), "");
  set_("late_ms", 8);  // more than the driver waits
  ASSERT_EQ(push(0, 0, 0), "");
  ASSERT_EQ(read(), "");
  set_("late_ms", 0);
  ASSERT_TRUE(comes([this] { return get_("frames") > 20; }));  // its last command waits for an answer still
  for (int i = 0; i < 10; ++i) {
    set_("buttons", i);
    ASSERT_EQ(push(0, 0, 0), "");
    ASSERT_EQ(read(), "");
    EXPECT_EQ(state_.buttons, static_cast<unsigned>(i));
  }
}

TEST_F(FalconDriver, ABoardThatIsGoneIsAFault) {
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(read(), "");
  set_("absent", 1);
  EXPECT_NE(push(1, 0, 0).find("fake: no device"), std::string::npos);
  EXPECT_NE(read(), "");
  set_("absent", 0);
  ASSERT_EQ(push(0, 0, 0), "");
  ASSERT_EQ(read(), "");
  set_("stuck", 1);
  ASSERT_EQ(push(0, 0, 0), "");
  EXPECT_NE(read(), "");
}

TEST_F(FalconDriver, ReadsWithoutAWriteAskWithoutForce) {
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(render({0, 0, 1}), "");
  ASSERT_EQ(read(), "");
  EXPECT_NE(motors(), Triple{});
  ASSERT_EQ(read(), "");
  EXPECT_EQ(motors(), Triple{});
}

TEST_F(FalconDriver, ClosesWithoutForce) {
  ASSERT_EQ(open_running(), "");
  ASSERT_EQ(render({1, 2, 3}), "");
  EXPECT_EQ(get_("zeros"), 0);
  driver_.close();
  EXPECT_GE(get_("zeros"), 2);  // one may be lost
}

TEST(FalconKinematics, ThereAndBackIsTheSame) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Triple p = falcon_place(random);
    Triple angles{}, back{};
    ASSERT_TRUE(drivers::falcon::thigh_angles(p, angles));
    ASSERT_TRUE(drivers::falcon::grip_position(angles, back));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(back[k], p[k], 1e-9);
  }
}

/// The real legs' measures, apart from the driver's formulae: each shin is as long as it is.
TEST(FalconKinematics, EveryShinKeepsItsLength) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Triple p = falcon_place(random);
    Triple angles{};
    ASSERT_TRUE(drivers::falcon::thigh_angles(p, angles));
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double turn = (105.0 - 120.0 * static_cast<double>(leg)) * M_PI / 180;
      const Triple out = {std::cos(turn), std::sin(turn), 0}, along = {-out[1], out[0], 0};
      const double knee_out = 0.0400 + 0.060 * std::cos(angles[leg]), knee_up = 0.060 * std::sin(angles[leg]);
      const double u = drivers::dot(p, out) + 0.01443 - knee_out, v = drivers::dot(p, along) + 0.02309 - 0.025;
      const double seen = std::hypot(u, p[2] - knee_up) - 2 * 0.01125;  // along the axle, less the links
      EXPECT_NEAR(std::hypot(seen, v), 0.1025, 1e-9);
    }
  }
}

TEST(FalconKinematics, TorquesDoTheWorkOfTheForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-5, 5);
  for (int i = 0; i < 200; ++i) {
    const Triple p = falcon_place(random), force = {part(random), part(random), part(random)};
    Triple angles{}, torques{};
    ASSERT_TRUE(drivers::falcon::thigh_angles(p, angles));
    ASSERT_TRUE(drivers::falcon::thigh_torques(angles, p, force, torques));
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(drivers::dot(torques, falcon_turns(p, axis)), force[axis], 1e-5);
  }
}

TEST(FalconKinematics, RefusesWhatNoLegsCanDo) {
  Triple out{};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(drivers::falcon::thigh_angles({0, 0, 0.4}, out));
  EXPECT_FALSE(drivers::falcon::thigh_angles({0.3, 0, 0.1}, out));
  EXPECT_FALSE(drivers::falcon::thigh_angles({nan, 0, 0.1}, out));
  EXPECT_FALSE(drivers::falcon::grip_position({nan, 0.5, 0.5}, out));
  EXPECT_FALSE(drivers::falcon::grip_position({3, 3, 3}, out));
  EXPECT_EQ(out, Triple{});
}

TEST(FalconKinematics, AThighTurnsWithItsEncoder) {
  EXPECT_NEAR(drivers::falcon::thigh_angle(0), 35 * M_PI / 180, 1e-12);
  EXPECT_NEAR(drivers::falcon::thigh_angle(1000) - drivers::falcon::thigh_angle(0), 36.43 * M_PI / 180, 1e-3);
}

std::array<std::uint8_t, 16> falcon_bytes(const char (&text)[17]) {
  std::array<std::uint8_t, 16> bytes{};
  std::copy_n(text, 16, bytes.begin());
  return bytes;
}

TEST(FalconFrames, AreAsPublished) {
  EXPECT_EQ(drivers::falcon::command({0, 0, 0}, 0), falcon_bytes("<AAAAAAAAAAAABA>"));
  // 1447 is 0x05A7, -1447 is 0xFA59; 4095 is the most.
  EXPECT_EQ(drivers::falcon::command({1447, -1447, 9999}, drivers::falcon::kGreen), falcon_bytes("<HKFAJFKPPPPAFA>"));
  drivers::falcon::Answers answers;
  answers.add(falcon_bytes("<HKFAJFKPAAAIsA>"));  // 's' is 'A' + 0x32
  ASSERT_EQ(answers.count(), 1u);
  EXPECT_EQ(answers.newest().counts, (std::array<int, 3>{1447, -1447, -32768}));
  EXPECT_EQ(answers.newest().buttons, 2u);
  EXPECT_EQ(answers.newest().homed, 3u);
  EXPECT_FALSE(answers.newest().all_homed());
}

TEST(FalconFrames, AreFoundAmongOtherBytes) {
  const std::string whole =
      "<AAAAAAAAAAAA\xB1"
      "A>";
  for (const std::string& before : {std::string(""), std::string("x>"), whole.substr(0, 9), whole.substr(3),
                                    std::string("<AAAAAAAAAAAA\xB1"
                                                "A<"),
                                    std::string("<AAAAAAAAAAAA\xB1"
                                                "AA")}) {
    drivers::falcon::Answers answers;
    for (const char byte : before + whole)
      answers.add(std::array{static_cast<std::uint8_t>(byte)});
    EXPECT_EQ(answers.count(), 1u) << before;
    EXPECT_TRUE(answers.newest().all_homed());
    EXPECT_FALSE(answers.noise());
    answers.add(std::array<std::uint8_t, 2>{'<', '!'});
    EXPECT_TRUE(answers.noise());
  }
}

}  // namespace
}  // namespace mechane::test
