// `mechane doctor`: can this machine hold 1 kHz, and do the servers that answer here keep up?
#pragma once

#include <cstdint>

namespace mechane::cli {

/// Prints a table, or JSON, of what was found, what is required and what to do. Listens for servers in the DDS domain
/// while it measures wake-ups. Returns 0 when nothing is bad, else 1.
[[nodiscard]] int run_doctor(bool json, double probe_seconds, std::uint32_t domain);

}  // namespace mechane::cli
