#include "server/app/report.hpp"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/collision/kernels.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::app {
namespace {

/// The report of a server that did nothing but write to the network, if that.
nlohmann::json idle_report(const realtime::LatencyHistogram& write_time = {}) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "server.json";
  EXPECT_TRUE(write_report(file, {}, write_time).has_value());
  return nlohmann::json::parse(std::ifstream(file));
}

TEST(Report, holds_no_time_that_was_not_measured) {
  realtime::LatencyHistogram write_time;
  write_time.record(std::chrono::microseconds(40));
  const nlohmann::json report = idle_report(write_time);
  EXPECT_NEAR(report["dds_write_us"]["median"].get<double>(), 40, 1);
  EXPECT_TRUE(report["tick_us"].empty()) << report;
  EXPECT_TRUE(report["wake_us"].empty()) << report;
  for (const auto& phase : report["phase_us"])
    EXPECT_TRUE(phase.empty()) << report;
  EXPECT_TRUE(idle_report()["dds_write_us"].empty());
}

TEST(ReportDeathTest, names_the_instruction_set_that_is_in_use) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a process chooses once
  const auto in_another = [] {
    ::setenv("MECHANE_KERNELS", "portable", 1);
    std::exit(idle_report()["simd"] == "portable" ? 0 : 1);
  };
  EXPECT_EXIT(in_another(), testing::ExitedWithCode(0), "");
  EXPECT_EQ(idle_report()["simd"], collision::best_kernels().name);
}

}  // namespace
}  // namespace mechane::app
