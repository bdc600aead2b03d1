// The driver of the CyberGrasp against a stub of the museum's library (tests/support/fake_cybergrasp.cpp), and its
// conversions.
#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <string>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "client-sdk/drivers/cybergrasp/convert.hpp"
#include "tests/support/driver_on_fake.hpp"

namespace mechane::test {
namespace {

constexpr double kGraspNan = std::numeric_limits<double>::quiet_NaN();
using GraspPulls = std::array<double, 5>;

class CyberGraspDriver : public DriverOnFake {
 protected:
  CyberGraspDriver() : DriverOnFake("cybergrasp", "cybergrasp") {}
  void TearDown() override {
    DriverOnFake::TearDown();
    EXPECT_EQ(get_("misuse"), 0);
    EXPECT_EQ(get_("open"), 0);
  }

  std::string pull(const GraspPulls& finger_n) {
    mechane_device_force force{};
    std::copy(finger_n.begin(), finger_n.end(), force.finger_n);
    return driver_.write(force);
  }
  /// Reads and pulls until the glove does something: on a busy machine a hand may be of a while ago.
  std::string render(const GraspPulls& finger_n) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    std::string fault;
    do {
      fault = read();
      if (fault.empty()) fault = pull(finger_n);
    } while (fault.empty() && pulls() == GraspPulls{} && std::chrono::steady_clock::now() < deadline);
    return fault;
  }
  /// While the glove is read and pulled.
  template <class Condition>
  bool comes(const Condition& condition) {
    return DriverOnFake::comes(condition, [this] {
      fault_ = read();
      if (fault_.empty()) fault_ = pull({6, 6, 6, 6, 6});
    });
  }
  bool fault_comes() {
    return comes([this] { return !fault_.empty(); });
  }
  [[nodiscard]] GraspPulls pulls() const { return {get_("f0"), get_("f1"), get_("f2"), get_("f3"), get_("f4")}; }

  std::string fault_;
};

TEST_F(CyberGraspDriver, OpensInModeForceWithoutForce) {
  ASSERT_EQ(open(",host=grasp.museum"), "");
  EXPECT_EQ(get_("host"), 1);
  EXPECT_EQ(get_("mode"), 1);
  EXPECT_EQ(pulls(), GraspPulls{});
  EXPECT_GE(get_("sets"), 1);
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.hand, MECHANE_HAND_GLOVE);
  EXPECT_EQ(info.output, MECHANE_OUTPUT_FINGER_PULL);
  EXPECT_EQ(info.peak_finger_force_n, 12);
  EXPECT_EQ(info.side, MECHANE_HAND_RIGHT);
}

TEST_F(CyberGraspDriver, PullsInPartsOfItsFullForce) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
  ASSERT_EQ(render({6, 3, 0, 12, 1.2}), "");
  EXPECT_EQ(pulls(), (GraspPulls{0.5, 0.25, 0, 1, 1.2 / 12}));
  ASSERT_EQ(pull({}), "");
  ASSERT_EQ(render({-6, 30, kGraspNan, std::numeric_limits<double>::infinity(), 1e300}), "");
  EXPECT_EQ(pulls(), (GraspPulls{0, 1, 0, 0, 1}));
  driver_.close();
  ASSERT_EQ(open(",full=6,hand=left"), "");
  mechane_device_info info{};
  ASSERT_EQ(driver_.describe(info), "");
  EXPECT_EQ(info.peak_finger_force_n, 6);
  EXPECT_EQ(info.side, MECHANE_HAND_LEFT);
  ASSERT_EQ(render({3, 6, 0, 0, 0}), "");
  EXPECT_EQ(pulls(), (GraspPulls{0.5, 1, 0, 0, 0}));
}

TEST_F(CyberGraspDriver, ReadsTheAnglesAndThePlaceThatTheLibraryHas) {
  ASSERT_EQ(open(), "");
  set_("angle", 0.7);
  ASSERT_EQ(read(), "");
  EXPECT_EQ(state_.joints_rad[0], 0.7);
  EXPECT_EQ(state_.joints_rad[19], 0.7);
  EXPECT_GT(state_.grasp, 0.3);
  EXPECT_EQ(state_.position_m[0], 0);
  EXPECT_EQ(state_.orientation_wxyz[0], 1);
  set_("pose_comes", 1);
  set_("x", 0.3);
  set_("w", -1);
  ASSERT_EQ(read(), "");
  EXPECT_EQ(state_.position_m[0], 0.3);
  EXPECT_EQ(state_.orientation_wxyz[0], -1);
  EXPECT_TRUE(ready());
}

TEST_F(CyberGraspDriver, AModeThatAnotherProgramChangesStopsThePull) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(read(), "");
  ASSERT_EQ(pull({6, 6, 6, 6, 6}), "");
  set_("mode", 2);
  ASSERT_EQ(read(), "");
  EXPECT_FALSE(ready());
  const double sets = get_("sets");
  ASSERT_EQ(pull({6, 6, 6, 6, 6}), "");
  EXPECT_EQ(get_("sets"), sets);  // or the mode would be force again
  set_("mode", 1);
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
  set_("mode", 2);
  ASSERT_TRUE(fault_comes());
  EXPECT_NE(fault_.find("impedance"), std::string::npos) << fault_;
  EXPECT_EQ(get_("mode"), 2);
  driver_.close();
  EXPECT_EQ(pulls(), GraspPulls{});
}

TEST_F(CyberGraspDriver, SkipsAnglesThatAreNoneAndGivesUpWhenTheyGoOn) {
  ASSERT_EQ(open(), "");
  set_("angle", 0.5);
  ASSERT_EQ(read(), "");
  for (const double wrong : {kGraspNan, 90.0, -std::numeric_limits<double>::infinity()}) {  // 90: degrees
    set_("angle", wrong);
    ASSERT_EQ(read(), "");
    EXPECT_EQ(state_.joints_rad[3], 0.5);
  }
  ASSERT_TRUE(fault_comes());
  EXPECT_EQ(pulls(), GraspPulls{});  // a while before, for the hand was not of now
}

TEST_F(CyberGraspDriver, AnglesOrAPlaceThatStopComingAreAFault) {
  ASSERT_EQ(open(), "");
  set_("joints_come", 0);
  EXPECT_TRUE(fault_comes());
  driver_.close();
  fault_.clear();
  set_("joints_come", 1);
  set_("pose_comes", 1);
  ASSERT_EQ(open(), "");
  set_("w", 0.5);  // no rotation
  ASSERT_EQ(read(), "");
  EXPECT_EQ(state_.orientation_wxyz[0], 1);
  EXPECT_TRUE(fault_comes());
}

TEST_F(CyberGraspDriver, DoesWithoutAnglesWhenItIsTold) {
  set_("angle", kGraspNan);
  ASSERT_EQ(open(",joints=no"), "");
  ASSERT_EQ(read(), "");
  EXPECT_TRUE(ready());
  EXPECT_EQ(state_.joints_rad[3], 0);
  ASSERT_EQ(render({6, 0, 0, 0, 0}), "");
  EXPECT_EQ(get_("f0"), 0.5);
}

TEST_F(CyberGraspDriver, AGloveThatIsGoneOrLateIsAFault) {
  ASSERT_EQ(open(), "");
  set_("absent", 1);
  EXPECT_NE(read().find("fake: no glove"), std::string::npos);
  EXPECT_NE(pull({1, 0, 0, 0, 0}), "");
  set_("absent", 0);
  ASSERT_EQ(read(), "");
  set_("slow_ms", 110);
  EXPECT_NE(pull({1, 0, 0, 0, 0}), "");
  set_("slow_ms", 40);  // three calls
  EXPECT_NE(read(), "");
  set_("slow_ms", 0);
}

TEST_F(CyberGraspDriver, ClosesWithoutForceAndRewinds) {
  ASSERT_EQ(open(), "");
  ASSERT_EQ(render({6, 6, 6, 6, 6}), "");
  EXPECT_EQ(get_("f4"), 0.5);
  driver_.close();
  EXPECT_EQ(pulls(), GraspPulls{});
  EXPECT_EQ(get_("rewound"), 1);
}

TEST_F(CyberGraspDriver, SaysWhatDoesNotOpen) {
  EXPECT_NE(driver_.open("").find("shim.h"), std::string::npos);
  EXPECT_NE(driver_.open("library=no_such_library.so").find("no_such_library.so"), std::string::npos);
  EXPECT_NE(driver_.open("library=libm.so.6").find("mechane_grasp_open"), std::string::npos);
  EXPECT_NE(open(",full=0"), "");
  set_("version", 2);
  EXPECT_NE(open(), "");
  set_("version", 1);
  set_("absent", 1);
  EXPECT_NE(open().find("fake: no glove"), std::string::npos);
  set_("absent", 0);
  set_("stays_in_mode", 1);
  EXPECT_NE(open().find("rewind"), std::string::npos);
  EXPECT_EQ(pulls(), GraspPulls{});
}

TEST(CyberGraspConversions, KnowWhatAHandAndAPlaceAre) {
  std::array<double, 20> joints{};
  EXPECT_TRUE(drivers::cybergrasp::are_joints(joints));
  joints[19] = 3.1;
  EXPECT_TRUE(drivers::cybergrasp::are_joints(joints));
  for (const double wrong : {3.2, -3.2, kGraspNan}) {
    joints[19] = wrong;
    EXPECT_FALSE(drivers::cybergrasp::are_joints(joints));
  }
  using Place = std::array<double, 3>;
  using Turn = std::array<double, 4>;
  EXPECT_TRUE(drivers::cybergrasp::is_pose(Place{1, -2, 3}, Turn{0, 0.6, 0, -0.8}));
  EXPECT_FALSE(drivers::cybergrasp::is_pose(Place{1, -2, 300}, Turn{1, 0, 0, 0}));
  EXPECT_FALSE(drivers::cybergrasp::is_pose(Place{1, kGraspNan, 3}, Turn{1, 0, 0, 0}));
  EXPECT_FALSE(drivers::cybergrasp::is_pose(Place{1, 2, 3}, Turn{1, 0, 0.2, 0}));
  EXPECT_FALSE(drivers::cybergrasp::is_pose(Place{1, 2, 3}, Turn{1, kGraspNan, 0, 0}));
  EXPECT_EQ(drivers::cybergrasp::name_of_mode(4), "rewind");
  EXPECT_NE(drivers::cybergrasp::name_of_mode(77).find("77"), std::string::npos);
}

}  // namespace
}  // namespace mechane::test
