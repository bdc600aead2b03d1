#include "server/app/replay.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "server/app/names.hpp"
#include "server/world/step.hpp"

namespace mechane::app {
namespace {

void print_events(const world::World& world, const record::JournalTick& tick) {
  for (const state::Event& event : tick.events) {
    fmt::print("{:>8}  {}\n", event.tick, describe_event(*world.description, event));
  }
}

void compare(const record::JournalTick& tick, const world::World& world, state::StateVersion version,
             ReplayResult& result) {
  if (!tick.hash || result.older_physics) return;
  ++result.hashes_compared;
  if (*tick.hash != state::state_hash(world.state, version) && !result.first_difference)
    result.first_difference = tick.tick;
}

}  // namespace

Expected<std::unique_ptr<world::World>> world_of_journal(
    const record::JournalHeader& header, const std::shared_ptr<const state::WorldDescription>& description,
    world::WorldConfig config) {
  if (header.scenario_hash != description->content_hash) {
    return fail(ErrorCode::conflict,
                fmt::format("the journal was recorded with another form of scenario {} (hash {}; this one has {})",
                            header.scenario_id, header.scenario_hash, description->content_hash),
                header.world_id, "replay it with the scenario and settings of the day it was recorded");
  }
  if (header.state_version < state::StateVersion::with_corners) {
    config.force.thin_walls = haptics::ThinWalls::hold_tips;
    config.force.weights = false;
  }
  if (header.state_version < state::StateVersion::with_sides) config.force.thin_walls = haptics::ThinWalls::let_through;
  if (header.state_version < state::StateVersion::with_anchors) {
    config.force.friction = haptics::FrictionKind::damps;
    config.force.normals = haptics::NormalKind::of_contacts;
  }
  if (header.snapshot.empty()) return world::World::create(description, config);
  return world::World::resume(description, config, header.snapshot);
}

Expected<ReplayResult> replay(record::JournalReader& journal,
                              const std::shared_ptr<const state::WorldDescription>& description,
                              world::WorldConfig config, const ReplayOptions& options) {
  auto world = world_of_journal(journal.header(), description, std::move(config));
  if (!world) return tl::unexpected(world.error());
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher publisher;
  ReplayResult result;
  record::JournalTick tick;
  const state::StateVersion version = journal.header().state_version;
  result.older_physics = version < state::kSameMotion;
  const TimePoint began = clock.now();
  while (journal.next(tick) && !tick.after_loss) {
    if (options.real_time) clock.sleep_until(began + kTickPeriod * static_cast<std::int64_t>(result.ticks));
    world::step(**world, tick.inputs, publisher, timer);
    ++result.ticks;
    compare(tick, **world, version, result);
    if (options.show_events) print_events(**world, tick);
  }
  result.seconds = std::chrono::duration<double>(clock.now() - began).count();
  result.end = journal.end();
  result.final_hash = state::state_hash((*world)->state, version);
  if (result.end.hash && !result.older_physics) {
    ++result.hashes_compared;
    if (*result.end.hash != result.final_hash && !result.first_difference)
      result.first_difference = (*world)->state.tick;
  }
  return result;
}

}  // namespace mechane::app
