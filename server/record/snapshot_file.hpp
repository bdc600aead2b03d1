// The file that a restarted server finds a world's state in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::record {

/// What a restart must know before it reads the state: whose world, and of which scenario.
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

/// "<folder>/<world>.snapshot"; characters that a file name should not have become '_'.
[[nodiscard]] std::filesystem::path snapshot_path(const std::filesystem::path& folder, const std::string& world_id);

/// Writes beside `path`, flushes to the disk, and renames: a reader finds the old file or the new one, whole, also after a power
/// cut. Errors name the file and the system's reason; the old file is then as it was.
[[nodiscard]] Expected<void> write_snapshot_file(const std::filesystem::path& path, const SnapshotInfo& info,
                                                 std::span<const std::byte> state);

/// Errors: no such file, not a snapshot, another version, damaged (checksum).
[[nodiscard]] Expected<SnapshotFile> read_snapshot_file(const std::filesystem::path& path);

/// The snapshots of a folder, by name. None where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> find_snapshots(const std::filesystem::path& folder);

}  // namespace mechane::record
