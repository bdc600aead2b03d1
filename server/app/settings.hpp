// What a server can be told: a TOML file, then flags. Validated once, printed at start.
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
  /// X3D files, or ids in the catalogue; the first is what a kiosk gets that asks for none.
  std::vector<std::filesystem::path> scenarios;
  std::filesystem::path catalogue;                ///< of content, see mechane content; empty: none
  std::uint32_t worlds = 6;                       ///< at most so many at once, 1 .. 64
  std::uint32_t loop_threads = 1;                 ///< 1 .. 32
  std::uint32_t domain = 0;                       ///< DDS domain, 0 .. 230
  std::filesystem::path records = "out/records";  ///< journals and snapshots; empty: none are kept
  std::uint64_t records_limit_mb = 20'000;        ///< the oldest journals go when there are more
  /// Visitors' sheets, in the folder of records where it has none of its own; empty or "none": none are kept.
  std::filesystem::path visits = "visits.db";
  std::uint32_t visits_keep_days = 730;  ///< older sheets are deleted; 0: never for their age
  std::uint64_t visits_limit_mb = 200;   ///< the oldest sheets go when there are more
  std::filesystem::path cache;           ///< built parts; empty: the user's cache folder
  int fifo_priority = 80;                ///< of the loop, 0 .. 98; 0: an ordinary thread
  std::optional<int> first_cpu;          ///< pins loop thread i to processor first_cpu + i
  double world_idle_s = 30;              ///< a world without clients is closed after this long
  double resume_within_s = 600;          ///< a restarted server puts a kiosk back where it was, up to this old
  double run_for_s = 0;                  ///< stops by itself after this long; 0: runs until it is told to stop
  std::filesystem::path report;          ///< JSON of counters and tick times, written at the stop; empty: none
  bool verbose = false;
  haptics::HandSize hand;
  haptics::ForceConfig force;
  /// Where the sheets are; empty: none are kept. Without records there is no folder for a bare name.
  [[nodiscard]] std::filesystem::path visits_file() const;
  double stiffness_scale = 1;  ///< on every material and grasp, 0 .. 10; 0: nothing can be felt or moved
};

/// Reads flags and, with --settings FILE, a TOML file under them (a flag wins). `help` is filled instead when --help or --version
/// was asked for. Errors name the file and line, or the flag, and the allowed range.
[[nodiscard]] Expected<Settings> read_settings(int argc, const char* const* argv, std::string& help);

/// One "name = value" line a setting, for the log.
[[nodiscard]] std::string to_string(const Settings& settings);

}  // namespace mechane::app
