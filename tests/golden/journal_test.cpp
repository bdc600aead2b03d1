// Journals of this release and of earlier ones: they replay, compared over the fields that their release hashed. Where bodies have moved
// otherwise since, they are read and run to their end, and nothing is compared.
//
// Where the state has a new version, MECHANE_ACCEPT_GOLDEN=1 adds its journal. Those of earlier versions are never written again: each was
// written by a server of its time.
#include <filesystem>
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

std::filesystem::path journal_of(state::StateVersion version) {
  const auto number = static_cast<std::uint32_t>(version);
  return test::source_folder() / "tests/golden" / ("version-" + std::to_string(number) + ".journal");
}

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

/// What a server of today writes that took up the visit from a snapshot at tick 350.
void write_journal(const std::filesystem::path& path) {
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher publisher;
  const auto description = test::make_crank_description();
  auto before = world::World::create(description, crank_config()).value();
  while (before->state.tick < 350)
    world::step(*before, inputs_of(before->state.tick), publisher, timer);
  record::JournalHeader header{"crank", "kiosk-1", "crank", description->content_hash, "test", 1, 351, {}};
  state::write_snapshot(before->state, header.snapshot);
  auto world = world::World::resume(description, crank_config(), header.snapshot).value();
  record::JournalWriter writer(header);
  while (world->state.tick < 950) {
    const state::TickInputs inputs = inputs_of(world->state.tick);
    world::step(*world, inputs, publisher, timer);
    record::TickRecord record{world->state.tick, &inputs, world->state.event_span(), {}};
    if (record.tick % 50 == 0) record.hash = state::state_hash(world->state);
    writer.add(record);
  }
  writer.close(state::state_hash(world->state));
  const std::vector<std::byte> bytes = writer.take_bytes();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

class Journals : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(Journals, ReplayToTheirEnd) {
  if (!test::gives_golden_bits()) GTEST_SKIP() << "the hashes are of processors with FMA";
  const auto version = static_cast<state::StateVersion>(GetParam());
  const std::filesystem::path path = journal_of(version);
  const bool accepts = std::getenv("MECHANE_ACCEPT_GOLDEN") != nullptr;
  if (accepts && version == state::kStateVersion) write_journal(path);
  ASSERT_TRUE(std::filesystem::exists(path)) << "run this test once with MECHANE_ACCEPT_GOLDEN=1, and add the file";
  auto journal = record::JournalReader::open_file(path.string());
  ASSERT_TRUE(journal.has_value()) << journal.error().to_string();
  ASSERT_EQ(journal->header().state_version, version);
  const auto replayed = app::replay(*journal, test::make_crank_description(), crank_config(), {});
  ASSERT_TRUE(replayed.has_value()) << replayed.error().to_string();
  EXPECT_EQ(replayed->ticks, 600u);
  EXPECT_TRUE(replayed->whole());
  EXPECT_EQ(replayed->older_physics, version < state::kSameMotion);
  if (replayed->older_physics) {
    EXPECT_EQ(replayed->hashes_compared, 0u);
    EXPECT_FALSE(replayed->first_difference.has_value());
    return;
  }
  EXPECT_EQ(replayed->hashes_compared, 13u);
  EXPECT_TRUE(replayed->same()) << "first difference after tick " << replayed->first_difference.value_or(0);
}

/// Those that have a file, and today's, which must have one.
std::vector<std::uint32_t> journal_versions() {
  std::vector<std::uint32_t> versions;
  for (std::uint32_t version = 1; state::is_known(static_cast<state::StateVersion>(version)); version *= 2) {
    const auto known = static_cast<state::StateVersion>(version);
    if (known == state::kStateVersion || std::filesystem::exists(journal_of(known))) versions.push_back(version);
  }
  return versions;
}

INSTANTIATE_TEST_SUITE_P(OfVersion, Journals, ::testing::ValuesIn(journal_versions()),
                         [](const auto& version) { return std::to_string(version.param); });

}  // namespace
}  // namespace mechane
