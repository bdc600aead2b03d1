#include "server/realtime/machine_check.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::realtime {
namespace {

namespace fs = std::filesystem;

// A folder that stands for "/", with the files of proc and sys that a test writes.
class MachineCheck : public testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text << "\n";
  }

  const test::ScratchFolder scratch_;
  const fs::path& root_ = scratch_.path();
};

TEST_F(MachineCheck, TellsAGoodMachineFromABadOne) {
  write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(check_cpu_governor(root_).status, CheckStatus::warning);
  EXPECT_EQ(check_cpu_governor(root_).found, "powersave");
  write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance");
  EXPECT_EQ(check_cpu_governor(root_).status, CheckStatus::ok);

  write("sys/devices/system/cpu/isolated", "");
  EXPECT_EQ(check_isolated_cpus(root_).status, CheckStatus::warning);
  write("sys/devices/system/cpu/isolated", "2-3");
  EXPECT_EQ(check_isolated_cpus(root_).status, CheckStatus::ok);

  write("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet");
  EXPECT_EQ(check_clock_source(root_).status, CheckStatus::warning);
  write("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc");
  EXPECT_EQ(check_clock_source(root_).status, CheckStatus::ok);

  write("sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never");
  EXPECT_EQ(check_transparent_hugepage(root_).status, CheckStatus::warning);
  write("sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never");
  EXPECT_EQ(check_transparent_hugepage(root_).status, CheckStatus::ok);
  EXPECT_EQ(check_transparent_hugepage(root_).found, "madvise");

  write("sys/kernel/debug/sched/preempt", "none (voluntary) full");
  EXPECT_EQ(check_kernel_preemption(root_).status, CheckStatus::warning);
  write("sys/kernel/debug/sched/preempt", "none voluntary (full)");
  EXPECT_EQ(check_kernel_preemption(root_).status, CheckStatus::ok);
  write("sys/kernel/realtime", "1");
  EXPECT_EQ(check_kernel_preemption(root_).found, "PREEMPT_RT");

  write("proc/sys/net/core/rmem_max", "212992");
  write("proc/sys/net/core/wmem_max", "4194304");
  const auto buffers = check_socket_buffers(root_);
  ASSERT_EQ(buffers.size(), 2u);
  EXPECT_EQ(buffers[0].status, CheckStatus::warning);
  EXPECT_EQ(buffers[1].status, CheckStatus::ok);
  EXPECT_EQ(worst_of(buffers), CheckStatus::warning);
}

TEST_F(MachineCheck, SocketBuffersAreSetAsTheFileForMuseumsSetsThem) {
  write("proc/sys/net/core/rmem_max", "1");
  write("proc/sys/net/core/wmem_max", "1");
  std::ifstream file(test::source_folder() / "deploy/systemd/90-mechane.conf");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const CheckResult& r : check_socket_buffers(root_)) {
    EXPECT_NE(r.remedy.find("/etc/sysctl.d/90-mechane.conf"), std::string::npos) << r.remedy;
    EXPECT_NE(r.remedy.find(r.name + "=4194304,"), std::string::npos) << r.remedy;
    EXPECT_NE(text.find(r.name + " = 4194304\n"), std::string::npos) << text;
  }
}

TEST_F(MachineCheck, AnEmptyMachineIsNoCrashAndEveryFaultHasARemedy) {
  MachineCheckOptions options;
  options.root = root_;
  options.probe_time = Duration{0};
  const auto results = check_machine(options);
  EXPECT_GE(results.size(), 9u);
  for (const CheckResult& r : results) {
    EXPECT_FALSE(r.name.empty());
    EXPECT_FALSE(r.found.empty()) << r.name;
    EXPECT_FALSE(r.wanted.empty()) << r.name;
    EXPECT_EQ(r.remedy.empty(), r.status == CheckStatus::ok) << r.name;
  }
}

TEST_F(MachineCheck, TheProbeMeasuresThisMachine) {
  const CheckResult probe = probe_wakeups(0, std::chrono::milliseconds(50));
  EXPECT_NE(probe.found.find("ordinary priority"), std::string::npos) << probe.found;
  EXPECT_NE(probe.found.find("p99"), std::string::npos) << probe.found;
}

}  // namespace
}  // namespace mechane::realtime
