// `mechane open [SCENARIO]`: lets a kiosk go on to another exhibit, or home.
#pragma once

#include <cstdint>
#include <string>

namespace mechane::cli {

struct OpenOptions {
  std::string scenario;  ///< its id; empty: home, the server's first
  std::string kiosk = "kiosk-1";
  std::uint32_t domain = 0;
  double seconds = 10;  ///< how long to wait for the server
};

/// Returns the exit status: 0 once the kiosk is in its new world; 1 if the network cannot be joined, no server answers,
/// the kiosk has no world, or the server does not have the scenario.
[[nodiscard]] int run_open(const OpenOptions& options);

}  // namespace mechane::cli
