#include "client-sdk/gateway/http/frame_bytes.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "server/base/byte_order.hpp"

namespace mechane::gateway {
namespace {

float float_of(ByteSource& source) {
  return std::bit_cast<float>(source.get<std::uint32_t>());
}

TEST(FrameBytes, AreAsTheManualSays) {
  client::Frame frame;
  frame.sequence = 9;
  frame.tick = 12'000;
  frame.received = TimePoint(std::chrono::seconds(5));
  frame.bodies = {{1, {Vec3(1, 2, 3), Quat::Identity()}}, {0, {Vec3(4, 5, 6), Quat(0, 1, 0, 0)}}};
  frame.visible = {0, 1};
  frame.quantities = {2.5};
  frame.hands.resize(2);
  frame.hands[0].user = 3;
  frame.hands[0].holding = true;
  frame.hands[1].kind = client::HandKind::glove;
  frame.ropes = {{0.25, {Vec3(7, 8, 9)}}};
  const FrameBody body = encode_frame(frame);

  const auto header = frame_header(body, 4, TimePoint(std::chrono::milliseconds(5020)));
  ByteSource head{std::span<const std::byte>(header)};
  EXPECT_EQ(head.get<std::uint8_t>(), 1);
  EXPECT_EQ(head.get<std::uint8_t>(), 1);
  EXPECT_EQ(head.get<std::uint16_t>(), 50'200);
  EXPECT_EQ(head.get<std::uint32_t>(), 4U);
  EXPECT_EQ(head.get<std::uint64_t>(), 9U);
  EXPECT_EQ(head.get<std::uint64_t>(), 12'000U);
  EXPECT_NEAR(std::bit_cast<double>(head.get<std::uint64_t>()), 0.02, 1e-12);
  EXPECT_EQ(head.remaining(), 0U);

  ByteSource source(body.bytes);
  for (const std::uint32_t count : {2U, 1U, 2U, 1U})
    EXPECT_EQ(source.get<std::uint32_t>(), count);
  EXPECT_EQ(source.get<std::uint32_t>(), 1U);
  EXPECT_EQ(source.get<std::uint32_t>(), 1U) << "visible";
  for (const float value : {1.F, 2.F, 3.F, 0.F, 0.F, 0.F, 1.F})
    EXPECT_EQ(float_of(source), value);
  EXPECT_EQ(source.get<std::uint32_t>(), 0U);
  EXPECT_EQ(source.get<std::uint32_t>(), 0U) << "hidden";
  for (const float value : {4.F, 5.F, 6.F, 1.F, 0.F, 0.F, 0.F})
    EXPECT_EQ(float_of(source), value);
  EXPECT_EQ(float_of(source), 2.5F);
  for (const std::size_t segments : {std::size_t{1}, client::kHandSegments}) {
    const bool first = segments == 1;
    EXPECT_EQ(source.get<std::uint8_t>(), first ? 3 : 0);
    EXPECT_EQ(source.get<std::uint8_t>(), first ? 0 : 1);
    EXPECT_EQ(source.get<std::uint8_t>(), 0);
    EXPECT_EQ(source.get<std::uint8_t>(), first ? 1 : 0);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(float_of(source), 0.F);
    EXPECT_EQ(source.get<std::uint32_t>(), segments);
    for (std::size_t k = 0; k < 7 * segments; ++k)
      (void)float_of(source);
  }
  EXPECT_EQ(float_of(source), 0.25F);
  EXPECT_EQ(source.get<std::uint32_t>(), 1U);
  for (const float value : {7.F, 8.F, 9.F})
    EXPECT_EQ(float_of(source), value);
  EXPECT_TRUE(source.ok());
  EXPECT_EQ(source.remaining(), 0U);
}

}  // namespace
}  // namespace mechane::gateway
