// Can this machine hold a loop of 1 kHz? Each check says what it found, what it wants, and what to do. `mechane doctor`
// prints them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/clock.hpp"

namespace mechane::realtime {

enum class CheckStatus { ok, warning, bad };

/// "ok", "warning" or "bad".
[[nodiscard]] std::string_view name_of(CheckStatus status);

/// All texts are for people; none is parsed by code.
struct CheckResult {
  std::string name;  ///< "real-time priority"
  CheckStatus status = CheckStatus::ok;
  std::string found;   ///< "SCHED_FIFO refused (RLIMIT_RTPRIO is 0)"
  std::string wanted;  ///< "SCHED_FIFO up to priority 80"
  std::string remedy;  ///< what to do; empty when ok
};

struct MachineCheckOptions {
  int fifo_priority = 80;                         ///< that the loop will ask for
  Duration probe_time = std::chrono::seconds(2);  ///< how long the wake-up probe runs; 0: left out
  std::filesystem::path root = "/";               ///< where proc and sys are; a test gives a folder of its own
};

/// Runs every check in order. Takes `probe_time`, allocates, starts a thread: never from a loop.
[[nodiscard]] std::vector<CheckResult> check_machine(const MachineCheckOptions& options = {});

// The checks one by one. Those that ask the kernel about this process take no root.
[[nodiscard]] CheckResult check_cpus();
[[nodiscard]] CheckResult check_realtime_priority(int fifo_priority);
[[nodiscard]] CheckResult check_memory_lock();
[[nodiscard]] CheckResult check_cpu_governor(const std::filesystem::path& root);
[[nodiscard]] CheckResult check_kernel_preemption(const std::filesystem::path& root);
[[nodiscard]] CheckResult check_isolated_cpus(const std::filesystem::path& root);
[[nodiscard]] CheckResult check_clock_source(const std::filesystem::path& root);
/// Receive and send limits of sockets (net.core.rmem_max, wmem_max): Cyclone asks for 1 MiB, and a burst of scene
/// frames needs it.
[[nodiscard]] std::vector<CheckResult> check_socket_buffers(const std::filesystem::path& root);
[[nodiscard]] CheckResult check_transparent_hugepage(const std::filesystem::path& root);
/// Runs an empty loop of 1 kHz for `probe_time` and judges its wake-ups: p99 under 100 us and none lost is ok.
[[nodiscard]] CheckResult probe_wakeups(int fifo_priority, Duration probe_time);

/// The worst status of all; ok for none.
[[nodiscard]] CheckStatus worst_of(const std::vector<CheckResult>& results);

}  // namespace mechane::realtime
