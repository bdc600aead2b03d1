// `mechane displays`: how the displays of a museum are, and what is changed of them while they run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mechane::cli {

struct DisplaysOptions {
  std::string kiosk;    ///< empty: all; a change wants one
  std::string display;  ///< name of one of the kiosk's; empty: all
  std::uint32_t domain = 0;
  double seconds = 5;  ///< how long displays may take to answer
  bool json = false;
  std::vector<std::string> settings;  ///< NAME=VALUE
};

/// `verb`: empty, "set" or "picture". Returns the exit status: 0; 1 where the network cannot be joined, there is no such display, one
/// refused or did not answer; 2 for a setting that does not exist or is out of its range.
[[nodiscard]] int run_displays(const std::string& verb, const DisplaysOptions& options);

}  // namespace mechane::cli
