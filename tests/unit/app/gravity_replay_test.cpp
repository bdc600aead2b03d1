// A visit in which steps switch the gravity of bodies is replayed to the bit, also from its middle.
#include <gtest/gtest.h>

#include "server/app/replay.hpp"
#include "server/base/clock.hpp"
#include "server/record/journal_writer.hpp"
#include "server/state/snapshot.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/floating_ball.hpp"

namespace mechane::app {
namespace {

world::WorldConfig config_with_hand() {
  world::WorldConfig config;
  config.hand = test::shared_hand();
  return config;
}

/// What a server writes that takes up the visit at this tick, and goes on for 600 ticks.
std::vector<std::byte> journal_from(std::uint64_t tick) {
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher publisher;
  const auto description = test::make_floating_ball();
  auto world = world::World::create(description, config_with_hand()).value();
  while (world->state.tick < tick)
    world::step(*world, {}, publisher, timer);
  record::JournalHeader header{"ball", "kiosk-1", "floating-ball", description->content_hash, "test", 1, tick + 1, {}};
  state::write_snapshot(world->state, header.snapshot);
  record::JournalWriter writer(header);
  while (world->state.tick < tick + 600) {
    const state::TickInputs inputs{};
    world::step(*world, inputs, publisher, timer);
    record::TickRecord record{world->state.tick, &inputs, world->state.event_span(), {}};
    if (record.tick % 50 == 0) record.hash = state::state_hash(world->state);
    writer.add(record);
  }
  writer.close(state::state_hash(world->state));
  return writer.take_bytes();
}

TEST(GravityReplay, IsTheSameToTheBit) {
  for (const std::uint64_t tick : {50u, 350u}) {  // before and after the step that switches it
    const std::vector<std::byte> bytes = journal_from(tick);
    auto journal = record::JournalReader::open_bytes(bytes, "ball");
    ASSERT_TRUE(journal.has_value()) << journal.error().to_string();
    const auto replayed = replay(*journal, test::make_floating_ball(), config_with_hand(), {});
    ASSERT_TRUE(replayed.has_value()) << replayed.error().to_string();
    EXPECT_EQ(replayed->ticks, 600u);
    EXPECT_TRUE(replayed->same()) << "first difference after tick " << replayed->first_difference.value_or(0);
  }
}

TEST(GravityReplay, OfStepsThatSwitchItOtherwiseDiffers) {
  const std::vector<std::byte> bytes = journal_from(50);
  auto journal = record::JournalReader::open_bytes(bytes, "ball");
  const auto other = test::make_floating_ball();
  other->steps[1].bodies[0].use_gravity = false;
  const auto replayed = replay(*journal, other, config_with_hand(), {});
  ASSERT_TRUE(replayed.has_value()) << replayed.error().to_string();
  EXPECT_FALSE(replayed->same());
  EXPECT_GE(replayed->first_difference.value_or(0), 200u) << "up to that step nothing does";
}

}  // namespace
}  // namespace mechane::app
