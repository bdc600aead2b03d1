#include "server/record/journal.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/record/tick_codec.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/unit/record/journal_generators.hpp"

namespace mechane::record {
namespace {

using Kind = JournalEnd::Kind;
using test::is_error;

JournalReader open(const std::vector<std::byte>& bytes) {
  auto reader = JournalReader::open_bytes(bytes, "test.journal");
  EXPECT_TRUE(reader.has_value()) << (reader ? "" : reader.error().to_string());
  return std::move(*reader);
}

RC_GTEST_PROP(Journal, GivesBackTheSameBits, ()) {
  JournalHeader header = a_header(*rc::gen::arbitrary<std::uint32_t>());
  header.snapshot = *rc::gen::map(rc::gen::arbitrary<std::vector<std::uint8_t>>(), [](const auto& v) {
    std::vector<std::byte> bytes;
    for (const auto b : v)
      bytes.push_back(std::byte{b});
    return bytes;
  });
  JournalWriter writer(header);
  std::vector<WorldTick> world;
  const int count = *rc::gen::inRange(0, 30);
  for (int i = 0; i < count; ++i) {
    world.push_back(any_tick(header.first_tick + static_cast<std::uint64_t>(i)));
    writer.add(world.back().record());
    if (*rc::gen::inRange(0, 4) == 0) writer.flush();
  }
  writer.close(42);

  JournalReader reader = open(writer.take_bytes());
  RC_ASSERT(reader.header().scenario_hash == header.scenario_hash);
  RC_ASSERT(reader.header().start_wall_ns == header.start_wall_ns);
  RC_ASSERT(reader.header().snapshot == header.snapshot);
  const std::vector<JournalTick> read = read_all(reader);
  RC_ASSERT(read.size() == world.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    RC_ASSERT(same(world[i], read[i]));
  RC_ASSERT(reader.end().kind == Kind::closed);
  RC_ASSERT(reader.end().hash == std::optional<std::uint64_t>(42));
  RC_ASSERT(reader.end().ticks == world.size());
  RC_ASSERT(!reader.end().first_lost);
}

// A plain visit: three frames, with an idle stretch, a loss and a close.
struct Sample {
  std::vector<WorldTick> world;
  std::vector<std::byte> bytes;
  std::vector<std::size_t> frame_ends;  // offsets at which the file is whole so far
};

Sample a_journal() {
  Sample out;
  JournalWriter writer(a_header());
  const auto take = [&] {
    const auto bytes = writer.take_bytes();
    out.bytes.insert(out.bytes.end(), bytes.begin(), bytes.end());
    out.frame_ends.push_back(out.bytes.size());
  };
  take();
  for (std::uint64_t n = 0; n < 9; ++n) {
    WorldTick tick;
    tick.tick = n;
    state::UserInput& user = tick.inputs.users[1];
    user.present = n != 4;
    user.fresh = user.present && n % 2 == 0;
    user.age = std::chrono::microseconds(137 * n);
    if (!user.present) user.age = Duration{0};
    user.sample.session = 77;
    user.sample.sequence = n;
    user.sample.X_WH.p.x() = 0.1 * static_cast<double>(n);
    if (n == 5) tick.events.push_back({n, state::EventKind::touched, 1, 2, 0.5});
    writer.add(tick.record());
    out.world.push_back(tick);
    if (n % 3 != 2) continue;
    writer.flush();
    take();
  }
  writer.close(4711);
  take();
  return out;
}

TEST(Journal, CutAnywhereItGivesEverythingBeforeAndSaysWhere) {
  const Sample journal = a_journal();
  for (std::size_t size = 0; size < journal.bytes.size(); ++size) {
    const auto reader = JournalReader::open_bytes(std::span(journal.bytes).first(size), "cut");
    if (size < journal.frame_ends[0]) {
      EXPECT_FALSE(reader.has_value()) << size;
      continue;
    }
    JournalReader r = open({journal.bytes.begin(), journal.bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    const auto read = read_all(r);
    const auto whole = std::upper_bound(journal.frame_ends.begin(), journal.frame_ends.end(), size) - 1;
    EXPECT_EQ(r.end().kind, Kind::cut_off) << size;
    EXPECT_EQ(r.end().offset, *whole) << size;
    EXPECT_THAT(r.end().message, testing::HasSubstr("breaks off"));
    ASSERT_EQ(read.size(), 3 * static_cast<std::size_t>(whole - journal.frame_ends.begin())) << size;
    for (std::size_t i = 0; i < read.size(); ++i)
      EXPECT_TRUE(same(journal.world[i], read[i]));
  }
}

TEST(Journal, EveryFlippedBitIsFoundAndWhatComesBeforeItIsGood) {
  const Sample journal = a_journal();
  for (std::size_t at = 0; at < journal.bytes.size(); ++at) {
    auto bytes = journal.bytes;
    bytes[at] ^= std::byte{static_cast<std::uint8_t>(1u << (at % 8))};
    auto reader = JournalReader::open_bytes(bytes, "flipped");
    if (at < journal.frame_ends[0]) {
      EXPECT_FALSE(reader.has_value()) << at;
      continue;
    }
    ASSERT_TRUE(reader.has_value());
    const auto read = read_all(*reader);
    EXPECT_NE(reader->end().kind, Kind::closed) << "the flip at byte " << at << " went unseen";
    EXPECT_LE(reader->end().offset, at);
    ASSERT_LE(read.size(), journal.world.size());
    for (std::size_t i = 0; i < read.size(); ++i)
      EXPECT_TRUE(same(journal.world[i], read[i])) << at;
  }
}

TEST(Journal, AMissingOrMovedFrameIsFound) {
  const Sample journal = a_journal();
  auto bytes = journal.bytes;
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(journal.frame_ends[0]),
              bytes.begin() + static_cast<std::ptrdiff_t>(journal.frame_ends[1]));
  JournalReader reader = open(bytes);
  EXPECT_TRUE(read_all(reader).empty());
  EXPECT_EQ(reader.end().kind, Kind::damaged);

  bytes = journal.bytes;
  bytes.push_back(std::byte{0});
  reader = open(bytes);
  EXPECT_EQ(read_all(reader).size(), 9u);
  EXPECT_EQ(reader.end().kind, Kind::damaged) << "bytes behind the close";
}

TEST(Journal, ALossIsMarkedAndWhatFollowsIsForPeopleOnly) {
  JournalWriter writer(a_header(100));
  WorldTick tick;
  tick.inputs.users[0].present = true;
  for (const std::uint64_t n : {100u, 101u, 105u, 106u}) {
    tick.tick = n;
    writer.add(tick.record());
  }
  writer.close(7, 110);
  JournalReader reader = open(writer.take_bytes());
  std::vector<std::uint64_t> numbers;
  std::vector<bool> after_loss;
  for (const JournalTick& t : read_all(reader)) {
    numbers.push_back(t.tick);
    after_loss.push_back(t.after_loss);
  }
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{100, 101, 105, 106}));
  EXPECT_EQ(after_loss, (std::vector<bool>{false, false, true, true}));
  EXPECT_EQ(reader.end().kind, Kind::closed);
  EXPECT_EQ(reader.end().first_lost, std::optional<std::uint64_t>(102));
  EXPECT_EQ(reader.end().lost_ticks, 6u);
}

TEST(Journal, WhatCouldNotBeStoredIsTakenBackAndBecomesALoss) {
  JournalWriter writer(a_header());
  WorldTick tick;
  tick.inputs.users[0].present = true;
  writer.add(tick.record());
  writer.flush();
  auto stored = writer.take_bytes();
  const auto position = writer.position();
  for (tick.tick = 1; tick.tick < 4; ++tick.tick)
    writer.add(tick.record());
  writer.flush();
  (void)writer.take_bytes();  // the disk was full
  writer.rewind(position);
  writer.add(tick.record());
  writer.close({});
  const auto rest = writer.take_bytes();
  stored.insert(stored.end(), rest.begin(), rest.end());
  JournalReader reader = open(stored);
  EXPECT_EQ(read_all(reader).size(), 2u);
  EXPECT_EQ(reader.end().kind, Kind::closed) << reader.end().message;
  EXPECT_EQ(reader.end().first_lost, std::optional<std::uint64_t>(1));
  EXPECT_EQ(reader.end().lost_ticks, 3u);
}

TEST(Journal, AnIdleWorldCostsNextToNothingAndAHandLittle) {
  JournalWriter writer(a_header());
  (void)writer.take_bytes();
  WorldTick tick;
  for (; tick.tick < 3'600'000; ++tick.tick)
    writer.add(tick.record());  // an hour
  writer.flush();
  EXPECT_LT(writer.take_bytes().size(), 200u);

  std::byte encoded[kMaxEncodedTick];
  state::UserInput& user = tick.inputs.users[0];
  user = {.present = true, .fresh = true, .age = std::chrono::microseconds(400), .sample = {}};
  user.sample.session = ~std::uint64_t{0};
  user.sample.sequence = 1'000'000;
  user.sample.sent_ns = 1'000'000'000'000;
  user.sample.X_WH = {Vec3(0.1, 0.2, 0.3), Quat(0.5, 0.5, 0.5, 0.5)};
  user.sample.V_WH.v = Vec3(0.1, 0.2, 0.3);
  EXPECT_LT(encode_tick(tick.record(), encoded), 150u);
}

TEST(Journal, TheLargestTickFitsAndEncodingAllocatesNothing) {
  WorldTick tick;
  tick.tick = 1;
  for (state::UserInput& user : tick.inputs.users) {
    user = {.present = true, .fresh = true, .age = Duration::min(), .sample = {}};
    user.sample.kind = hand::HandKind::glove;
    user.sample.session = user.sample.sequence = user.sample.sent_ns = ~std::uint64_t{0};
    user.sample.buttons = ~0u;
    user.sample.X_WH = {Vec3::Ones(), Quat(1, 1, 1, 1)};
    user.sample.V_WH = {Vec3::Ones(), Vec3::Ones()};
    user.sample.joints.fill(1);
    user.sample.grasp_intent = 1;
  }
  tick.inputs.command_count = state::kMaxCommandsPerTick;
  tick.inputs.commands.fill({~std::uint64_t{0}, state::CommandKind::next_step, ~0u});
  tick.events.assign(state::kMaxEventsPerTick, {1ull << 63, state::EventKind::touched, 0xfffffffeu, 0xfffffffeu, 1});
  tick.hash = 1;
  std::byte encoded[kMaxEncodedTick];
  const test::AllocationGuard guard;
  const std::size_t size = encode_tick(tick.record(), encoded);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_LE(size, kMaxEncodedTick);
  JournalTick out;
  out.tick = 1;
  ByteSource in(std::span(encoded, size));
  ASSERT_TRUE(decode_tick(in, out));
  EXPECT_EQ(in.remaining(), 0u);
  EXPECT_TRUE(same(tick, out));
}

TEST(Journal, AnotherVersionAndAnotherFileAreNamed) {
  auto bytes = a_journal().bytes;
  bytes[8] = std::byte{9};
  EXPECT_THAT(JournalReader::open_bytes(bytes, "x").error(),
              is_error(ErrorCode::wrong_version, 0, {"x: ", "version 9"}));
  bytes[0] = std::byte{'m'};
  EXPECT_THAT(JournalReader::open_bytes(bytes, "x").error(), is_error(ErrorCode::damaged, 0, {"x: ", "not a journal"}));
  EXPECT_THAT(JournalReader::open_file("/nowhere/at/all.journal").error(),
              is_error(ErrorCode::not_found, 0, {"/nowhere/at/all.journal"}));
}

}  // namespace
}  // namespace mechane::record
