#include "client-sdk/gateway/browsers/asked_devices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/error_like.hpp"

namespace mechane::gateway {
namespace {

TEST(DeviceOrder, NamesAHandAnActionAndAPlace) {
  const auto test = parse_device_order(R"({"user": 3, "action": "test"})");
  ASSERT_TRUE(test) << test.error().to_string();
  EXPECT_EQ(test->user, 3U);
  EXPECT_EQ(test->action, client::DeviceAction::test);
  const auto place = parse_device_order(
      R"({"user": 0, "action": "place", "place": {"center_m": [0.25, 1.5, -0.75], "turn_rad": 0.5, "scale": 2}})");
  ASSERT_TRUE(place) << place.error().to_string();
  EXPECT_EQ(place->action, client::DeviceAction::place);
  EXPECT_EQ(place->place.p_WD, Vec3(0.25, 1.5, -0.75));
  EXPECT_EQ(place->place.turn_rad, 0.5);
  EXPECT_EQ(place->place.scale, 2);
}

class BadDeviceOrder : public testing::TestWithParam<const char*> {};

TEST_P(BadDeviceOrder, IsRefusedWithARemedy) {
  const auto read = parse_device_order(GetParam());
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error(), test::is_error(ErrorCode::invalid_value, 0));
}

INSTANTIATE_TEST_SUITE_P(
    Orders, BadDeviceOrder,
    testing::Values(
        "", "[]", R"({"action": "test"})", R"({"user": 4, "action": "test"})", R"({"user": -1, "action": "test"})",
        R"({"user": 0, "action": "dance"})", R"({"user": 0, "action": "place"})",
        R"({"user": 0, "action": "test", "place": {}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [0, 1], "turn_rad": 0, "scale": 1}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [0, 1, 0], "turn_rad": 0, "scale": 0.5}})",
        R"({"user": 0, "action": "place", "place": {"center_m": [0, 1e9, 0], "turn_rad": 0, "scale": 1}})"));

}  // namespace
}  // namespace mechane::gateway
