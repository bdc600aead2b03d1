// `mechane doctor`: can this machine hold 1 kHz, and do the servers that answer here keep up?
#pragma once

#include <cstdint>

namespace mechane::cli {

/// Prints a table, or JSON, of what was found, what is wanted and what to do. Servers of the DDS domain are listened for while wake-ups
/// are measured. Returns 0 when nothing is bad, else 1.
[[nodiscard]] int run_doctor(bool json, double probe_seconds, std::uint32_t domain);

}  // namespace mechane::cli
