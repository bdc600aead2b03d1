#include "client-sdk/haptic/driver.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/driver_trace.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::haptic {
namespace {

using test::DriverTrace;

std::string file_of(const std::string& name) {
  return MECHANE_TEST_DRIVERS "/mechane_driver_" + name + ".so";
}

ErrorCode code_of_loading(const std::string& name) {
  const auto driver = Driver::load(name);
  EXPECT_FALSE(driver) << name;
  return driver ? ErrorCode::cancelled : driver.error().code;
}

Driver fake() {
  auto driver = Driver::load(file_of("fake"));
  EXPECT_TRUE(driver) << (driver ? "" : driver.error().to_string());
  return std::move(*driver);
}

TEST(DriverName, HasItsOptionsBehindAColon) {
  EXPECT_EQ(parse_device_name("falcon").driver, "falcon");
  EXPECT_EQ(parse_device_name("falcon").options, "");
  EXPECT_EQ(parse_device_name("haply:host=a:1,key=vector").driver, "haply");
  EXPECT_EQ(parse_device_name("haply:host=a:1,key=vector").options, "host=a:1,key=vector");
}

TEST(DriverLoading, RefusesWhatIsNoDriverOfAKnownVersion) {
  EXPECT_EQ(code_of_loading("nobody-has-this"), ErrorCode::not_found);
  EXPECT_EQ(code_of_loading(file_of("later")), ErrorCode::wrong_version);
  EXPECT_EQ(code_of_loading(file_of("none")), ErrorCode::damaged);
  const test::ScratchFolder folder;
  EXPECT_EQ(code_of_loading(folder.write("mechane_driver_text.so", "text").string()), ErrorCode::damaged);
}

TEST(DriverLoading, TakesADriverThatWasBuiltBeforeHandsHadSides) {
  auto driver = Driver::load(file_of("first"));
  ASSERT_TRUE(driver) << driver.error().to_string();
  const auto info = driver->open("");
  ASSERT_TRUE(info) << info.error().to_string();
  EXPECT_EQ(info->side, MECHANE_HAND_RIGHT);
  mechane_device_state state;
  ASSERT_TRUE(driver->read(state));
  EXPECT_EQ(state.palm_m, 0);
}

TEST(DriverDevice, ThatMeasuresAHandWhichNobodyHasIsFaulty) {
  Driver driver = fake();
  mechane_device_state state;
  ASSERT_TRUE(driver.open("palm=0.08"));
  EXPECT_TRUE(driver.read(state));
  driver.close();
  ASSERT_TRUE(driver.open("palm=80"));
  EXPECT_FALSE(driver.read(state));
  EXPECT_EQ(driver.why(), "read() gave palm_m = 80, and not 0.02 to 0.25");
}

TEST(DriverLoading, FindsDriversInTheFoldersThatAreNamed) {
  ::setenv("MECHANE_DRIVERS", MECHANE_TEST_DRIVERS, 1);
  const std::vector<FoundDriver> found = find_drivers();
  const auto by_name = Driver::load("fake");
  ::unsetenv("MECHANE_DRIVERS");
  EXPECT_TRUE(by_name);
  const auto named = [&](const std::string& name) {
    return std::find_if(found.begin(), found.end(), [&](const FoundDriver& d) { return d.name == name; });
  };
  ASSERT_NE(named("fake"), found.end());
  EXPECT_EQ(named("fake")->fault, "");
  EXPECT_NE(named("fake")->summary, "");
  ASSERT_NE(named("later"), found.end());
  EXPECT_NE(named("later")->fault, "");
}

TEST(DriverDevice, ThatIsAbsentSaysWhy) {
  Driver driver = fake();
  const auto opened = driver.open("fault=absent");
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().what.find("plug it in"), std::string::npos);
}

TEST(DriverDevice, ThatIsNullSaysSo) {
  Driver driver = fake();
  const auto opened = driver.open("fault=null");
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().what.find("left *device NULL"), std::string::npos);
}

TEST(DriverDevice, WithAbsurdLimitsIsRefused) {
  Driver driver = fake();
  const auto opened = driver.open("fault=limits");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::invalid_value);
}

TEST(DriverDevice, ThatGivesANumberThatIsNoneIsFaulty) {
  Driver driver = fake();
  ASSERT_TRUE(driver.open("fault=nan,after=3"));
  mechane_device_state state;
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(driver.read(state));
  EXPECT_FALSE(driver.read(state));
  EXPECT_EQ(driver.why(), "read() gave position_m[0] = nan");
}

TEST(DriverDevice, WithoutARotationIsFaulty) {
  Driver driver = fake();
  ASSERT_TRUE(driver.open("fault=no_rotation"));
  mechane_device_state state;
  EXPECT_FALSE(driver.read(state));
  EXPECT_EQ(driver.why(), "read() gave orientation_wxyz of length 0, and not 1");
}

TEST(DriverDevice, IsNeverGivenMoreThanItBears) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "trace";
  Driver driver = fake();
  const auto info = driver.open("trace=" + file.string());
  ASSERT_TRUE(info);
  for (const double force_n : {1.0, 50.0, 1e300, double(INFINITY), double(NAN)})
    EXPECT_TRUE(driver.write({.force_n = {0, force_n, 0}, .torque_nm = {NAN, 1, 1}, .finger_n = {-1, NAN, 9, 0, 0}}));
  driver.close();
  const DriverTrace trace = DriverTrace::read(file);
  ASSERT_EQ(trace.forces.size(), 5u);
  EXPECT_EQ(trace.forces[0].force_n, 1);
  EXPECT_DOUBLE_EQ(trace.forces[1].force_n, info->peak_force_n);
  for (std::size_t i = 2; i < 5; ++i)
    EXPECT_LE(std::abs(trace.forces[i].force_n), info->peak_force_n * (1 + 1e-12));
  EXPECT_EQ(trace.forces[4].force_n, 0);
  EXPECT_EQ(trace.closed, 1);
}

}  // namespace
}  // namespace mechane::haptic
