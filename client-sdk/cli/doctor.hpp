// `mechane doctor`: can this machine hold 1 kHz, do the servers that answer here keep up, and can the haptic devices be opened?
#pragma once

#include <cstdint>

namespace mechane::cli {

struct DoctorOptions {
  bool json = false;
  double probe_s = 2;  ///< how long wake-ups are measured
  std::uint32_t domain = 0;
};

/// Prints a table, or JSON, of what was found, what is required and what to do. Listens for servers in the DDS domain
/// while it measures wake-ups. Returns 0 when nothing is bad, else 1.
[[nodiscard]] int run_doctor(const DoctorOptions& options);

}  // namespace mechane::cli
