#include "server/record/lane.hpp"

#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "server/record/journal_reader.hpp"
#include "tests/unit/record/journal_generators.hpp"

namespace mechane::record {
namespace {

namespace fs = std::filesystem;

void push_ticks(Lane& lane, std::uint64_t begin, std::uint64_t end) {
  for (WorldTick tick{begin, {}, {}, {}}; tick.tick < end; ++tick.tick)
    lane.push(tick.record());
}

// What waits in the ring was once counted as lost, and was then stored after all.
TEST(Lane, WhatStillWaitsIsNotLost) {
  const fs::path folder = fs::path(testing::TempDir()) / ("lane-" + std::to_string(getpid()));
  Lane lane(a_header(), folder / "a.journal", folder / "a.snapshot", 1U << 16U, 64, Duration{0});
  push_ticks(lane, 0, 8);
  lane.drain(TimePoint{});  // into a folder that is not there
  EXPECT_FALSE(lane.ok());
  push_ticks(lane, 8, 10);
  EXPECT_EQ(lane.ticks_lost(), 8U);

  ASSERT_TRUE(fs::create_directory(folder));
  lane.finish(TimePoint{}, {}, false);
  EXPECT_TRUE(lane.ok()) << lane.problem();
  EXPECT_EQ(lane.ticks_lost(), 8U);
  auto reader = JournalReader::open_file(folder / "a.journal");
  ASSERT_TRUE(reader.has_value()) << reader.error().to_string();
  std::vector<std::uint64_t> read;
  for (JournalTick tick; reader->next(tick);)
    read.push_back(tick.tick);
  EXPECT_EQ(read, (std::vector<std::uint64_t>{8, 9}));
  EXPECT_EQ(reader->end().lost_ticks, 8U);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace mechane::record
