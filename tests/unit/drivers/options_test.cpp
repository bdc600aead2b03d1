#include "client-sdk/drivers/options.hpp"

#include <gtest/gtest.h>

namespace mechane::drivers {
namespace {

constexpr const char* kKnown = "port=FILE gain=NUMBER hand=left|right";

TEST(DriverOptions, AreReadByName) {
  Options options("port=/dev/ttyUSB0,gain=0.5,hand=right", kKnown);
  EXPECT_EQ(options.text("port", ""), "/dev/ttyUSB0");
  EXPECT_EQ(options.number("gain", 1, 0, 2), 0.5);
  EXPECT_EQ(options.choice("hand", {"left", "right"}), 1u);
  EXPECT_EQ(options.fault(), "");
}

TEST(DriverOptions, HaveValuesOfTheirOwnWhenTheyAreNotGiven) {
  Options options("", kKnown);
  EXPECT_EQ(options.text("port", "/dev/ttyACM0"), "/dev/ttyACM0");
  EXPECT_EQ(options.number("gain", 1, 0, 2), 1);
  EXPECT_EQ(options.choice("hand", {"left", "right"}), 0u);
  EXPECT_EQ(options.fault(), "");
}

TEST(DriverOptions, AreRefusedWhenMalformedUnknownOrGivenTwice) {
  for (const char* text : {"port", "=1", ",", "gain=0,5", "speed=1", "por=1", "gain=1,gain=2"})
    EXPECT_NE(Options(text, kKnown).fault(), "") << text;
}

TEST(DriverOptions, AreRefusedOutOfTheirRange) {
  for (const char* text : {"gain=2.1", "gain=-0.1", "gain=1x", "gain=", "gain=nan"}) {
    Options options(text, kKnown);
    EXPECT_EQ(options.number("gain", 1, 0, 2), 1) << text;
    EXPECT_NE(options.fault(), "") << text;
  }
  Options options("hand=both", kKnown);
  EXPECT_EQ(options.choice("hand", {"left", "right"}), 0u);
  EXPECT_NE(options.fault(), "");
}

}  // namespace
}  // namespace mechane::drivers
