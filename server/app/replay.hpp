// Runs a journal again and compares the result with the state hashes that the live world wrote into it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "server/base/error.hpp"
#include "server/record/journal_reader.hpp"
#include "server/world/world.hpp"

namespace mechane::app {

struct ReplayOptions {
  bool real_time = false;    ///< at the pace of the visit instead of as fast as it can
  bool show_events = false;  ///< prints each event, with its tick, on stdout
};

struct ReplayResult {
  std::uint64_t ticks = 0;
  std::uint64_t hashes_compared = 0;
  bool older_physics = false;  ///< bodies move otherwise than when it was recorded: nothing was compared
  std::optional<std::uint64_t> first_difference;  ///< tick of the first hash that differs
  std::uint64_t final_hash = 0;
  record::JournalEnd end;
  double seconds = 0;
  /// The journal is whole.
  [[nodiscard]] bool whole() const { return end.kind == record::JournalEnd::Kind::closed; }
  /// And at least one hash was compared, and all agree.
  [[nodiscard]] bool same() const { return !first_difference && hashes_compared > 0 && whole(); }
};

/// The world in which a journal begins, with the forces on hands of the journal's time (state::StateVersion). Errors: conflict (the journal
/// was recorded with another form of the scenario), or the snapshot in it cannot be read.
[[nodiscard]] Expected<std::unique_ptr<world::World>> world_of_journal(
    const record::JournalHeader& header, const std::shared_ptr<const state::WorldDescription>& description,
    world::WorldConfig config);

/// With the forces on hands of the journal's time (state::StateVersion). Where bodies moved otherwise then, hashes are not compared.
/// Errors: conflict (the journal was recorded with another form of the scenario), or the snapshot in it cannot be read.
[[nodiscard]] Expected<ReplayResult> replay(record::JournalReader& journal,
                                            const std::shared_ptr<const state::WorldDescription>& description,
                                            world::WorldConfig config, const ReplayOptions& options);

}  // namespace mechane::app
