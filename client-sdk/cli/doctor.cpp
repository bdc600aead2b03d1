#include "client-sdk/cli/doctor.hpp"

#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "client-sdk/cli/doctor_devices.hpp"
#include "client-sdk/client/parse.hpp"
#include "server/base/program_folder.hpp"
#include "server/log/printable.hpp"
#include "server/realtime/machine_check.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/proto/entity.hpp>
#include <mechane/proto/names.hpp>

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

/// The status, in colour on a terminal, plain otherwise.
std::string status_word(CheckStatus status) {
  const std::string word = fmt::format("{:<8}", realtime::name_of(status));
  if (isatty(STDOUT_FILENO) == 0) return word;
  const char* colour = status == CheckStatus::ok ? "32" : status == CheckStatus::warning ? "33" : "31";
  return fmt::format("\033[{}m{}\033[0m", colour, word);
}

/// `devices`: the verdict on them; empty where it is good.
void print_table(const std::vector<CheckResult>& results, CheckStatus machine, const std::string& devices) {
  for (const CheckResult& r : results) {
    fmt::print("{} {:<24} {}\n", status_word(r.status), r.name, r.found);
    if (r.status == CheckStatus::ok) continue;
    fmt::print("{:9}wanted: {}\n", "", r.wanted);
    if (!r.remedy.empty()) fmt::print("{:9}remedy: {}\n", "", r.remedy);
  }
  fmt::print("\n");
  if (machine == CheckStatus::bad)
    fmt::print("This machine cannot hold 1 kHz as it is set up.\n");
  else if (devices.empty())
    fmt::print("This machine can {}.\n",
               machine == CheckStatus::ok ? "hold 1 kHz" : "run the loop, with late ticks now and then");
  if (!devices.empty()) fmt::print("{}.\n", devices);
}

constexpr std::size_t kMostServers = 16;

CheckResult judge_server(const std::string& name, const proto::ServerStatus& wire) {
  const std::string wanted = "a force each millisecond for each hand";
  if (const std::string other = client::other_protocol(wire); !other.empty())
    return {"server " + name, CheckStatus::warning, fmt::format("protocol {}", wire.protocol),
            fmt::format("protocol {}", proto::kProtocol), other};
  const std::string overload = log::printable(proto::string_of(wire.overload));
  const std::string found = fmt::format(
      "{} of {} worlds, {} hands; since its start {} ticks, {} of them over 1 ms, {} pauses of hands over 10 ms, the "
      "longest of the last 10 s {:.0f} ms",
      wire.worlds, wire.worlds_limit, wire.users, wire.ticks, wire.overruns, wire.input_gaps, wire.input_gap_ms);
  return {"server " + name, overload.empty() ? CheckStatus::ok : CheckStatus::warning, found, wanted, overload};
}

/// Receives the status of servers.
class ServerListener {
 public:
  explicit ServerListener(std::uint32_t domain) : participant_(proto::Participant::create(domain)) {
    if (!participant_) return;
    reader_ = proto::Reader<proto::ServerStatus>::create(*participant_, "", [this](auto) { news_.signal(); });
  }
  /// Adds a line for each server; waits a moment if none has been heard yet.
  void add_to(std::vector<CheckResult>& results) {
    if (!participant_ || !*reader_) {
      const Error& fault = !participant_ ? participant_.error() : reader_->error();
      results.push_back(
          {"servers", CheckStatus::warning, fault.what, "a network on which servers can be heard", fault.remedy});
      return;
    }
    const TimePoint until = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    for (take(); heard_.empty() && std::chrono::steady_clock::now() < until; take())
      news_.wait(std::chrono::milliseconds(50));
    for (const auto& [name, result] : heard_)
      results.push_back(result);
  }

 private:
  void take() {
    (*reader_)->view().take_each([this](const proto::ServerStatus& wire, const proto::SampleInfo& info) {
      const std::string name = log::printable(proto::text_of(wire.server));
      if (!info.valid || (heard_.size() >= kMostServers && !heard_.contains(name))) return;
      heard_[name] = judge_server(name, wire);
    });
  }

  realtime::Wakeup news_;
  Expected<proto::Participant> participant_;
  std::optional<Expected<proto::Reader<proto::ServerStatus>>> reader_;
  std::map<std::string, CheckResult> heard_;
};

/// Returns the verdict on them.
std::string add_devices_to(std::vector<CheckResult>& results) {
  const std::filesystem::path programs = program_folder();
  std::vector<CheckResult> devices =
      check_devices({.devices_program = programs / "mechane-devices", .haptic_program = programs / "mechane-haptic"});
  std::string verdict = verdict_on(devices);
  for (CheckResult& r : devices) {
    r.name = log::printable(r.name);
    r.found = log::printable(r.found);
    r.remedy = log::printable(r.remedy);
    results.push_back(std::move(r));
  }
  return verdict;
}

}  // namespace

int run_doctor(const DoctorOptions& options) {
  realtime::MachineCheckOptions machine_options;
  machine_options.probe_time = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(options.probe_s));
  if (!options.json) fmt::print("Looking at this machine; measuring wake-ups for {:.0f} s ...\n\n", options.probe_s);
  std::fflush(stdout);
  ServerListener servers(options.domain);
  std::vector<CheckResult> results = realtime::check_machine(machine_options);
  const CheckStatus machine = realtime::worst_of(results);
  servers.add_to(results);
  const std::string devices = add_devices_to(results);
  options.json ? print_json(results) : print_table(results, machine, devices);
  return realtime::worst_of(results) == CheckStatus::bad ? 1 : 0;
}

}  // namespace mechane::cli
