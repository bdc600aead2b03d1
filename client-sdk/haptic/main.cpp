// mechane-haptic: runs a haptic device at a kiosk. `--device virtual` is a simulated hand that strokes a place of the
// world.
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/virtual_device.hpp"
#include "server/base/whole_file.hpp"
#include "server/log/log.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/realtime/quantiles_json.hpp"

namespace {

using namespace mechane;

volatile std::sig_atomic_t g_stop = 0;  // set by the signal handler

struct Arguments {
  client::ClientConfig client;
  std::string device = "virtual";
  std::vector<double> center{0.0, 0.72, 0.19};
  double radius_m = 0.05;
  double seconds = 0;
  bool local = false;
  std::string report_file;
};

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--device", a.device, "'virtual': a simulated hand that strokes a circle")
      ->check(CLI::IsMember({"virtual"}));
  app.add_option("--kiosk", a.client.kiosk, "name of the kiosk");
  app.add_option("--user", a.client.user, "which hand of the kiosk, 0..3");
  app.add_option("--join", a.client.join_kiosk, "share the world of this kiosk");
  app.add_option("--domain", a.client.domain, "DDS domain");
  app.add_option("--center", a.center, "centre of the virtual hand's circle in the world, metres: x y z")->expected(3);
  app.add_option("--radius", a.radius_m, "radius of the circle, metres");
  app.add_option("--seconds", a.seconds, "stop after this time; 0: run until stopped");
  a.client.fifo_priority = 70;
  app.add_option("--fifo-priority", a.client.fifo_priority,
                 "SCHED_FIFO priority of the loop and of the thread that receives forces; 0: ordinary threads");
  app.add_option("--report", a.report_file, "write a JSON report to this file");
  app.add_flag("--local", a.local, "render forces from the local contact model");
}

/// A hand that strokes a circle in the x-y plane around `center`, once in four seconds.
haptic::HandIntent stroke(const Vec3& center, double radius_m, double t_s) {
  haptic::HandIntent intent;
  const double angle = 2 * kPi * t_s / 4;
  intent.X_WH.p = center + radius_m * Vec3(std::cos(angle), std::sin(angle), 0);
  return intent;
}

nlohmann::json to_json(const haptic::HapticLoop& loop, const realtime::PeriodicThread& thread) {
  const haptic::LoopStats& s = loop.stats();
  const realtime::PeriodicReport r = thread.report();
  nlohmann::json json = {{"ticks", s.ticks},
                         {"sent", s.sent},
                         {"answers", s.answers},
                         {"too_late", s.too_late},
                         {"silent_ticks", s.silent_ticks},
                         {"force_n", {{"max", s.force_max_n}, {"ticks", s.ticks_with_force}}},
                         {"overruns", r.overruns},
                         {"late_wakeups", r.late_wakeups},
                         {"skipped", r.skipped}};
  // Without an answer no round trip was measured.
  if (s.answers > 0) json["rtt_us"] = realtime::quantiles_json(loop.round_trip());
  return json;
}

/// Runs the loop on a thread of its own, and waits for the end.
int run(const Arguments& a, client::Client& client) {
  haptic::VirtualDevice device;
  auto loop =
      haptic::HapticLoop::create(client, device, a.local ? haptic::RenderMode::local : haptic::RenderMode::server);
  if (!loop) {
    log::error(loop.error());
    return 2;
  }
  SystemClock clock;
  realtime::PeriodicConfig config;
  config.name = "haptic-loop";
  config.fifo_priority = a.client.fifo_priority;
  realtime::PeriodicThread thread(config, clock);
  const Vec3 center(a.center[0], a.center[1], a.center[2]);
  std::atomic<bool> leave{false};
  std::atomic<bool> released{false};
  const auto tick = [&](const realtime::TickTiming& timing) {
    const Duration dt = config.period * static_cast<std::int64_t>(1 + timing.skipped);
    device.intend(stroke(center, a.radius_m, static_cast<double>(timing.index) * kTickSeconds));
    if (!leave.load(std::memory_order_relaxed)) {
      (*loop)->tick(timing.woke, dt);
    } else if ((*loop)->release(timing.woke, dt)) {
      released.store(true, std::memory_order_relaxed);
    }
  };
  if (auto started = thread.start(tick); !started) {
    log::error(started.error());
    return 2;
  }
  SystemClock waiting;
  const TimePoint end = waiting.now() + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(a.seconds));
  std::string told;
  while (g_stop == 0 && (a.seconds <= 0 || waiting.now() < end)) {
    std::string refusal = client.state() == client::LinkState::refused ? client.refusal() : std::string();
    if (!refusal.empty() && refusal != told) log::warning(refusal);
    told = std::move(refusal);
    waiting.sleep_until(waiting.now() + std::chrono::milliseconds(200));
  }
  // The force is ramped down before the loop ends, so that the hand does not feel the program stop.
  leave = true;
  for (int i = 0; i < 100 && !released; ++i)
    waiting.sleep_until(waiting.now() + std::chrono::milliseconds(10));
  thread.stop();
  const std::string json = to_json(**loop, thread).dump(2) + "\n";
  if (a.report_file.empty()) {
    std::fputs(json.c_str(), stdout);
    return 0;
  }
  const auto written = write_whole(a.report_file, std::as_bytes(std::span(json)), WholeFile::document);
  if (written) return 0;
  log::error(written.error());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Runs a haptic device at a kiosk: the hand goes to the server, the force comes back."};
  add_options(app, a);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;  // 2: wrong arguments, as in all programs of Mechane
  }
  log::start("haptic", log::Level::info);
  a.client.role = client::Role::hand;
  a.client.program = "mechane-haptic";
  std::signal(SIGINT, [](int) { g_stop = 1; });
  std::signal(SIGTERM, [](int) { g_stop = 1; });
  auto client = client::Client::connect(a.client);
  if (!client) {
    log::error(client.error());
    return 2;
  }
  return run(a, **client);
}
