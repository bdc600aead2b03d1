// The driver of Force Dimension's devices against a stub of the vendor's library (tests/support/fake_dhd.cpp), and its
// conversions.
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "client-sdk/drivers/dhd/api.hpp"
#include "client-sdk/drivers/vectors.hpp"
#include "tests/support/driver_on_fake.hpp"

namespace mechane::test {
namespace {

constexpr double kDhdNan = std::numeric_limits<double>::quiet_NaN();

class DhdDriver : public DriverOnFake {
 protected:
  DhdDriver() : DriverOnFake("dhd", "dhd") {}

  /// As many reads as it takes until the driver asks the device for its status.
  std::string look() {
    std::string fault;
    for (int i = 0; i < 20 && fault.empty(); ++i)
      fault = read();
    return fault;
  }
  /// Reads until the driver would switch a force on again that the device has switched off.
  void rest() {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(250);
    EXPECT_TRUE(comes([until] { return std::chrono::steady_clock::now() > until; }));
  }
  /// While the device is read.
  template <class Condition>
  bool comes(const Condition& condition) {
    return DriverOnFake::comes(condition, [this] { last_fault_ = read(); });
  }

  std::string last_fault_;
};

TEST_F(DhdDriver, OpensWithoutForceAndInTheVendorsOrder) {
  ASSERT_EQ(open(), "");
  EXPECT_EQ(get_("index"), 0);
  EXPECT_EQ(get_("auto_inits"), 0);
  EXPECT_EQ(get_("force_on"), 1);
  EXPECT_EQ(get_("brakes"), 0);
  EXPECT_EQ(get_("gravity"), 1);
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("fy"), 0);
  EXPECT_EQ(get_("fz"), 0);
  EXPECT_EQ(get_("misuse"), 0);
}

TEST_F(DhdDriver, DescribesAModelOfTheTableAndOneThatIsNot) {
  mechane_device_info info{};
  ASSERT_EQ(open(), "");
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_STREQ(info.name, "Force Dimension omega.3");
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FORCE);
  EXPECT_EQ(info.paces, 0u);
  EXPECT_DOUBLE_EQ(info.peak_force_n, 12);
  EXPECT_LT(info.continuous_force_n, info.peak_force_n);
  EXPECT_DOUBLE_EQ(info.peak_torque_nm, 0);
  EXPECT_DOUBLE_EQ(info.max_stiffness_n_per_m, 5000);
  EXPECT_DOUBLE_EQ(info.workspace_min_m[1], -0.075);
  driver_.close();
  set_("type", 999);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_DOUBLE_EQ(info.peak_force_n, 8);
  EXPECT_DOUBLE_EQ(info.workspace_max_m[0], 0);  // not known
}

TEST_F(DhdDriver, ReadsTheVendorsAxesAsThoseOfD) {
  set_("type", 35);
  ASSERT_EQ(open(), "");
  set_("x", 0.01);
  set_("y", 0.02);
  set_("z", 0.03);
  set_("turn_about_z", 0.5);
  set_("buttons", 5);
  ASSERT_EQ(read(), "");
  EXPECT_DOUBLE_EQ(state_.position_m[0], 0.02);
  EXPECT_DOUBLE_EQ(state_.position_m[1], 0.03);
  EXPECT_DOUBLE_EQ(state_.position_m[2], 0.01);
  EXPECT_NEAR(state_.orientation_wxyz[0], std::cos(0.25), 1e-12);
  EXPECT_NEAR(state_.orientation_wxyz[1], 0, 1e-12);
  EXPECT_NEAR(state_.orientation_wxyz[2], std::sin(0.25), 1e-12);  // its z is up, and so is our y
  EXPECT_NEAR(state_.orientation_wxyz[3], 0, 1e-12);
  EXPECT_EQ(state_.buttons, 5u);
  EXPECT_LT(state_.temperature, 0);
  EXPECT_TRUE(ready());
}

TEST_F(DhdDriver, AModelWithoutWristHasNoOrientation) {
  ASSERT_EQ(open(), "");
  set_("turn_about_z", 0.5);
  ASSERT_EQ(read(), "");
  EXPECT_DOUBLE_EQ(state_.orientation_wxyz[0], 1);
}

TEST_F(DhdDriver, RendersAForceInTheVendorsAxesAndTheModelsRange) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  ASSERT_EQ(push(1, 2, 3), "");
  EXPECT_DOUBLE_EQ(get_("fx"), 3);
  EXPECT_DOUBLE_EQ(get_("fy"), 1);
  EXPECT_DOUBLE_EQ(get_("fz"), 2);
  ASSERT_EQ(push(30, 40, 0), "");
  EXPECT_NEAR(get_("fy"), 12 * 0.6, 1e-12);
  EXPECT_NEAR(get_("fz"), 12 * 0.8, 1e-12);
  ASSERT_EQ(push(1, kDhdNan, 1), "");
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("fy"), 0);
  EXPECT_EQ(get_("fz"), 0);
}

TEST_F(DhdDriver, TheLibrarysOwnLimitComesBeforeTheTables) {
  set_("max_force", 5);
  ASSERT_EQ(open(), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_DOUBLE_EQ(info.peak_force_n, 5);
  ASSERT_EQ(read(), "");
  ASSERT_EQ(push(7, 0, 0), "");
  EXPECT_DOUBLE_EQ(get_("fy"), 5);
}

TEST_F(DhdDriver, RendersATorqueWhereTheModelHasOne) {
  set_("type", 104);
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  mechane_device_force force{};
  force.force_n[0] = 1;
  force.torque_nm[1] = 0.1;
  ASSERT_EQ(driver_.write(force), "");
  EXPECT_DOUBLE_EQ(get_("fy"), 1);
  EXPECT_DOUBLE_EQ(get_("tz"), 0.1);
  EXPECT_EQ(get_("grip"), 0);
  force.torque_nm[1] = 3;
  ASSERT_EQ(driver_.write(force), "");
  EXPECT_DOUBLE_EQ(get_("tz"), 0.2);
}

TEST_F(DhdDriver, TooEarlyAndSaturatedAreNoFaults) {
  for (const double result : {1.0, 2.0}) {
    set_("result", result);
    ASSERT_EQ(open(), "");
    EXPECT_EQ(read(), "");
    EXPECT_TRUE(ready());
    EXPECT_EQ(push(1, 0, 0), "");
    driver_.close();
  }
}

TEST_F(DhdDriver, DoesNotMoveTheArmUnlessItIsToldTo) {
  set_("initialised", 0);
  ASSERT_EQ(open(), "");
  EXPECT_EQ(get_("auto_inits"), 0);
  EXPECT_EQ(get_("force_on"), 0);
  ASSERT_EQ(read(), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_UNCALIBRATED);
  ASSERT_EQ(push(1, 1, 1), "");
  EXPECT_EQ(get_("fx"), 0);
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_NE(std::string(info.name).find("auto_init"), std::string::npos) << info.name;
  set_("initialised", 1);  // somebody has moved it to its zero
  ASSERT_EQ(look(), "");
  ASSERT_EQ(look(), "");
  EXPECT_TRUE(ready());
  EXPECT_EQ(get_("auto_inits"), 0);
}

TEST_F(DhdDriver, MovesTheArmToItsZeroWhenItIsToldTo) {
  set_("initialised", 0);
  ASSERT_EQ(open(",auto_init=yes"), "");
  EXPECT_EQ(get_("auto_inits"), 1);
  EXPECT_EQ(get_("regulates"), 0);
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
  driver_.close();
  ASSERT_EQ(open(",auto_init=yes"), "");
  EXPECT_EQ(get_("auto_inits"), 1);  // it knows its zero already
  driver_.close();
  set_("initialised", 0);
  set_("auto_init_fails", 1);
  EXPECT_NE(open(",auto_init=yes"), "");
  EXPECT_EQ(get_("open"), 0);
}

TEST_F(DhdDriver, SkipsImpossiblePositionsAndGivesUpWhenTheyGoOn) {
  set_("type", 35);
  ASSERT_EQ(open(), "");
  set_("y", 0.02);
  ASSERT_EQ(read(), "");
  for (const auto& [what, wrong, right] :
       {std::array<const char*, 3>{"x", "nan", "0"}, {"y", "50", "0.02"}, {"no_rotation", "1", "0"}}) {
    set_(what, std::stod(wrong));
    EXPECT_EQ(read(), "") << what;
    EXPECT_FALSE(ready()) << what;
    EXPECT_DOUBLE_EQ(state_.position_m[0], 0.02) << what;
    set_(what, std::stod(right));
    EXPECT_EQ(read(), "") << what;
    EXPECT_TRUE(ready()) << what;
  }
  set_("x", kDhdNan);
  EXPECT_TRUE(comes([this] { return !last_fault_.empty(); }));
}

TEST_F(DhdDriver, ADeviceThatIsGoneIsAFault) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  set_("absent", 1);
  EXPECT_NE(read(), "");
  EXPECT_NE(push(1, 0, 0).find("fake: no device"), std::string::npos);
  set_("absent", 0);
  set_("error", 1);
  EXPECT_NE(look(), "");
  set_("error", 0);
  set_("force_off_cause", 5);
  EXPECT_NE(look(), "");
}

TEST_F(DhdDriver, AReleasedDeadManSwitchIsTold) {
  ASSERT_EQ(open(), "");
  const double enables = get_("enables");
  rest();
  set_("force_off_cause", 6);
  ASSERT_EQ(look(), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_DEAD_MAN);
  set_("force_off_cause", 1);
  ASSERT_EQ(look(), "");
  EXPECT_EQ(state_.flags, 0u);
  set_("force_off_cause", 0);
  ASSERT_EQ(look(), "");
  EXPECT_EQ(state_.flags, MECHANE_STATE_READY);
  EXPECT_EQ(get_("enables"), enables);  // a person has switched it on again
}

TEST_F(DhdDriver, SwitchesTheForceOnAgainAfterAHandThatWasTooFast) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  const double enables = get_("enables");
  rest();
  ASSERT_EQ(push(1, 0, 0), "");
  set_("force_off_cause", 2);
  ASSERT_EQ(look(), "");
  EXPECT_FALSE(ready());
  EXPECT_EQ(get_("enables"), enables);
  ASSERT_EQ(push(1, 0, 0), "");  // not ready: no force is rendered
  EXPECT_EQ(get_("fy"), 0);
  EXPECT_TRUE(comes([this] { return ready(); }));
  EXPECT_EQ(get_("enables"), enables + 1);
}

TEST_F(DhdDriver, ClosesWithoutForce) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  ASSERT_EQ(push(1, 2, 3), "");
  driver_.close();
  EXPECT_EQ(get_("fx"), 0);
  EXPECT_EQ(get_("force_on"), 0);
  EXPECT_EQ(get_("open"), 0);
  EXPECT_EQ(get_("misuse"), 0);
}

TEST_F(DhdDriver, SaysWhatDoesNotOpen) {
  EXPECT_EQ(open(",device=1"), "");
  EXPECT_EQ(get_("index"), 1);
  driver_.close();
  EXPECT_NE(open(",device=2").find("device 2"), std::string::npos);
  EXPECT_NE(open(",auto_init=perhaps"), "");
  EXPECT_NE(driver_.open("library=no_such_library.so").find("no_such_library.so"), std::string::npos);
  EXPECT_NE(driver_.open("library=libm.so.6").find("drdOpenID"), std::string::npos);
  set_("result", -1);
  EXPECT_NE(open(), "");
  set_("result", 0);
  EXPECT_EQ(get_("open"), 0);
}

TEST(DhdAxes, ThereAndBackIsTheSame) {
  const std::array<double, 3> v = {1, 2, 3};
  EXPECT_EQ(drivers::dhd::from_d(drivers::dhd::to_d(v)), v);
  EXPECT_EQ(drivers::dhd::to_d(std::array<double, 3>{1, 0, 0}), (std::array<double, 3>{0, 0, 1}));  // to the user
  EXPECT_EQ(drivers::dhd::to_d(std::array<double, 3>{0, 1, 0}), (std::array<double, 3>{1, 0, 0}));  // to the right
  EXPECT_EQ(drivers::dhd::to_d(std::array<double, 3>{0, 0, 1}), (std::array<double, 3>{0, 1, 0}));  // up
}

TEST(DhdAxes, ATurnAboutAnAxisIsTheTurnAboutItsImage) {
  constexpr double kCosine = 0.8, kSine = 0.6;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    double m[3][3] = {};
    m[axis][axis] = 1;
    m[u][u] = m[v][v] = kCosine;
    m[v][u] = kSine;
    m[u][v] = -kSine;
    std::array<double, 3> about{};
    about[axis] = 1;
    about = drivers::dhd::to_d(about);
    std::array<double, 4> q{};
    ASSERT_TRUE(drivers::dhd::orientation_to_d(m, q));
    EXPECT_NEAR(q[0], std::sqrt((1 + kCosine) / 2), 1e-12);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(q[i + 1], about[i] * std::sqrt((1 - kCosine) / 2), 1e-12);
  }
}

TEST(DhdVectors, AForceKeepsItsDirectionWhenItIsLimited) {
  EXPECT_EQ(drivers::limited(std::array<double, 3>{3, 0, 4}, 5), (std::array<double, 3>{3, 0, 4}));
  EXPECT_EQ(drivers::limited(std::array<double, 3>{6, 0, 8}, 5), (std::array<double, 3>{3, 0, 4}));
  EXPECT_EQ(drivers::limited(std::array<double, 3>{6, 0, 8}, 0), (std::array<double, 3>{}));
  EXPECT_EQ(drivers::limited(std::array<double, 3>{std::numeric_limits<double>::infinity(), 0, 8}, 5),
            (std::array<double, 3>{}));
}

}  // namespace
}  // namespace mechane::test
