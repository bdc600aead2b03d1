#include "client-sdk/gateway/playback.hpp"

#include <cstring>

#include <gtest/gtest.h>

namespace mechane::gateway {
namespace {

FrameBody frame_at(std::uint64_t tick, std::size_t bytes) {
  FrameBody frame;
  frame.tick = tick;
  frame.sequence = tick;
  frame.bytes.resize(bytes, std::byte{7});
  return frame;
}

struct Part {
  std::uint32_t kind = 0;
  std::string payload;
};

std::vector<Part> parts_of(const std::string& tape) {
  std::vector<Part> parts;
  for (std::size_t at = 0; at < tape.size();) {
    std::uint32_t head[2];
    std::memcpy(head, tape.data() + at, sizeof head);
    parts.push_back({head[0], tape.substr(at + 8, head[1])});
    EXPECT_EQ(parts.back().payload.size(), head[1]);
    at += 8 + (head[1] + 3) / 4 * 4;
  }
  return parts;
}

TEST(Tape, HasTextsAndFramesInTheirOrderEachOnFourBytes) {
  TapeWriter writer;
  writer.add_text(R"({"type":"world"})");
  writer.add_frame(frame_at(1000, 17));
  writer.add_text("{}");
  writer.add_frame(frame_at(1500, 16));
  EXPECT_EQ(writer.frames(), 2U);
  EXPECT_EQ(writer.ticks(), 500U);
  const std::vector<Part> parts = parts_of(writer.take());
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0].payload, R"({"type":"world"})");
  EXPECT_EQ(parts[1].kind, 2U);
  EXPECT_EQ(parts[1].payload.size(), kFrameHeader + 17);
  std::uint64_t tick = 0;
  std::memcpy(&tick, parts[3].payload.data() + 16, sizeof tick);
  EXPECT_EQ(tick, 1500U);
  EXPECT_EQ(parts[2].kind, 1U);
}

TEST(Tape, EndsWhereItIsFullAndStaysWhole) {
  TapeWriter writer;
  std::size_t added = 0;
  for (; writer.goes_on() && added < 100; ++added)
    writer.add_frame(frame_at(added, std::size_t{4} << 20U));
  EXPECT_FALSE(writer.goes_on());
  EXPECT_EQ(writer.frames(), added - 1);
  writer.add_text("{}");
  const std::string tape = writer.take();
  EXPECT_LE(tape.size(), TapeWriter::kMostBytes);
  EXPECT_EQ(parts_of(tape).size(), added - 1);
}

}  // namespace
}  // namespace mechane::gateway
