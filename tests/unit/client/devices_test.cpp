// What staff and the programs of devices tell each other, over the wire's types.
#include <limits>

#include <gtest/gtest.h>

#include "client-sdk/client/device_parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

DeviceDetails good_details() {
  DeviceDetails details;
  details.limits = {1000, 3, 1, 0.5, 12, 600, Vec3(-0.25, -0.125, -0.5), Vec3(0.25, 0.125, 0.5)};
  details.place = {Vec3(0.5, 0.75, -1), 0.5, 2};
  details.rate_hz = 998;
  details.late_us = 250;
  details.p_WH = Vec3(1, 2, 3);
  details.force_n = 0.5;
  details.temperature = 0.25;
  details.testing = true;
  details.test_force_n = 0.75;
  details.test_energy_j = 0.125;
  details.answered = 7;
  details.refusal = "the hand holds something";
  return details;
}

proto::DeviceStatus on_wire(const DeviceDetails& details) {
  proto::DeviceStatus wire{};
  write(details, wire);
  proto::set_text(wire.kiosk, "kiosk-1");
  wire.protocol = proto::kProtocol;
  wire.user = 2;
  return wire;
}

TEST(DeviceDetails, come_out_of_the_wire_as_they_went_in) {
  const DeviceDetails sent = good_details();
  DeviceDetails out;
  ASSERT_TRUE(parse(on_wire(sent), out));
  EXPECT_EQ(out.user, 2U);
  EXPECT_EQ(out.limits.peak_force_n, 3);
  EXPECT_EQ(out.limits.max_stiffness_n_per_m, 600);
  EXPECT_EQ(out.limits.workspace_min_D_m, sent.limits.workspace_min_D_m);
  EXPECT_EQ(out.limits.workspace_max_D_m, sent.limits.workspace_max_D_m);
  EXPECT_EQ(out.place, sent.place);
  EXPECT_EQ(out.p_WH, sent.p_WH);
  EXPECT_EQ(out.temperature, 0.25);
  EXPECT_TRUE(out.testing);
  EXPECT_EQ(out.test_energy_j, 0.125);
  EXPECT_EQ(out.answered, 7U);
  EXPECT_EQ(out.refusal, sent.refusal);
}

TEST(DeviceDetails, with_a_number_that_no_device_has_are_refused) {
  const auto refused = [](auto spoil) {
    proto::DeviceStatus spoilt = on_wire(good_details());
    spoil(spoilt);
    DeviceDetails ignored;
    return !parse(spoilt, ignored);
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(refused([](proto::DeviceStatus&) {}));
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { s.protocol += 1; }));
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { proto::set_text(s.kiosk, "kiosk 1"); }));
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { s.user = hand::kMaxUsers; }));
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { s.rate_hz = -1; }));
  EXPECT_TRUE(refused([=](proto::DeviceStatus& s) { s.peak_force_n = kNan; }));
  EXPECT_TRUE(refused([=](proto::DeviceStatus& s) { s.temperature = kNan; }));
  EXPECT_TRUE(refused([=](proto::DeviceStatus& s) { s.p_WH[1] = kNan; }));
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { s.workspace_min_m[0] = 1; })) << "above its greatest";
  EXPECT_TRUE(refused([](proto::DeviceStatus& s) { s.place.scale = 0; }));
}

TEST(DeviceRequest, asks_for_what_a_device_does_and_for_nothing_else) {
  proto::DeviceRequest wire{};
  proto::set_text(wire.kiosk, "kiosk-1");
  wire.protocol = proto::kProtocol;
  wire.id = 9;
  wire.user = 1;
  wire.action = mechane_device_action_place;
  write(DevicePlace{Vec3(1, 2, 3), -1, 4}, wire.place);
  DeviceRequest out;
  ASSERT_TRUE(parse(wire, out));
  EXPECT_EQ(out.id, 9U);
  EXPECT_EQ(out.action, DeviceAction::place);
  EXPECT_EQ(out.place, (DevicePlace{Vec3(1, 2, 3), -1, 4}));
  const auto refused = [&wire](auto spoil) {
    proto::DeviceRequest spoilt = wire;
    spoil(spoilt);
    DeviceRequest ignored;
    return !parse(spoilt, ignored);
  };
  EXPECT_TRUE(refused([](proto::DeviceRequest& s) { s.id = 0; }));
  EXPECT_TRUE(refused([](proto::DeviceRequest& s) { s.user = hand::kMaxUsers; }));
  EXPECT_TRUE(refused([](proto::DeviceRequest& s) { s.action = mechane_device_action_end_test + 1; }));
  EXPECT_TRUE(refused([](proto::DeviceRequest& s) { s.place.p_WD[0] = 1000; }));
  EXPECT_FALSE(refused([](proto::DeviceRequest& s) {
    s.action = mechane_device_action_test;
    s.place.scale = 0;
  })) << "a test has no place";
}

}  // namespace
}  // namespace mechane::client
