// mechane-haptic: runs a haptic device at a kiosk, by way of its driver. `--device virtual` is a simulated one, in a hand that strokes a
// place of the world.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client-sdk/haptic/calibration_course.hpp"
#include "client-sdk/haptic/device_desk.hpp"
#include "client-sdk/haptic/device_thread.hpp"
#include "client-sdk/haptic/driver_process.hpp"
#include "client-sdk/haptic/hand_recorder.hpp"
#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/link_news.hpp"
#include "client-sdk/haptic/loop_turns.hpp"
#include "client-sdk/haptic/virtual_hand.hpp"
#include "server/base/whole_file.hpp"
#include "server/hand/hand_skeleton.hpp"
#include "server/log/command_line.hpp"
#include "server/log/log.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/realtime/quantiles_json.hpp"
#include <mechane/proto/names.hpp>

namespace {

using namespace mechane;

volatile std::sig_atomic_t g_stop = 0;  // set by signal handlers

/// A glove that rests for so long has lost its visitor.
constexpr Duration kVisitorLeft = std::chrono::minutes(2);

struct Arguments {
  client::ClientConfig client;
  bool check = false;
  std::string device = "virtual";
  std::vector<double> center;  ///< empty: center_of() chooses
  double turn_deg = 0;
  double scale = 1;
  int clutch = 0;
  bool calibrate = false;
  bool wait = false;
  double hand_length_m = hand::kHandLength_m;
  double radius_m = 0.05;
  double seconds = 0;
  TimePoint end = TimePoint::max();  ///< main() computes it from `seconds`
  bool direct = false;
  std::string report_file;
  std::string record_file;
};

CLI::Validator in_metres(double least_m, double most_m) {
  const auto check = [=](const std::string& text) {
    double value_m = 0;
    const bool fits = CLI::detail::lexical_cast(text, value_m) && value_m >= least_m && value_m <= most_m;
    return fits ? std::string() : fmt::format("'{}' is not a length of {:.3g} to {:.3g} metres", text, least_m, most_m);
  };
  return {check, fmt::format("METRES in [{:.3g}, {:.3g}]", least_m, most_m)};
}

/// For CLI11, as the next one: what is wrong, or nothing.
std::string fault_of_kiosk(const std::string& name) {
  const auto named = proto::check_name(name, "kiosk");
  return named ? "" : named.error().to_string();
}

/// A driver's options are its own to judge, when it opens its device.
std::string fault_of_device(const std::string& text) {
  const haptic::DeviceName name = haptic::parse_device_name(text);
  if (name.driver != haptic::kVirtualName) return "";
  const auto choice = haptic::read_virtual_options(name.options);
  return choice ? "" : choice.error().to_string();
}

void add_options(CLI::App& app, Arguments& a) {
  app.add_flag("--check", a.check, "only check the arguments, as 'mechane doctor' does with those of a kiosk's unit");
  app.add_option("--device", a.device,
                 fmt::format("NAME, or NAME:OPTION=VALUE,...: a driver ('mechane devices' lists them), or '{}', a "
                             "simulated stylus or glove that strokes a circle (options: {})",
                             haptic::kVirtualName, haptic::kVirtualOptions))
      ->check(fault_of_device);
  app.add_option("--kiosk", a.client.kiosk, "name of the kiosk")->check(fault_of_kiosk);
  app.add_option("--user", a.client.user, "which hand of the kiosk, 0..3")
      ->check(CLI::Range(0u, static_cast<unsigned>(hand::kMaxUsers - 1)));
  app.add_option("--join", a.client.join_kiosk, "share the world of this kiosk")->check(fault_of_kiosk);
  app.add_option("--domain", a.client.domain, "DDS domain");
  app.add_option("--center", a.center,
                 "where the middle of the device's workspace, or of the virtual hand's circle, lies in the world, "
                 "metres: x y z; without it 0 0.72 0.19, and 0 0 0 for a recording that is played")
      ->expected(3)
      ->check(in_metres(-hand::kFarthestHand_m, hand::kFarthestHand_m));
  app.add_option("--turn", a.turn_deg, "how the device is turned at its place, degrees anticlockwise from above");
  app.add_option("--scale", a.scale, "metres in the world for one of the device's, 1 to 100; forces are divided by it")
      ->check(CLI::Range(1.0, 100.0));
  app.add_option("--clutch", a.clutch,
                 "the device's button, 1 to 32, that holds the hand in its place while the device is moved; 0: none")
      ->check(CLI::Range(0, 32));
  app.add_flag(
      "--calibrate", a.calibrate,
      "fit a glove to the visitor's hand by three poses (flat, fist, pinch), which the kiosk's displays show: at the "
      "start, and for each next visitor, when the glove was still for two minutes or the signal USR1 came; a virtual "
      "glove shows the poses once");
  app.add_option("--hand-length", a.hand_length_m,
                 "length of the visitor's hand, from the wrist to the tip of the middle finger, metres; a device that "
                 "sees the hand measures it itself")
      ->check(in_metres(hand::kMinHandScale * hand::kHandLength_m, hand::kMaxHandScale * hand::kHandLength_m));
  app.add_flag(
      "--wait", a.wait,
      "where the device cannot be opened, for whatever reason, say why and go on trying, each second; displays "
      "say meanwhile that it is not connected");
  app.add_option("--radius", a.radius_m, "radius of the circle, metres")->check(in_metres(0, 10));
  app.add_option("--seconds", a.seconds, "stop after this time; 0: run until stopped")->check(CLI::Range(0.0, 1e9));
  a.client.fifo_priority = 70;
  app.add_option("--fifo-priority", a.client.fifo_priority,
                 "SCHED_FIFO priority of the loop and of the thread that receives forces; 0: ordinary threads");
  app.add_option("--report", a.report_file, "write a JSON report to this file");
  app.add_option("--record", a.record_file,
                 "record the hand to this file, to be played with --device playback:file=FILE");
  app.add_option(
         "--deadband", a.client.deadband,
         "for a weak network: leave out hands and forces that differ by no more than this share of what is felt, "
         "0 to 0.5; 0: send each")
      ->check(CLI::Range(0.0, hand::kMaxDeadband));
  app.add_flag("--direct", a.direct,
               "render the server's forces, not contacts and held paths at the device's own rate");
}

/// By which staff ask for a calibration. It is blocked, so that it interrupts nothing, and waits until it is taken.
sigset_t calibration_signal() {
  sigset_t usr1;
  ::sigemptyset(&usr1);
  ::sigaddset(&usr1, SIGUSR1);
  return usr1;
}

/// Whether staff have asked for a calibration since the last call.
bool take_calibration_signal() {
  const sigset_t usr1 = calibration_signal();
  const timespec at_once{};
  return ::sigtimedwait(&usr1, nullptr, &at_once) == SIGUSR1;
}

/// Whether it is time to stop: by a signal, or because --seconds are over.
bool is_over(const Arguments& a) {
  return g_stop != 0 || std::chrono::steady_clock::now() >= a.end;
}

/// What this run's loops did together: each calibration ends one and begins another.
struct Record {
  haptic::LoopStats stats;
  realtime::LatencyHistogram round_trip, intervals;
  std::uint64_t without_state = 0;
  std::string device;  // empty: no loop has run
};

/// The loop's thread has ended.
void add(Record& record, const haptic::HapticLoop& loop) {
  haptic::LoopStats& sum = record.stats;
  const haptic::LoopStats& s = loop.stats();
  sum.ticks += s.ticks;
  sum.sent += s.sent;
  sum.answers += s.answers;
  sum.too_late += s.too_late;
  sum.silent_ticks += s.silent_ticks;
  sum.warm_ticks += s.warm_ticks;
  sum.ticks_with_force += s.ticks_with_force;
  sum.force_max_n = std::max(sum.force_max_n, s.force_max_n);
  record.round_trip.merge(loop.round_trip());
}

nlohmann::json to_json(const Record& record) {
  const haptic::LoopStats& s = record.stats;
  nlohmann::json json = {{"ticks", s.ticks},
                         {"sent", s.sent},
                         {"answers", s.answers},
                         {"too_late", s.too_late},
                         {"silent_ticks", s.silent_ticks},
                         {"warm_ticks", s.warm_ticks},
                         {"force_n", {{"max", s.force_max_n}, {"ticks", s.ticks_with_force}}}};
  // Without an answer no round trip was measured.
  if (s.answers > 0) json["rtt_us"] = realtime::quantiles_json(record.round_trip);
  return json;
}

int report(const Arguments& a, const nlohmann::json& found) {
  const std::string json = found.dump(2) + "\n";
  if (a.report_file.empty()) {
    std::fputs(json.c_str(), stdout);
    return 0;
  }
  const auto written = write_whole(a.report_file, std::as_bytes(std::span(json)), WholeFile::document);
  if (written) return 0;
  log::error(written.error());
  std::fputs(json.c_str(), stdout);  // the run is over: its figures are not lost
  return 1;
}

/// Writes what was recorded. False: no more can be.
bool keep(haptic::HandRecorder& recorder) {
  const auto written = recorder.write();
  if (!written) log::error(written.error());
  return written.has_value();
}

struct Link {
  client::Client& client;
  haptic::LinkNews news;
};

void tell_news(Link& link, TimePoint now) {
  const client::LinkState state = link.client.state();
  const std::string refusal = state == client::LinkState::refused ? link.client.refusal() : std::string();
  const auto line = link.news.look(state, refusal, now);
  if (line) line->level == log::Level::warning ? log::warning(line->text) : log::info(line->text);
}

/// Until it is time to stop, or `look`, which is called five times a second, returns false.
void wait_for_end(const Arguments& a, Link& link, haptic::HandRecorder* recorder, const std::function<bool()>& look) {
  SystemClock clock;
  while (!is_over(a) && look()) {
    tell_news(link, clock.now());
    if (recorder != nullptr && !keep(*recorder)) recorder = nullptr;
    clock.sleep_until(clock.now() + std::chrono::milliseconds(200));
  }
}

Expected<std::unique_ptr<haptic::HapticLoop>> make_loop(const Arguments& a, client::Client& client,
                                                        haptic::Device& device) {
  return haptic::HapticLoop::create(client, device, a.direct ? haptic::RenderMode::server : haptic::RenderMode::local,
                                    a.client.deadband);
}

struct GloveNow {
  haptic::HandAngles angles;
  haptic::DeviceCondition condition;
};

/// Waits for the glove's next angles. Told what the visitor is asked to show.
using LookAtGlove = std::function<Expected<GloveNow>(client::CalibrationStep asked)>;

/// Whether this glove's course, which is at `step`, has to wait because another glove of the kiosk is being fitted: displays ask for one
/// pose at a time. Where two have begun together, the one with the lower number goes on.
bool gives_way(const Arguments& a, client::Client& client, client::CalibrationStep step) {
  using client::CalibrationStep;
  if (step != CalibrationStep::none && step != CalibrationStep::flat) return false;
  return std::ranges::any_of(client.devices(), [&](const client::DeviceReport& other) {
    const bool asks = other.user != a.client.user && client::pose_of(other.calibration.step);
    return asks && (step == CalibrationStep::none || other.user < a.client.user);
  });
}

/// Leads a visitor through the poses. None: they were not shown, and with --wait the visitor goes on without. The main thread.
Expected<std::optional<haptic::HandCalibration>> lead(const Arguments& a, client::Client& client,
                                                      client::DeviceReport told, const LookAtGlove& look) {
  std::optional<haptic::CalibrationCourse> course(std::in_place);
  while (!course->result()) {
    if (is_over(a)) return fail(ErrorCode::cancelled, "stopped during the calibration", a.device);
    const auto glove = look(course->news().step);
    if (!glove) return tl::unexpected(glove.error());
    const bool ready = glove->condition == haptic::DeviceCondition::ready;
    if (gives_way(a, client, course->news().step))
      course.emplace();
    else if (const auto message = course->add(std::chrono::steady_clock::now(), ready ? &glove->angles : nullptr))
      log::info(*message);
    told.calibration = course->news();
    told.state = course->device_state(glove->condition);
    client.tell_device(told);
  }
  if (*course->result()) return **course->result();
  const Error& error = course->result()->error();
  if (!a.wait) return tl::unexpected(error);
  log::warning(error.to_string() + "; the visitor goes on with the glove's own angles");
  return std::nullopt;
}

/// Of a device that is not open yet: that it is a glove is known where it is to be fitted to a hand.
client::DeviceReport unopened(const Arguments& a) {
  return {.kind = a.calibrate ? client::HandKind::glove : client::HandKind::one_point,
          .name = haptic::parse_device_name(a.device).driver};
}

/// Tells the kiosk's displays of the device. The main thread.
void tell_state(client::Client& client, client::DeviceReport report, client::DeviceState state) {
  report.state = state;
  client.tell_device(report);
}

Vec3 center_of(const Arguments& a) {
  if (!a.center.empty()) return {a.center[0], a.center[1], a.center[2]};
  const bool played = haptic::parse_device_name(a.device).driver == "playback";  // its places are in the world
  return played ? Vec3(Vec3::Zero()) : Vec3(0.0, 0.72, 0.19);
}

/// The simulated hand shows what it is asked for.
Expected<void> calibrate_virtual(const Arguments& a, client::Client& client, const client::DeviceReport& told,
                                 haptic::SimulatedDevice& device) {
  constexpr Duration kPace = std::chrono::milliseconds(20);
  SystemClock clock;
  const TimePoint begun = clock.now();
  return lead(a, client, told,
              [&](client::CalibrationStep asked) -> Expected<GloveNow> {
                clock.sleep_until(clock.now() + kPace);
                device.intend(haptic::show(asked, center_of(a), to_seconds(clock.now() - begun)));
                return GloveNow{device.read(kPace).joints, haptic::DeviceCondition::ready};
              })
      .map([](const auto& /*fits*/) {});
}

/// The program's status where its device was not opened, or its glove not fitted: 0 where it was stopped meanwhile.
int given_up(const Arguments& a, const Error& error) {
  if (error.code == ErrorCode::cancelled || (a.wait && is_over(a))) return 0;
  log::error(error);
  return 2;
}

/// A virtual device has no clock of its own: its loop runs at 1 kHz.
int run_virtual(const Arguments& a, const std::string& options, Link& link, haptic::HandRecorder* recorder) {
  const auto choice = haptic::read_virtual_options(options);
  if (!choice) return log::error(choice.error()), 2;
  const auto intent = [&](double t_s) { return haptic::stroke(choice->hand, center_of(a), a.radius_m, t_s); };
  const auto device = haptic::make_virtual_device(*choice, intent(0).X_WH.p);
  client::DeviceReport told{.kind = choice->hand, .side = choice->side, .name = std::string(haptic::kVirtualName)};
  if (a.calibrate && choice->hand == client::HandKind::glove) {
    // What comes out is not needed: the angles of a simulated hand are those of Mechane's.
    const auto shown = calibrate_virtual(a, link.client, told, *device);
    if (!shown) return given_up(a, shown.error());
    told.calibration.step = client::CalibrationStep::done;
  }
  auto loop = make_loop(a, link.client, *device);
  if (!loop) return log::error(loop.error()), 2;
  SystemClock clock;
  realtime::PeriodicConfig config;
  config.name = "haptic-loop";
  config.fifo_priority = a.client.fifo_priority;
  realtime::PeriodicThread thread(config, clock);
  haptic::LoopTurns turns(**loop, recorder);
  client::DeviceDetails details{.place = {.p_WD = center_of(a)}};
  const hand::GovernorConfig limits = device->limits();
  details.limits = {.wanted_hz = 1 / kTickSeconds,
                    .peak_force_n = limits.max_force_n,
                    .continuous_force_n = device->continuous_force_n(),
                    .peak_torque_nm = limits.max_torque_nm,
                    .peak_finger_force_n = limits.max_finger_force_n};
  TimePoint next_details;
  const auto started = thread.start([&](const realtime::TickTiming& timing) {
    device->intend(intent(static_cast<double>(timing.index) * kTickSeconds));
    turns.turn(timing.woke, config.period * static_cast<std::int64_t>(1 + timing.skipped));
  });
  if (!started) return log::error(started.error()), 2;
  wait_for_end(a, link, recorder, [&] {
    tell_state(link.client, told, (*loop)->device_state());
    haptic::turn_down(link.client, turns, details, clock.now(), next_details);
    return true;
  });
  (void)turns.pause();
  thread.stop();
  Record record;
  add(record, **loop);
  nlohmann::json json = to_json(record);
  const realtime::PeriodicReport r = thread.report();
  json.update({{"overruns", r.overruns}, {"late_wakeups", r.late_wakeups}, {"skipped", r.skipped}});
  return report(a, json);
}

haptic::DriverProcessConfig driver_config(const Arguments& a, const client::DevicePlace& place) {
  const int fifo = a.client.fifo_priority;
  return {.device = haptic::parse_device_name(a.device),
          .workspace = {.place = place, .clutch_button = a.clutch == 0 ? 0 : 1u << static_cast<unsigned>(a.clutch - 1)},
          .fifo_priority = fifo == 0 ? 0 : std::min(fifo + 1, 99),
          .hand_scale = a.hand_length_m / hand::kHandLength_m};
}

client::DeviceReport report_of(const mechane_device_info& info) {
  return {.kind = info.hand == MECHANE_HAND_GLOVE ? client::HandKind::glove : client::HandKind::one_point,
          .side = static_cast<client::HandSide>(info.side),
          .name = info.name};
}

/// Opens the glove for it, and lets it go.
Expected<std::optional<haptic::HandCalibration>> calibrated(const Arguments& a, client::Client& client) {
  haptic::DriverProcess glove(driver_config(a, {}));
  if (auto opened = glove.open(); !opened) return tl::unexpected(opened.error());
  if (glove.info().hand != MECHANE_HAND_GLOVE)
    return fail(ErrorCode::conflict, "only a glove can be calibrated", a.device, "start it without --calibrate");
  const auto look = [&](client::CalibrationStep /*asked*/) -> Expected<GloveNow> {
    const auto news = glove.check();
    if (!news) return tl::unexpected(news.error());
    if (*news) log::warning(**news);
    (void)glove.wait(std::chrono::milliseconds(20));
    const haptic::HandAngles angles = glove.read(kTickPeriod).joints;
    return GloveNow{angles, glove.condition()};
  };
  return lead(a, client, report_of(glove.info()), look);
}

/// What `open` opens: with --wait it is called each second until it does, or until it is time to stop.
template <class Open>
auto opened(const Arguments& a, Link& link, const Open& open) {
  auto result = open();
  if (result || !a.wait) return result;
  std::string told;
  SystemClock clock;
  TimePoint next = clock.now();
  wait_for_end(a, link, nullptr, [&] {
    if (clock.now() < next) return true;
    next = clock.now() + std::chrono::seconds(1);
    std::string why = result.error().to_string();
    if (why != told) log::warning(why + "; trying again each second");
    told = std::move(why);
    tell_state(link.client, unopened(a), client::DeviceState::lost);
    result = open();
    return !result;
  });
  return result;
}

/// Whether the glove is to be fitted to a hand now: staff asked for it, or the visitor has left.
bool calibrates_again(const Arguments& a, const haptic::HandMotion& motion) {
  return take_calibration_signal() ||
         (a.calibrate && motion.rests_for(std::chrono::steady_clock::now()) > kVisitorLeft);
}

/// The device sets the pace of its loop. Returns the program's status; none: its glove has to be fitted to a hand first.
std::optional<int> run_device(const Arguments& a, Link& link, haptic::HandRecorder* recorder,
                              haptic::DriverProcess& device, bool fitted, Record& record,
                              client::DeviceDetails& details) {
  auto loop = opened(a, link, [&] { return make_loop(a, link.client, device); });
  if (!loop) return given_up(a, loop.error());
  log::info(std::string("device: ") + device.info().name);
  client::DeviceReport told = report_of(device.info());
  if (fitted) told.calibration.step = client::CalibrationStep::done;
  haptic::LoopTurns turns(**loop, recorder);
  haptic::HandMotion motion(a.scale);
  haptic::DeviceThread thread(device, a.client.fifo_priority, [&](TimePoint now, Duration dt) {
    turns.turn(now, dt, device.state().temperature);
    motion.note(now, (*loop)->hand().joints, (*loop)->hand().X_WH);
  });
  SystemClock clock;
  haptic::DeviceDesk desk(link.client, device, **loop, turns, thread, details, clock.now());
  bool failed = false, again = false;
  wait_for_end(a, link, recorder, [&] {
    tell_state(link.client, told, desk.state());
    desk.look(clock.now());
    const auto news = device.check();
    if (!news) log::error(news.error());
    failed = !news;
    if (news && *news) log::warning(**news);
    const bool there = told.kind == client::HandKind::glove && (*loop)->device_state() != client::DeviceState::lost;
    again = there && (desk.fits() || calibrates_again(a, motion));
    return !failed && !again;
  });
  if (!failed) (void)turns.pause();
  thread.stop();
  add(record, **loop);
  record.device = device.info().name;
  record.intervals.merge(thread.intervals());
  record.without_state += thread.without_state();
  if (failed) return 1;
  return again ? std::nullopt : std::optional(0);
}

/// Fits the glove to a hand, where `calibrate`, and runs the device. Returns what run_device() does.
std::optional<int> run_once(const Arguments& a, Link& link, haptic::HandRecorder* recorder, bool calibrate,
                            Record& record, client::DeviceDetails& details) {
  haptic::DriverProcessConfig config = driver_config(a, details.place);
  tell_state(link.client, unopened(a), client::DeviceState::preparing);
  if (calibrate) {
    auto calibration = opened(a, link, [&] { return calibrated(a, link.client); });
    if (!calibration) return given_up(a, calibration.error());
    config.glove = *calibration;
    (void)take_calibration_signal();  // asked for meanwhile: it is done
  }
  const bool fitted = config.glove.has_value();
  haptic::DriverProcess device(std::move(config));
  return run_device(a, link, recorder, device, fitted, record, details);
}

int run_driver(const Arguments& a, Link& link, haptic::HandRecorder* recorder) {
  log::info("opening the device, which may take some seconds");
  Record record;
  client::DeviceDetails details{.place = {center_of(a), a.turn_deg * kPi / 180, a.scale}};
  std::optional<int> status = run_once(a, link, recorder, a.calibrate, record, details);
  while (!status)
    status = run_once(a, link, recorder, true, record, details);
  if (record.device.empty()) return *status;
  nlohmann::json json = to_json(record);
  json.update({{"device", record.device},
               {"interval_us", realtime::quantiles_json(record.intervals)},
               {"ticks_without_state", record.without_state}});
  const int reported = report(a, json);
  return *status != 0 ? *status : reported;
}

}  // namespace

int main(int argc, char** argv) {
  const sigset_t usr1 = calibration_signal();
  ::pthread_sigmask(SIG_BLOCK, &usr1, nullptr);  // before there are other threads, which inherit it
  Arguments a;
  CLI::App app{"Runs a haptic device at a kiosk: the hand goes to the server, the force comes back.", "mechane haptic"};
  add_options(app, a);
  if (const std::optional<int> status = parse_command_line(app, argc, argv)) return *status;
  if (a.check) return 0;
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
  if (a.seconds > 0)
    a.end = std::chrono::steady_clock::now() +
            std::chrono::duration_cast<Duration>(std::chrono::duration<double>(a.seconds));
  std::unique_ptr<haptic::HandRecorder> recorder;
  if (!a.record_file.empty()) {
    auto opened = haptic::HandRecorder::open(a.record_file);
    if (!opened) {
      log::error(opened.error());
      return 2;
    }
    recorder = std::move(*opened);
  }
  Link link{**client, haptic::LinkNews(a.client)};
  const haptic::DeviceName name = haptic::parse_device_name(a.device);
  const int status = name.driver == haptic::kVirtualName ? run_virtual(a, name.options, link, recorder.get())
                                                         : run_driver(a, link, recorder.get());
  if (recorder && !keep(*recorder)) return 1;
  if (recorder && recorder->lost() > 0)
    log::warning(fmt::format("{} samples of the hand were not recorded", recorder->lost()));
  return status;
}
