// The file in which a restarted server finds a world's state.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::record {

/// What a restart must know before it reads the state: which kiosk's world it is, and of which scenario.
struct SnapshotInfo {
  std::string world_id;
  std::string kiosk;
  std::string scenario_id;
  std::string scenario_hash;
  std::uint64_t tick = 0;
  std::uint64_t wall_ns = 0;  ///< when it was taken, since 1970 UTC
};

struct SnapshotFile {
  SnapshotInfo info;
  std::vector<std::byte> state;  ///< for state::read_snapshot
};

/// "<folder>/<world>.snapshot"; see file_name_of.
[[nodiscard]] std::filesystem::path snapshot_path(const std::filesystem::path& folder, const std::string& world_id);

/// As write_whole, durable: a reader finds the old file or the new one, whole, also after a power cut. Errors: io_failure; the old file
/// is then as it was.
[[nodiscard]] Expected<void> write_snapshot_file(const std::filesystem::path& path, const SnapshotInfo& info,
                                                 std::span<const std::byte> state);

/// Errors: those of read_whole, damaged (not a snapshot, or a wrong checksum), wrong_version.
[[nodiscard]] Expected<SnapshotFile> read_snapshot_file(const std::filesystem::path& path);

/// The snapshots of a folder, sorted by name. Empty where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> find_snapshots(const std::filesystem::path& folder);

}  // namespace mechane::record
