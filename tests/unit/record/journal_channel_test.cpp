#include "server/record/journal_channel.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/record/journal_reader.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/record/journal_generators.hpp"

namespace mechane::record {
namespace {

void push_ticks(JournalChannel& channel, std::uint64_t begin, std::uint64_t end) {
  for (WorldTick tick{begin, {}, {}, {}}; tick.tick < end; ++tick.tick)
    channel.push(tick.record());
}

// Ticks in the ring were once counted as lost, although they were stored later.
TEST(JournalChannel, WhatStillWaitsIsNotLost) {
  const test::ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path() / "later";
  JournalChannel channel(a_header(), folder / "a.journal", folder / "a.snapshot", 1U << 16U, 64, Duration{0});
  push_ticks(channel, 0, 8);
  channel.drain(TimePoint{});  // into a folder that is not there
  EXPECT_FALSE(channel.ok());
  push_ticks(channel, 8, 10);
  EXPECT_EQ(channel.ticks_lost(), 8U);

  ASSERT_TRUE(std::filesystem::create_directory(folder));
  channel.finish(TimePoint{}, {}, false);
  EXPECT_TRUE(channel.ok()) << channel.problem();
  EXPECT_EQ(channel.ticks_lost(), 8U);
  auto reader = JournalReader::open_file(folder / "a.journal");
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  EXPECT_THAT(read_all(*reader),
              testing::ElementsAre(testing::Field(&JournalTick::tick, 8U), testing::Field(&JournalTick::tick, 9U)));
  EXPECT_EQ(reader->end().lost_ticks, 8U);
}

}  // namespace
}  // namespace mechane::record
