// `mechane doctor`: can this machine hold 1 kHz?
#pragma once

namespace mechane::cli {

/// Prints a table, or JSON, of what was found, what is wanted and what to do. Returns 0 when nothing is bad, else 1.
[[nodiscard]] int run_doctor(bool json, double probe_seconds);

}  // namespace mechane::cli
