// `mechane displays`: shows the state of a museum's displays, and changes their settings.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mechane::cli {

struct DisplaysOptions {
  std::string kiosk;    ///< empty: all; required for changes
  std::string display;  ///< name of one of the kiosk's displays; empty: all
  std::uint32_t domain = 0;
  double seconds = 5;  ///< how long displays may take to answer
  bool json = false;
  std::vector<std::string> settings;  ///< NAME=VALUE
};

/// `verb`: empty, "set", "picture" or "restart". Returns the exit status: 0; 1 if the network cannot be joined, no display has
/// this name, or one refused or did not answer; 2 for a setting that does not exist or is out of its range.
[[nodiscard]] int run_displays(const std::string& verb, const DisplaysOptions& options);

}  // namespace mechane::cli
