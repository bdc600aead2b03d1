// Journals of earlier releases: they still replay, compared over the fields that their release hashed.
#include <fstream>

#include <gtest/gtest.h>

#include "server/app/replay.hpp"
#include "server/record/journal_writer.hpp"
#include "server/state/snapshot.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/golden_machine.hpp"
#include "tests/support/scripted_hand.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane {
namespace {

const std::string kJournalOfVersion1 = (test::source_folder() / "tests/golden/version-1.journal").string();

world::WorldConfig crank_config() {
  world::WorldConfig config;
  config.hand = test::shared_hand();
  return config;
}

/// A hand on the crank's handle: it grasps, falls silent for 30 ms, comes back, leaves after 0.7 s, and comes again.
state::TickInputs inputs_of(std::uint64_t tick) {
  const test::ScriptedHand hand(Vec3(test::kCrankRadiusM, 0, 0), Pose{}, 5);
  state::TickInputs inputs;
  if (tick >= 700 && tick < 760) return inputs;
  inputs.users[0] = hand.sample(tick);
  if (tick >= 500 && tick < 530) {
    inputs.users[0] = hand.sample(499);
    inputs.users[0].fresh = false;
    inputs.users[0].age = std::chrono::milliseconds(tick - 499);
  }
  return inputs;
}

constexpr auto kVersion1 = state::StateVersion::without_governors;

/// What a server of version 1 wrote that took up the visit from a snapshot at tick 350. The accepted file came from such a server; this
/// makes another where the physics was meant to change.
void write_journal(const std::string& path) {
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher publisher;
  const auto description = test::make_crank_description();
  auto before = world::World::create(description, crank_config()).value();
  while (before->state.tick < 350)
    world::step(*before, inputs_of(before->state.tick), publisher, timer);
  record::JournalHeader header{"crank", "kiosk-1", "crank", description->content_hash, "test", 1, 351, {}, kVersion1};
  state::write_snapshot(before->state, header.snapshot, kVersion1);
  auto world = world::World::resume(description, crank_config(), header.snapshot).value();
  record::JournalWriter writer(header);
  while (world->state.tick < 950) {
    const state::TickInputs inputs = inputs_of(world->state.tick);
    world::step(*world, inputs, publisher, timer);
    record::TickRecord record{world->state.tick, &inputs, world->state.event_span(), {}};
    if (record.tick % 50 == 0) record.hash = state::state_hash(world->state, kVersion1);
    writer.add(record);
  }
  writer.close(state::state_hash(world->state, kVersion1));
  const std::vector<std::byte> bytes = writer.take_bytes();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TEST(Journal, OfVersion1ReplaysToItsHashes) {
  if (!test::gives_golden_bits()) GTEST_SKIP() << "the hashes are of processors with FMA";
  if (std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr) write_journal(kJournalOfVersion1);
  auto journal = record::JournalReader::open_file(kJournalOfVersion1);
  ASSERT_TRUE(journal.has_value()) << journal.error().to_string();
  ASSERT_EQ(journal->header().state_version, kVersion1);
  const auto replayed = app::replay(*journal, test::make_crank_description(), crank_config(), {});
  ASSERT_TRUE(replayed.has_value()) << replayed.error().to_string();
  EXPECT_EQ(replayed->ticks, 600u);
  EXPECT_EQ(replayed->hashes_compared, 13u);
  EXPECT_TRUE(replayed->same()) << "first difference after tick " << replayed->first_difference.value_or(0);
}

}  // namespace
}  // namespace mechane
