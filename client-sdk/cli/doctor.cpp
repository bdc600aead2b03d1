#include "client-sdk/cli/doctor.hpp"

#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "server/realtime/machine_check.hpp"

namespace mechane::cli {
namespace {

using realtime::CheckResult;
using realtime::CheckStatus;

void print_json(const std::vector<CheckResult>& results) {
  nlohmann::json list = nlohmann::json::array();
  for (const CheckResult& r : results) {
    list.push_back({{"name", r.name},
                    {"status", std::string(realtime::name_of(r.status))},
                    {"found", r.found},
                    {"wanted", r.wanted},
                    {"remedy", r.remedy}});
  }
  fmt::print("{}\n", list.dump(2));
}

/// Status words in colour where a person looks, plain in a file.
std::string status_word(CheckStatus status) {
  const std::string word = fmt::format("{:<8}", realtime::name_of(status));
  if (isatty(STDOUT_FILENO) == 0) return word;
  const char* colour = status == CheckStatus::ok ? "32" : status == CheckStatus::warning ? "33" : "31";
  return fmt::format("\033[{}m{}\033[0m", colour, word);
}

void print_table(const std::vector<CheckResult>& results) {
  for (const CheckResult& r : results) {
    fmt::print("{} {:<24} {}\n", status_word(r.status), r.name, r.found);
    if (r.status == CheckStatus::ok) continue;
    fmt::print("{:9}wanted: {}\n", "", r.wanted);
    if (!r.remedy.empty()) fmt::print("{:9}remedy: {}\n", "", r.remedy);
  }
  switch (realtime::worst_of(results)) {
    case CheckStatus::ok:
      fmt::print("\nThis machine can hold 1 kHz.\n");
      break;
    case CheckStatus::warning:
      fmt::print("\nThis machine can run the loop, with late ticks now and then.\n");
      break;
    case CheckStatus::bad:
      fmt::print("\nThis machine cannot hold 1 kHz as it is set up.\n");
      break;
  }
}

}  // namespace

int run_doctor(bool json, double probe_seconds) {
  realtime::MachineCheckOptions options;
  options.probe_time = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(probe_seconds));
  if (!json) fmt::print("Looking at this machine; measuring wake-ups for {:.0f} s ...\n\n", probe_seconds);
  std::fflush(stdout);
  const std::vector<CheckResult> results = realtime::check_machine(options);
  json ? print_json(results) : print_table(results);
  return realtime::worst_of(results) == CheckStatus::bad ? 1 : 0;
}

}  // namespace mechane::cli
