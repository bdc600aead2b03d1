// The server's settings, from a TOML file and from flags. They are validated once, and printed at the start.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/haptics/hand_model.hpp"
#include "server/haptics/render_forces.hpp"

namespace mechane::app {

struct Settings {
  std::string name = "server-1";  ///< on the wire and in logs
  /// X3D files, or ids in the catalogue. Kiosks that ask for no other begin in the first.
  std::vector<std::filesystem::path> scenarios;
  std::filesystem::path catalogue;  ///< of content, see mechane content; empty: none
  /// Folder from which exhibits are loaded by name while the server runs; empty: that in which the first scenario's folder lies.
  std::filesystem::path exhibits;
  std::filesystem::path exhibit_key =
      "exhibits.key";                             ///< as `visits`: its folder is that of records; "none": no changes
  std::uint32_t worlds = 6;                       ///< at most so many at once, 1 .. 64
  std::uint32_t loop_threads = 1;                 ///< 1 .. 32
  std::uint32_t domain = 0;                       ///< DDS domain, 0 .. 230
  std::filesystem::path records = "out/records";  ///< folder of journals and snapshots; empty: nothing is recorded
  std::uint64_t records_limit_mb = 20'000;        ///< the oldest journals are deleted when all together are larger
  /// File of the records of visits; a name without folder lies in the folder of records. Empty or "none": visits are not recorded.
  std::filesystem::path visits = "visits.db";
  std::uint32_t visits_keep_days = 730;  ///< older visits are deleted; 0: age does not count
  std::uint64_t visits_limit_mb = 200;   ///< the oldest visits are deleted when the file is larger
  std::filesystem::path cache;           ///< built parts; empty: the user's cache folder
  int fifo_priority = 80;                ///< of the loop, 0 .. 98; 0: an ordinary thread
  std::optional<int> first_cpu;          ///< pins loop thread i to processor first_cpu + i
  double world_idle_s = 30;              ///< a world without clients is closed after this long
  double resume_within_s = 600;          ///< a restarted server continues from snapshots that are not older
  double run_for_s = 0;                  ///< the server stops after this long; 0: it runs until it is told to stop
  std::filesystem::path report;          ///< JSON of counters and tick times, written at the stop; empty: none
  bool paced = false;  ///< orders about the pace of time come from standard input; the server ends with it
  bool verbose = false;
  haptics::HandSize hand;
  haptics::ForceConfig force;
  /// The file of the records of visits, with its folder; empty: visits are not recorded. Without `records`, `visits` needs a folder.
  [[nodiscard]] std::filesystem::path visits_file() const;
  /// The file of the key for changes of exhibits, with its folder; empty: the server takes no changes.
  [[nodiscard]] std::filesystem::path exhibit_key_file() const;
  /// Where loaded and retired exhibits are kept for the next start; empty without `records`: they are forgotten.
  [[nodiscard]] std::filesystem::path exhibit_changes_file() const;
  double stiffness_scale = 1;  ///< factor on every material and grasp, 0 .. 10; 0: nothing can be felt or moved
};

/// Reads flags and, with --settings FILE, a TOML file; a flag wins over the file. Where --help or --version is given, `help` is filled
/// instead. Errors name the file and line, or the flag, and the allowed range: unknown_name, invalid_value, not_found and damaged (the
/// file).
[[nodiscard]] Expected<Settings> read_settings(int argc, const char* const* argv, std::string& help);

/// A line "name = value" for each setting, for the log.
[[nodiscard]] std::string to_string(const Settings& settings);

}  // namespace mechane::app
