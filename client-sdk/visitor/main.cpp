// mechane-visitor: an automated visitor that plays a scenario's visit over the network like a person.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "client-sdk/haptic/driver.hpp"
#include "client-sdk/visitor/visit_tour.hpp"
#include "server/base/whole_file.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"

namespace {

using namespace mechane;

constexpr std::string_view kPointerName = "pointer";

volatile std::sig_atomic_t g_stop = 0;  // set by the signal handler

struct Arguments {
  visitor::VisitOptions options;
  std::vector<std::filesystem::path> scenarios;
  bool all = false;
  std::size_t at_once = 4;
  std::string report_file;
  std::vector<double> offset;
  std::string device{haptic::kVirtualName};
  bool glove = false;
  bool direct = false;
  double patience_s = 60;
  double linger_s = 1;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--kiosk", a.options.client.kiosk, "name of the kiosk");
  app.add_option("--user", a.options.client.user, "which hand of the kiosk, 0..3");
  app.add_option("--join", a.options.client.join_kiosk, "share the world of this kiosk");
  app.add_option("--scenario", a.scenarios, "X3D file to read the visit from; with --all, files and folders of them");
  auto* activity = app.add_option("--activity", a.options.activities,
                                  "play one visit of each of these activities, in this order; without: all visits");
  auto* visit =
      app.add_option("--visit", a.options.visits, "play these visits, by their names in the scenario, in this order")
          ->excludes(activity);
  auto* all = app.add_flag(
      "--all", a.all,
      "play all visits of all scenarios at once, each scenario at a kiosk that is named after its file; without "
      "--scenario, those of the folder 'scenarios'");
  all->excludes(activity)->excludes(visit);
  app.add_option("--at-once", a.at_once,
                 "with --all: how many kiosks at a time; each needs part of a processor here and at the server")
      ->needs(all)
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--domain", a.options.client.domain, "DDS domain");
  app.add_option("--offset", a.offset, "metres by which the hand misses: x y z")->expected(3);
  app.add_option("--patience", a.patience_s, "seconds to wait after the last move until the activity is done");
  app.add_option("--linger", a.linger_s, "seconds to stay at an exhibit that a sign opened")
      ->check(CLI::Range(0.0, 600.0));
  app.add_option("--report", a.report_file, "write a JSON report to this file");
  auto* device = app.add_option(
      "--device", a.device,
      fmt::format("the simulated device in the visitor's hand: {0}, or {0}:OPTION=VALUE,... (options: {1}); or {2}: a "
                  "mouse before a display's picture",
                  haptic::kVirtualName, haptic::kVirtualOptions, kPointerName));
  app.add_flag("--glove", a.glove, "a whole hand instead of one point: as --device virtual:kind=glove")
      ->excludes(device);
  app.add_flag("--direct", a.direct,
               "render the server's forces, not contacts and held paths at the device's own rate");
  app.add_flag("--endless", a.options.endless, "start again after the last visit");
}

Expected<void> choose_device(Arguments& a) {
  if (a.device == kPointerName) {
    a.options.pointer = true;
    a.options.client.role = client::Role::watcher;  // the mouse moves the hand of a display
    return {};
  }
  const haptic::DeviceName name = haptic::parse_device_name(a.glove ? "virtual:kind=glove" : a.device);
  if (name.driver != haptic::kVirtualName)
    return fail(ErrorCode::unknown_name, "a scripted visitor moves no real device", a.device,
                fmt::format("name a virtual one or '{}', or leave --device out", kPointerName));
  auto choice = haptic::read_virtual_options(name.options);
  if (!choice) return tl::unexpected(choice.error());
  if (!choice->stylus.hand)
    return fail(ErrorCode::conflict, "with hand=off the visitor cannot move the stylus", a.device,
                "leave hand=off out");
  a.options.device = *choice;
  a.options.player = visitor::fitted(a.options.player, *choice);
  return {};
}

int report(const std::string& json, bool complete, const std::string& file) {
  if (file.empty()) {
    std::fputs(json.c_str(), stdout);
  } else if (auto ok = write_whole(file, std::as_bytes(std::span(json)), WholeFile::document); !ok) {
    log::error(ok.error());
    return 1;
  }
  return complete ? 0 : 1;
}

int play_one(Arguments& a) {
  if (a.scenarios.size() != 1) {
    log::error(Error{a.scenarios.empty() ? ErrorCode::missing : ErrorCode::conflict,
                     fmt::format("{} scenarios were named", a.scenarios.size()), "--scenario",
                     "name one, or give --all to play several at once"});
    return 2;
  }
  a.options.scenario = a.scenarios.front();
  const auto result = visitor::run_visit(a.options, g_stop);
  if (!result) {
    log::error(result.error());
    return 2;
  }
  return report(visitor::to_json(*result), result->complete(), a.report_file);
}

int play_all(Arguments& a) {
  if (a.scenarios.empty()) a.scenarios = {"scenarios"};
  const auto found = visitor::find_scenarios(a.scenarios);
  if (!found) {
    log::error(found.error());
    return 2;
  }
  const std::vector<visitor::TourStop> stops = visitor::run_tour(a.options, *found, a.at_once, g_stop);
  std::fputs(visitor::tour_table(stops).c_str(), stdout);
  const bool complete = std::ranges::all_of(stops, &visitor::TourStop::complete);
  // People read the table; the JSON is written on request only.
  return a.report_file.empty() ? (complete ? 0 : 1) : report(visitor::to_json(stops), complete, a.report_file);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Plays a scenario's scripted visit over the network like a person.", "mechane visitor"};
  add_options(app, a);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  log::start("visitor", log::Level::info);
  a.options.client.role = client::Role::hand;
  a.options.client.program = "mechane-visitor";
  a.options.done_within = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(a.patience_s));
  a.options.linger = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(a.linger_s));
  if (a.offset.size() == 3) a.options.player.offset_W = Vec3(a.offset[0], a.offset[1], a.offset[2]);
  if (auto device = choose_device(a); !device) return log::error(device.error()), 2;
  if (a.direct) a.options.render = haptic::RenderMode::server;
  std::signal(SIGINT, [](int) { g_stop = 1; });
  std::signal(SIGTERM, [](int) { g_stop = 1; });
  return a.all ? play_all(a) : play_one(a);
}
