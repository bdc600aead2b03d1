// mechane-devices: which drivers are there; tries a device with a gentle wall. It is also the program in which a driver runs.
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "client-sdk/haptic/device_thread.hpp"
#include "client-sdk/haptic/driver_host.hpp"
#include "client-sdk/haptic/virtual_hand.hpp"
#include "client-sdk/haptic/wall_test.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"
#include "server/log/printable.hpp"
#include "server/realtime/quantiles_json.hpp"

namespace {

using namespace mechane;
using namespace mechane::haptic;

constexpr std::chrono::milliseconds kLongestRead(100);  // as drivers are told

volatile std::sig_atomic_t g_stop = 0;  // set by the signal handler

struct Arguments {
  std::string test;
  std::string serve;
  double seconds = 0;
  int fifo_priority = 70;
  bool json = false;
};

int list(bool json) {
  std::vector<FoundDriver> drivers = find_drivers();
  drivers.insert(drivers.begin(),
                 {std::string(kVirtualName), "", std::string(kVirtualSummary), std::string(kVirtualOptions), ""});
  if (json) {
    nlohmann::json all = nlohmann::json::array();
    for (const FoundDriver& d : drivers)
      all.push_back(
          {{"name", d.name}, {"file", d.file}, {"summary", d.summary}, {"options", d.options}, {"fault", d.fault}});
    fmt::print("{}\n", all.dump(2));
    return 0;
  }
  for (const FoundDriver& d : drivers) {
    fmt::print("{:<14} {}\n", d.name, d.fault.empty() ? d.summary : d.fault);
    if (!d.options.empty()) fmt::print("{:<14}   options: {}\n", "", d.options);
  }
  fmt::print(
      "\nTry one: mechane devices --test NAME, or NAME:OPTION=VALUE,OPTION=VALUE\n"
      "Without hardware: mechane haptic --device {}, which strokes a circle\n"
      "Drivers are looked for in these folders; the first one of a name counts:\n",
      kVirtualName);
  for (const std::string& folder : driver_folders())
    fmt::print("  {}\n", folder);
  return 0;
}

const char* word(DeviceCondition condition) {
  constexpr const char* kWords[] = {"ready",    "clutch held", "switch released", "not ready", "not calibrated",
                                    "too warm", "gone"};
  return kWords[static_cast<std::size_t>(condition)];
}

/// What the loop's thread shows to the main thread.
struct Seen {
  WallReport wall;
  mechane_device_state state{};
};

void print_device(const mechane_device_info& i) {
  constexpr const char* kOutputs[] = {"no force", "a force", "a pull on each finger", "a brake on each finger"};
  fmt::print("{}: {}, {}", log::printable(i.name),
             i.hand != MECHANE_HAND_GLOVE  ? "one point"
             : i.side == MECHANE_HAND_LEFT ? "a left glove"
                                           : "a right glove",
             kOutputs[i.output]);
  if (i.peak_force_n > 0)
    fmt::print(", {:.2g} N for a moment, {:.2g} N for long", i.peak_force_n, i.continuous_force_n);
  if (i.peak_torque_nm > 0) fmt::print(", {:.2g} N m", i.peak_torque_nm);
  fmt::print(", {:.0f} times a second\n", i.rate_hz);
  if (i.output == MECHANE_OUTPUT_FORCE) fmt::print("A soft floor lies 1 cm under where the hand is when it is ready. ");
  if (i.peak_finger_force_n > 0) fmt::print("Fingers are held when they are half closed. ");
  fmt::print(
      "Ctrl-C ends the test.\n\nEach line: state; new samples within a second, and how late one came; place of the "
      "hand; force;\nenergy that the hand was given beyond what it gave, which should stay near 0.\n\n");
}

void print_line(const Seen& seen, const DevicePace::Seen& pace, double wanted_hz) {
  const WallReport& w = seen.wall;
  const std::string warmth = seen.state.temperature < 0 || w.condition == DeviceCondition::lost
                                 ? ""
                                 : fmt::format("  {:3.0f} % warm", 100 * seen.state.temperature);
  fmt::print(
      "{}{:<15} {:5.0f} /s, late by up to {:4.0f} us  at {:6.1f} {:6.1f} {:6.1f} mm  {:4.2f} N  given out {:5.2f} "
      "mJ{}{}",
      isatty(STDOUT_FILENO) != 0 ? "\r\033[K" : "", word(w.condition), pace.rate_hz,
      std::max(0.0, to_us(pace.longest) - 1e6 / wanted_hz), 1000 * w.p_WH.x(), 1000 * w.p_WH.y(), 1000 * w.p_WH.z(),
      w.force_n, 1000 * w.energy_out_j, warmth, isatty(STDOUT_FILENO) != 0 ? "" : "\n");
  std::fflush(stdout);
}

void print_report(const Seen& seen, const DeviceThread& thread, Duration longest_read, double seconds) {
  const nlohmann::json json = {{"ticks", seen.wall.ticks},
                               {"seconds", seconds},
                               {"read_ms_max", to_us(longest_read) / 1000},
                               {"interval_us", realtime::quantiles_json(thread.intervals())},
                               {"ticks_without_state", thread.without_state()},
                               {"force_max_n", seen.wall.force_max_n},
                               {"finger_force_max_n", seen.wall.finger_force_max_n},
                               {"energy_out_j", seen.wall.energy_out_j},
                               {"condition", word(seen.wall.condition)}};
  fmt::print("{}\n", json.dump(2));
}

int test(const Arguments& a) {
  const DeviceName name = parse_device_name(a.test);
  if (name.driver == kVirtualName)
    return log::error(Error{ErrorCode::not_supported, "a virtual device has nothing to test", a.test,
                            "run it at a kiosk: mechane haptic --device " + a.test}),
           2;
  DriverProcess device({.device = name, .fifo_priority = a.fifo_priority == 0 ? 0 : a.fifo_priority + 1});
  if (!a.json) fmt::print("Opening {}, which may take some seconds ...\n", a.test);
  std::fflush(stdout);
  if (auto opened = device.open(); !opened) return log::error(opened.error()), 2;
  auto wall = WallTest::make(device, device.info().max_stiffness_n_per_m);
  if (!wall) return log::error(wall.error()), 2;
  if (!a.json) print_device(device.info());
  realtime::Mailbox<Seen> box;
  Seen seen;
  const TimePoint begun = std::chrono::steady_clock::now();
  DeviceThread thread(device, a.fifo_priority, [&](TimePoint, Duration dt) {
    wall->tick(dt);
    box.publish({wall->report(), device.state()});
  });
  SystemClock clock;
  DevicePace pace(thread, begun);
  double passed_s = 0;
  for (; g_stop == 0 && (a.seconds <= 0 || passed_s < a.seconds); passed_s = to_seconds(clock.now() - begun)) {
    clock.sleep_until(clock.now() + std::chrono::milliseconds(100));
    (void)box.take_newest(seen);
    const DevicePace::Seen now = pace.look(clock.now());
    if (!a.json) print_line(seen, now, device.info().rate_hz);
    const auto news = device.check();
    if (!news) return log::error(news.error()), 1;
    if (*news) log::warning(**news);
  }
  thread.stop();
  device.write({});
  const Duration longest_read = device.longest_read();
  device.close();
  (void)box.take_newest(seen);
  a.json ? print_report(seen, thread, longest_read, passed_s) : fmt::print("\n");
  if (longest_read > kLongestRead)
    log::warning(fmt::format("read() took {:.0f} ms at most; a driver may wait {} ms (see mechane/driver.h)",
                             to_us(longest_read) / 1000, kLongestRead.count()));
  return seen.wall.was_lost || seen.wall.condition == DeviceCondition::lost ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Lists the drivers of haptic devices; with --test tries one: a gentle wall, without a server.",
               "mechane devices"};
  app.add_option("--test", a.test,
                 "try this device: NAME, or NAME:OPTION=VALUE,...; NAME may be a driver's file, with a slash in it");
  app.add_option("--seconds", a.seconds, "end the test after this time; 0: run until stopped")
      ->check(CLI::Range(0.0, 1e6));
  app.add_flag("--json", a.json, "print JSON");
  app.add_option("--fifo-priority", a.fifo_priority, "SCHED_FIFO priority; 0: ordinary threads")
      ->check(CLI::Range(0, 98));
  app.add_option("--serve", a.serve, "run a driver for a haptic loop; only Mechane's own programs use it")->group("");
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  if (!a.serve.empty()) return serve_driver(parse_device_name(a.serve), a.fifo_priority);
  log::start("devices", log::Level::info);
  std::signal(SIGINT, [](int) { g_stop = 1; });
  std::signal(SIGTERM, [](int) { g_stop = 1; });
  return a.test.empty() ? list(a.json) : test(a);
}
