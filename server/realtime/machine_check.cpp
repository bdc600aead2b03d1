#include "server/realtime/machine_check.hpp"

#include <algorithm>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "server/realtime/periodic_thread.hpp"

namespace mechane::realtime {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLimitsRemedy =
    "run the server through its systemd unit, or add 'rtprio' and 'memlock' for its user in /etc/security/limits.d";

CheckResult result(std::string name, CheckStatus status, std::string found, std::string wanted, std::string remedy) {
  if (status == CheckStatus::ok) remedy.clear();
  return {std::move(name), status, std::move(found), std::move(wanted), std::move(remedy)};
}

std::optional<std::string> first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) return std::nullopt;
  return line;
}

// "always [madvise] never": the word in brackets.
std::string chosen_word(const std::string& line) {
  const auto open = line.find('[');
  const auto close = line.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return line;
  return line.substr(open + 1, close - open - 1);
}

std::string limit_text(rlim_t limit) {
  return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit);
}

// Asks for the policy in a thread that ends at once, so that the caller's own priority stays.
bool fifo_is_granted(int priority) {
  bool granted = false;
  std::thread([&] {
    sched_param parameters{};
    parameters.sched_priority = priority;
    granted = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
  }).join();
  return granted;
}

CheckResult socket_buffer(const fs::path& root, const std::string& name) {
  constexpr long kWanted = 1 << 20;
  const std::string key = "net.core." + name;
  const auto line = first_line(root / "proc/sys/net/core" / name);
  const std::string remedy =
      fmt::format("sysctl -w {}={}, and the same in /etc/sysctl.d/90-mechane.conf", key, 4 * kWanted);
  const std::string wanted = fmt::format("{} or more", kWanted);
  if (!line)
    return result(key, CheckStatus::warning, "cannot be read", wanted, "check it on the host of this container");
  const long value = std::atol(line->c_str());
  return result(key, value >= kWanted ? CheckStatus::ok : CheckStatus::warning, *line, wanted, remedy);
}

}  // namespace

std::string_view name_of(CheckStatus status) {
  switch (status) {
    case CheckStatus::ok:
      return "ok";
    case CheckStatus::warning:
      return "warning";
    case CheckStatus::bad:
      break;
  }
  return "bad";
}

CheckResult check_cpus() {
  cpu_set_t set;
  CPU_ZERO(&set);
  const int usable = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
  const CheckStatus status = usable >= 4 ? CheckStatus::ok : usable >= 2 ? CheckStatus::warning : CheckStatus::bad;
  return result("processors", status, fmt::format("{} usable", usable),
                "4 or more: the loop, the publishers, DDS, the system",
                "use a machine, or give this virtual machine, more processors");
}

CheckResult check_realtime_priority(int fifo_priority) {
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  const bool granted = fifo_is_granted(fifo_priority);
  return result("real-time priority", granted ? CheckStatus::ok : CheckStatus::bad,
                fmt::format("SCHED_FIFO {} is {} (RLIMIT_RTPRIO {})", fifo_priority, granted ? "granted" : "refused",
                            limit_text(limit.rlim_cur)),
                fmt::format("SCHED_FIFO {} granted", fifo_priority), kLimitsRemedy);
}

CheckResult check_memory_lock() {
  constexpr rlim_t kWanted = 512u << 20;
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  // A process with CAP_IPC_LOCK may lock more than the limit, so try it. The default limit allows single pages: lock 16 MiB.
  constexpr std::size_t kProbe = 16u << 20;
  void* memory = mmap(nullptr, kProbe, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool locked = memory != MAP_FAILED && mlock(memory, kProbe) == 0;
  if (memory != MAP_FAILED) munmap(memory, kProbe);
  const bool enough = limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= kWanted || geteuid() == 0;
  const CheckStatus status = !locked ? CheckStatus::bad : enough ? CheckStatus::ok : CheckStatus::warning;
  return result("memory lock", status,
                fmt::format("RLIMIT_MEMLOCK {}, 16 MiB {}", limit_text(limit.rlim_cur), locked ? "locked" : "refused"),
                fmt::format("{} bytes or more", kWanted), kLimitsRemedy);
}

CheckResult check_cpu_governor(const fs::path& root) {
  const std::string name = "processor frequency";
  const std::string wanted = "governor 'performance' on every processor";
  std::string found;
  CheckStatus status = CheckStatus::ok;
  std::error_code error;
  for (fs::directory_iterator it(root / "sys/devices/system/cpu", error), end; !error && it != end;
       it.increment(error)) {
    const auto governor = first_line(it->path() / "cpufreq/scaling_governor");
    if (!governor) continue;
    if (*governor != "performance") status = CheckStatus::warning;
    if (found.empty() || *governor != "performance") found = *governor;
  }
  // A virtual machine has no cpufreq: its host sets the frequency.
  if (found.empty()) return result(name, CheckStatus::ok, "set by the host of this machine (no cpufreq)", wanted, {});
  return result(name, status, found, wanted, "cpupower frequency-set -g performance");
}

CheckResult check_kernel_preemption(const fs::path& root) {
  const std::string wanted = "PREEMPT_RT, or preempt=full";
  const std::string remedy = "boot with preempt=full, or install linux-image-rt-amd64";
  utsname names{};
  uname(&names);
  const std::string version = names.version;
  if (first_line(root / "sys/kernel/realtime").value_or("0") == "1" ||
      version.find("PREEMPT_RT") != std::string::npos) {
    return result("kernel preemption", CheckStatus::ok, "PREEMPT_RT", wanted, {});
  }
  // In debugfs, for root only: "none (voluntary) full".
  if (const auto line = first_line(root / "sys/kernel/debug/sched/preempt")) {
    const bool full = line->find("(full)") != std::string::npos;
    return result("kernel preemption", full ? CheckStatus::ok : CheckStatus::warning, *line, wanted, remedy);
  }
  const auto command_line = first_line(root / "proc/cmdline").value_or("");
  const bool full = command_line.find("preempt=full") != std::string::npos;
  const bool known = full || version.find("PREEMPT") == std::string::npos;
  const std::string found = full ? "preempt=full" : known ? "none" : "PREEMPT_DYNAMIC, mode unknown";
  return result("kernel preemption", full ? CheckStatus::ok : CheckStatus::warning, found, wanted, remedy);
}

CheckResult check_isolated_cpus(const fs::path& root) {
  const auto line = first_line(root / "sys/devices/system/cpu/isolated").value_or("");
  return result("isolated processors", line.empty() ? CheckStatus::warning : CheckStatus::ok,
                line.empty() ? "none" : line, "one for each loop thread",
                "boot with isolcpus=N nohz_full=N and give the loop that processor");
}

CheckResult check_clock_source(const fs::path& root) {
  const auto line = first_line(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
  const std::string found = line.value_or("cannot be read");
  const bool fast = found == "tsc" || found == "kvm-clock" || found == "arch_sys_counter";
  return result("clock source", fast ? CheckStatus::ok : CheckStatus::warning, found,
                "tsc or kvm-clock: read without a system call",
                "boot with clocksource=tsc tsc=reliable where the processor's counter is stable");
}

std::vector<CheckResult> check_socket_buffers(const fs::path& root) {
  return {socket_buffer(root, "rmem_max"), socket_buffer(root, "wmem_max")};
}

CheckResult check_transparent_hugepage(const fs::path& root) {
  const auto line = first_line(root / "sys/kernel/mm/transparent_hugepage/enabled");
  const std::string found = line ? chosen_word(*line) : "not in this kernel";
  return result(
      "transparent huge pages", found == "always" ? CheckStatus::warning : CheckStatus::ok, found, "madvise or never",
      "echo madvise > /sys/kernel/mm/transparent_hugepage/enabled: gathering pages stalls the threads that use them");
}

CheckResult probe_wakeups(int fifo_priority, Duration probe_time) {
  const std::string name = "wake-ups at 1 kHz";
  const std::string wanted = "p99 under 100 us, none skipped";
  const auto wanted_ticks = static_cast<std::uint64_t>(probe_time / kTickPeriod);
  std::mutex mutex;
  std::condition_variable done;
  bool finished = false;
  SystemClock clock;
  PeriodicConfig config;
  config.name = "wake-up probe";
  config.fifo_priority = fifo_priority;
  PeriodicThread thread(config, clock);
  const TimePoint end = clock.now() + probe_time;
  auto started = thread.start([&](const TickTiming& timing) {
    if (timing.woke < end || finished) return;
    thread.request_stop();
    const std::lock_guard lock(mutex);
    finished = true;
    done.notify_one();
  });
  if (!started) return result(name, CheckStatus::bad, started.error().to_string(), wanted, started.error().remedy);
  {
    std::unique_lock lock(mutex);
    done.wait(lock, [&] { return finished; });
  }
  thread.stop();
  const PeriodicReport report = thread.report();
  const LatencyHistogram& latency = thread.wake_latency();
  const double p99_us = to_us(latency.quantile(0.99));
  const bool lost_many = report.skipped * 1000 > wanted_ticks;
  CheckStatus status = CheckStatus::ok;
  if (p99_us > 100 || report.skipped > 0) status = CheckStatus::warning;
  if (p99_us > 500 || lost_many) status = CheckStatus::bad;
  return result(name, status,
                fmt::format("p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us, {} of {} skipped, {}",
                            to_us(latency.quantile(0.5)), p99_us, to_us(latency.max()), report.skipped,
                            report.ticks + report.skipped, report.fifo_granted ? "SCHED_FIFO" : "ordinary priority"),
                wanted, "grant SCHED_FIFO, give the loop a processor of its own, and look at what else runs here");
}

std::vector<CheckResult> check_machine(const MachineCheckOptions& options) {
  std::vector<CheckResult> results{check_cpus(),
                                   check_realtime_priority(options.fifo_priority),
                                   check_memory_lock(),
                                   check_cpu_governor(options.root),
                                   check_kernel_preemption(options.root),
                                   check_isolated_cpus(options.root),
                                   check_clock_source(options.root)};
  for (CheckResult& buffer : check_socket_buffers(options.root))
    results.push_back(std::move(buffer));
  results.push_back(check_transparent_hugepage(options.root));
  if (options.probe_time > Duration{0}) results.push_back(probe_wakeups(options.fifo_priority, options.probe_time));
  return results;
}

CheckStatus worst_of(const std::vector<CheckResult>& results) {
  CheckStatus worst = CheckStatus::ok;
  for (const CheckResult& r : results)
    worst = std::max(worst, r.status);
  return worst;
}

}  // namespace mechane::realtime
