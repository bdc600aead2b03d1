// How stiff a wall may be, how still a press is, and how true grooves and clicks are: a simulated stylus
// (client-sdk/haptic/simulated_stylus.hpp) on a simulated clock, so that the figures are the same on every machine.
#include <algorithm>
#include <cmath>
#include <complex>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "client-sdk/haptic/click_pulse.hpp"
#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/collision/superquadric_object.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/fault_play.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/held_crank.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::benchmark {
namespace {

using namespace std::chrono_literals;
using haptic::SimulatedStylus;
using haptic::StylusConfig;
using test::Network;

const Vec3 kWeight_W(0, -0.5, 0);

/// The range that a number went through.
struct Range {
  double low = 1e9, high = -1e9;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// The wall y < 0 as the local contact model renders it, without damping, friction or governor.
hand::LocalContactModel wall(double stiffness_n_per_m) {
  hand::LocalContact contact{.n_W = Vec3::UnitY(), .stiffness_n_per_m = stiffness_n_per_m};
  contact.validity = 1h;
  hand::LocalContactModel model;
  model.set(std::span(&contact, 1), Vec3::Zero());
  return model;
}

/// How far the stylus moves to and fro on the wall in this time, m.
double moves_on(hand::LocalContactModel& wall, SimulatedStylus& stylus, Duration time) {
  Range y;
  for (Duration past{0}; past < time; past += kTickPeriod) {
    const client::HandSample sample = stylus.read(kTickPeriod);
    hand::HandForce force;
    force.force_W.f = wall.render(sample.X_WH.p, sample.V_WH.v, 0ms);
    stylus.write(force);
    y.add(stylus.p_WH().y());
  }
  return y.size();
}

/// Whether a stylus that lies on the wall with its weight, and is hit so little that it stays there, comes to rest: after ten seconds it
/// moves less than at first, or within the steps of its encoders.
bool is_stable(const StylusConfig& config, double stiffness_n_per_m) {
  SimulatedStylus stylus(config, kWeight_W / stiffness_n_per_m);
  hand::LocalContactModel model = wall(stiffness_n_per_m);
  stylus.push(Vec3(0, -0.01, 0));
  const double early_m = moves_on(model, stylus, 100ms);
  moves_on(model, stylus, 9s);
  const double late_m = moves_on(model, stylus, 1s);
  return late_m < early_m || late_m <= 1.5 * config.resolution_m;
}

double largest_stable_n_per_m(const StylusConfig& config) {
  double low = 1, high = 100'000;
  while (high / low > 1.005) {
    const double middle = std::sqrt(low * high);
    (is_stable(config, middle) ? low : high) = middle;
  }
  return low;
}

void measure_walls(Report& report) {
  const StylusConfig honest{.load_W = kWeight_W};
  StylusConfig bare = honest;
  bare.coulomb_n = 0;
  bare.resolution_m = 1e-8;
  report.note(fmt::format("the simulated stylus: {:g} g, {:g} N s/m, {:g} N of dry friction, steps of {:g} um",
                          1e3 * honest.mass_kg, honest.viscous_ns_per_m, honest.coulomb_n, 1e6 * honest.resolution_m));
  const auto limit_n_per_m = [&bare](double delay_ms) {
    return bare.viscous_ns_per_m / ((0.5 + delay_ms) * kTickSeconds);
  };
  std::vector<std::array<double, 2>> theory, measured;
  for (double delay_ms = 0; delay_ms <= 20; delay_ms += 0.25)
    theory.push_back({delay_ms, limit_n_per_m(delay_ms)});
  for (const std::uint32_t delay : {0u, 1u, 2u, 5u, 10u, 20u}) {
    bare.delay = delay;
    const double largest = largest_stable_n_per_m(bare);
    measured.push_back({static_cast<double>(delay), largest});
    report.metric(delay == 0 ? "wall.k_ratio" : "wall.delay" + std::to_string(delay) + ".k_ratio",
                  largest / limit_n_per_m(delay));
  }
  report.curve("wall.theory", theory);
  report.curve("wall.measured", measured);
  const double passive =
      std::min(2 * honest.viscous_ns_per_m / kTickSeconds, 2 * honest.coulomb_n / honest.resolution_m);
  report.metric("wall.with_friction.k_ratio", largest_stable_n_per_m(honest) / passive);
}

constexpr double kFloor_n_per_m = 600;  // what the exhibits' parts have at most
constexpr double kTip_m = 0.008;        // radius: the tip touches the floor when its middle is at y = 0

/// A client's whole loop, and a hand that presses its stylus onto a floor, or something else, which a server at the other end of a network
/// renders.
class Press {
 public:
  Press(haptic::RenderMode mode, const StylusConfig& config, const Network& network = {}, unsigned seed = 1,
        test::FloorServer server = {-kTip_m, kFloor_n_per_m})
      : server_(std::move(server)), stylus_(config, Vec3(0, kAbove_m, 0)), network_(client_, network, seed) {
    auto made = haptic::HapticLoop::create(client_, stylus_, mode, network.deadband);
    if (!made) throw std::runtime_error(made.error().to_string());
    loop_ = std::move(*made);
  }

  static constexpr double kAbove_m = 0.02;
  static constexpr double kInside_m = -0.008;

  struct Felt {
    Range force_n;
    double last_force_n = 0;
    double last_depth_m = 0;
  };
  /// The hand goes to `y_m` and stays there.
  Felt press(double y_m, Duration time, bool answered = true) {
    Felt felt;
    for (Duration past{0}; past < time; past += kTickPeriod) {
      y_m_ += std::clamp(y_m - y_m_, -1e-4, 1e-4);
      tick(Vec3(0, y_m_, 0), answered);
      felt.last_force_n = loop_->rendered().force_W.f.norm();
      felt.force_n.add(felt.last_force_n);
    }
    felt.last_depth_m = -stylus_.p_WH().y();
    return felt;
  }
  /// A millisecond in which the hand wants to be at `p_WH`.
  void tick(const Vec3& p_WH, bool answered = true) {
    now_ += kTickPeriod;
    if (answered) network_.send(server_.answer(client_.hand), now_);
    network_.deliver(now_);
    stylus_.intend(p_WH);
    const Vec3 force_W = stylus_.force_W();
    const Vec3 before = stylus_.p_WH();
    loop_->tick(now_, kTickPeriod);
    energy_j_ += force_W.dot(stylus_.p_WH() - before);
    energy_max_j_ = std::max(energy_max_j_, energy_j_);
  }
  /// From now on the hand has one click more.
  void click(double strength_n) {
    hand::Clicks& clicks = server_.user().clicks;
    clicks = {clicks.count + 1, strength_n};
  }
  [[nodiscard]] Vec3 force_W() const { return loop_->rendered().force_W.f; }
  /// Where the stylus really is.
  [[nodiscard]] const Vec3& p_WH() const { return stylus_.p_WH(); }
  [[nodiscard]] const haptic::LoopStats& stats() const { return loop_->stats(); }
  [[nodiscard]] const test::SlowNetwork& network() const { return network_; }
  /// The most that the hand was ever given beyond what it had put in, J.
  [[nodiscard]] double energy_max_j() const { return energy_max_j_; }

 private:
  test::ScriptedClient client_;
  test::FloorServer server_;
  SimulatedStylus stylus_;
  test::SlowNetwork network_;
  std::unique_ptr<haptic::HapticLoop> loop_;
  TimePoint now_{1h};
  double y_m_ = kAbove_m;
  double energy_j_ = 0;
  double energy_max_j_ = 0;
};

constexpr std::array<std::pair<haptic::RenderMode, const char*>, 2> kModes{
    {{haptic::RenderMode::server, "direct"}, {haptic::RenderMode::local, "local"}}};

/// A stylus that lies there by itself; and one whose contact resumes after half a second without answers.
void measure_presses(Report& report) {
  const StylusConfig lying{.load_W = kWeight_W};
  const StylusConfig held{.hand = haptic::ArmConfig{}};
  double cycle = 0, resumed_n = 0, again_n = 0;
  for (const auto& [mode, name] : kModes) {
    Press rest(mode, lying);
    rest.press(0, 10s);
    cycle = std::max(cycle, rest.press(0, 1s).force_n.size() / (1.5 * kFloor_n_per_m * lying.resolution_m));
    Press press(mode, held);
    press.press(Press::kAbove_m, 1s);
    press.press(Press::kInside_m, 1s);
    press.press(Press::kInside_m, 500ms, false);
    resumed_n = std::max(resumed_n, press.press(Press::kInside_m, 3s).force_n.size());
    press.press(Press::kAbove_m, 1s);
    press.press(Press::kInside_m, 1s);
    again_n = std::max(again_n, press.press(Press::kInside_m, 1s).force_n.size());
  }
  report.metric("wall.limit_cycle_ratio", cycle);
  report.metric("resume.swing_n", resumed_n);
  report.metric("resume.again_swing_n", again_n);
}

/// What a network does to a press: energy, peak, and the force of a steady press at the same depth, all against 1 ms.
struct Pressed {
  double energy_j = 0, peak_n = 0, stiffness_n_per_m = 0;
};

Pressed press_over(haptic::RenderMode mode, const Network& network, unsigned seed) {
  Press press(mode, {.hand = haptic::ArmConfig{}}, network, seed);
  Pressed found;
  press.press(Press::kAbove_m, 1s);
  for (int i = 0; i < 5; ++i) {
    found.peak_n = std::max(found.peak_n, press.press(Press::kInside_m, 1s).force_n.high);
    const Press::Felt steady = press.press(Press::kInside_m, 1s);
    found.stiffness_n_per_m = steady.last_force_n / std::max(steady.last_depth_m, 1e-6);
    press.press(Press::kAbove_m, 1s);
  }
  found.energy_j = press.energy_max_j();
  return found;
}

/// A stylus that holds a crank, and pulls its handle across the circle on which it turns.
Pressed pull_over(haptic::RenderMode mode, const Network& network, unsigned seed) {
  test::HeldCrank crank(mode, network, seed);
  const double stiffness = crank.stiffness_across();
  return {.energy_j = crank.energy_max_j(), .stiffness_n_per_m = stiffness};
}

/// The worst of several networks with the same delay.
Pressed worst_over(decltype(press_over) play, haptic::RenderMode mode, int delay_ms, unsigned networks) {
  Pressed worst{.stiffness_n_per_m = 1e9};
  for (unsigned seed = 1; seed <= networks; ++seed) {
    const Pressed one = play(mode, {delay_ms, 5, 0.05}, seed);
    worst.energy_j = std::max(worst.energy_j, one.energy_j);
    worst.peak_n = std::max(worst.peak_n, one.peak_n);
    worst.stiffness_n_per_m = std::min(worst.stiffness_n_per_m, one.stiffness_n_per_m);
  }
  return worst;
}

void measure_delays(Report& report) {
  const Pressed near = press_over(haptic::RenderMode::server, {.delay_ms = 1}, 1);
  const Pressed near_held = pull_over(haptic::RenderMode::server, {.delay_ms = 1}, 1);
  for (const int delay_ms : {20, 50}) {
    for (const auto& [mode, name] : kModes) {
      const Pressed worst = worst_over(press_over, mode, delay_ms, 20);
      const std::string at = "delay" + std::to_string(delay_ms) + "." + name;
      report.metric(at + ".energy_mj.max", 1000 * worst.energy_j);
      report.metric(at + ".peak_ratio", worst.peak_n / near.peak_n);
      report.metric(at + ".force_share.min", worst.stiffness_n_per_m / near.stiffness_n_per_m);
      test::HeldCrank carried(mode, {delay_ms, 5, 0.05}, 1, test::make_loose_crank());
      report.metric(at + ".carried.force_share", carried.weight_share());
      const Pressed held = worst_over(pull_over, mode, delay_ms, 5);
      report.metric(at + ".held.energy_mj.max", 1000 * held.energy_j);
      report.metric(at + ".held.force_share.min", held.stiffness_n_per_m / near_held.stiffness_n_per_m);
    }
  }
}

/// A place of a stylus across grooves, and the force along it.
struct Stroked {
  double x_m = 0, force_n = 0;
};

/// How strongly a force changes to and fro with each `distance_m`, N.
double swing_n(const std::vector<Stroked>& felt, double distance_m) {
  double mean_n = 0;
  for (const Stroked& at : felt)
    mean_n += at.force_n / static_cast<double>(felt.size());
  std::complex<double> sum_n;
  for (const Stroked& at : felt)
    sum_n += (at.force_n - mean_n) * std::polar(1.0, 2 * kPi * at.x_m / distance_m);
  return 2 * std::abs(sum_n) / static_cast<double>(felt.size());
}

/// A hand strokes across the deepest grooves of that distance, at 50 mm/s and some 2 N. How far apart its ridges feel, and how steep (the
/// force aside over the force up), both over what is set.
void stroke_grooves(Report& report, const std::string& name, haptic::RenderMode mode, int delay_ms, double distance_m) {
  constexpr double kHalfWay_m = 0.05, kMeasured_m = 0.04, kSpeed_m_per_s = 0.05;  // measured are 20 or 8 grooves
  const double wave_rad_per_m = 2 * kPi / distance_m;
  state::HapticMaterial haptic{.stiffness_n_per_m = kFloor_n_per_m};
  haptic.groove_depth_m = hand::max_groove_depth_m(wave_rad_per_m);
  haptic.groove_wave_B = wave_rad_per_m * Vec3::UnitX();
  Press press(mode, {.hand = haptic::ArmConfig{}}, {.delay_ms = delay_ms}, 1, test::FloorServer(haptic));
  const auto stroke = [&](double t_s) {
    const double along_m = kSpeed_m_per_s * (t_s - 1) - kHalfWay_m;  // first a second to come down
    return Vec3(std::max(along_m, -kHalfWay_m), std::max(0.02 * (1 - t_s), Press::kInside_m) + kTip_m, 0);
  };
  std::vector<Stroked> felt;
  double normal_n = 0;
  for (int ms = 0; ms < 3000; ++ms) {
    press.tick(stroke(ms * kTickSeconds));
    if (std::abs(press.p_WH().x()) > kMeasured_m) continue;
    felt.push_back({press.p_WH().x(), press.force_W().x()});
    normal_n += press.force_W().y();
  }
  double best_m = distance_m;
  for (double at_m = 0.5 * distance_m; at_m <= 2 * distance_m; at_m *= 1.002) {
    if (swing_n(felt, at_m) > swing_n(felt, best_m)) best_m = at_m;
  }
  const double flank = 0.5 * haptic.groove_depth_m * wave_rad_per_m;
  const double mean_n = normal_n / static_cast<double>(felt.size());
  report.metric(name + ".distance_ratio", best_m / distance_m);
  report.metric(name + ".flank_ratio", swing_n(felt, best_m) / (mean_n * flank));
}

void measure_grooves(Report& report) {
  for (const int delay_ms : {0, 20}) {
    for (const auto& [mode, mode_name] : kModes) {
      for (const double distance_m : {0.004, 0.01})
        stroke_grooves(report, fmt::format("groove{:g}.delay{}.{}", 1000 * distance_m, delay_ms, mode_name), mode,
                       delay_ms, distance_m);
    }
  }
}

/// What of a shake counts: when it is strongest, and when nine tenths of that are gone, both from its begin.
struct Shake {
  double peak_n = 0, rise_s = 0, length_s = 0;
};

Shake shake_of(const std::vector<double>& force_n, double dt_s) {
  Shake shake;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 0; i < force_n.size(); ++i) {
    if (shake.peak_n == 0) first = i;
    if (std::abs(force_n[i]) <= shake.peak_n) continue;
    shake.peak_n = std::abs(force_n[i]);
    shake.rise_s = static_cast<double>(i + 1 - first) * dt_s;
  }
  for (std::size_t i = 0; i < force_n.size(); ++i)
    if (std::abs(force_n[i]) > 0.1 * shake.peak_n) last = i;
  shake.length_s = static_cast<double>(last + 1 - first) * dt_s;
  return shake;
}

/// The shake that is asked for: as a device would draw it that is twenty times as fast.
Shake asked_shake(double strength_n) {
  constexpr Duration kFine = kTickPeriod / 20;
  haptic::ClickPulse pulse;
  pulse.hear({});
  pulse.hear({.count = 1, .strength_n = strength_n});
  std::vector<double> force_n;
  for (Duration past{0}; past < 100ms; past += kFine)
    force_n.push_back(pulse.render(kFine).y());
  return shake_of(force_n, to_seconds(kFine));
}

/// The strongest click for a hand in the air: what the device is given of it.
void measure_clicks(Report& report) {
  const Shake asked = asked_shake(hand::kMaxClick_n);
  for (const int delay_ms : {0, 20}) {
    for (const auto& [mode, mode_name] : kModes) {
      Press press(mode, {.hand = haptic::ArmConfig{}}, {.delay_ms = delay_ms});
      press.press(5 * Press::kAbove_m, 1s);
      press.click(hand::kMaxClick_n);
      std::vector<double> force_n;
      for (int ms = 0; ms < 150; ++ms) {
        press.tick(Vec3(0, 5 * Press::kAbove_m, 0));
        force_n.push_back(press.force_W().y());
      }
      const Shake felt = shake_of(force_n, kTickSeconds);
      const std::string name = fmt::format("click.delay{}.{}", delay_ms, mode_name);
      report.metric(name + ".peak_ratio", felt.peak_n / asked.peak_n);
      report.metric(name + ".rise_late_ms", 1000 * (felt.rise_s - asked.rise_s));
      report.metric(name + ".length_ratio", felt.length_s / asked.length_s);
    }
  }
}

/// What a hand felt, millisecond by millisecond, and what went over the network for it.
struct Trace {
  std::vector<Vec3> force_W;
  double energy_j = 0;
  double sent_up = 0, sent_down = 0;
};

/// `play` has tick(p_WH): the hand goes along `aim`, a place for each time in seconds.
template <class Play, class Aim>
Trace feel(Play& play, const Aim& aim, Duration time) {
  Trace trace;
  const double up_before = static_cast<double>(play.stats().sent);
  const double down_before = static_cast<double>(play.network().sent());
  for (Duration past{0}; past < time; past += kTickPeriod) {
    play.tick(aim(to_seconds(past)));
    trace.force_W.push_back(play.force_W());
  }
  trace.sent_up = static_cast<double>(play.stats().sent) - up_before;
  trace.sent_down = static_cast<double>(play.network().sent()) - down_before;
  trace.energy_j = play.energy_max_j();
  return trace;
}

/// In the air, 10 cm from anything, once round in two seconds.
Trace stroke(haptic::RenderMode mode, const Network& network) {
  Press press(mode, {.hand = haptic::ArmConfig{}}, network);
  return feel(
      press, [](double t_s) { return Vec3(0.05 * std::sin(kPi * t_s), 0.1, 0.05 * std::cos(kPi * t_s)); }, 4s);
}

/// Onto the floor, down and up again each four seconds.
Trace press_and_lift(haptic::RenderMode mode, const Network& network) {
  Press press(mode, {.hand = haptic::ArmConfig{}}, network);
  press.press(Press::kAbove_m, 1s);
  const auto aim = [](double t_s) {
    return Vec3(0, std::clamp(-0.02 * std::sin(0.5 * kPi * t_s), Press::kInside_m, Press::kAbove_m), 0);
  };
  return feel(press, aim, 8s);
}

/// To and fro over a ball of 50 mm, at up to 0.3 m/s.
Trace slide(haptic::RenderMode mode, const Network& network) {
  constexpr double kBall_m = 0.05;
  geometry::Superquadric ball;
  ball.a = Vec3::Constant(kBall_m);
  ball.e1 = ball.e2 = 1;
  test::FloorServer server(std::make_shared<const collision::Object>(collision::make_superquadric_object(ball, 0.004)));
  Press press(mode, {.hand = haptic::ArmConfig{}}, network, 1, std::move(server));
  const auto aim = [](double t_s) {
    const double angle_rad = 0.8 * std::sin(6 * t_s);
    const double above_m = std::max(Press::kInside_m, 0.02 - 0.02 * t_s);
    return Vec3((kBall_m + kTip_m + above_m) * Vec3(std::sin(angle_rad), std::cos(angle_rad), 0));
  };
  return feel(press, aim, 6s);
}

/// A held crank of 250 mm, to and fro at up to 0.25 m/s.
Trace turn_crank(haptic::RenderMode mode, const Network& network) {
  test::HeldCrank crank(mode, network);
  const auto aim = [](double t_s) {
    const double angle_rad = 1.0 * (1 - std::cos(t_s));
    return Vec3(test::HeldCrank::start().x() * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0));
  };
  return feel(crank, aim, 6s);
}

/// How far a force is from what it would be: 99 % of the milliseconds are below.
struct ForceError {
  double n = 0, ratio = 0;
};

double p99(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ForceError error_of(const Trace& trace, const Trace& right) {
  constexpr double kFirm_n = 0.5;  // of less, a share says nothing
  std::vector<double> errors_n, ratios;
  for (std::size_t i = 0; i < trace.force_W.size(); ++i) {
    errors_n.push_back((trace.force_W[i] - right.force_W[i]).norm());
    const double force_n = right.force_W[i].norm();
    if (force_n >= kFirm_n) ratios.push_back(errors_n.back() / force_n);
  }
  return {p99(std::move(errors_n)), p99(std::move(ratios))};
}

/// What a share of 0.1 saves and costs, all plays together.
struct DeadbandSum {
  double ticks = 0, up = 0, down = 0;
  double error_n = 0, energy_j = 0;

  void add(const Trace& trace, const ForceError& error) {
    ticks += static_cast<double>(trace.force_W.size());
    up += trace.sent_up;
    down += trace.sent_down;
    error_n = std::max(error_n, error.n);
    energy_j = std::max(energy_j, trace.energy_j);
  }
  void write(Report& report) const {
    constexpr double kUp = sizeof(proto::HapticInput), kDown = sizeof(proto::HapticOutput);
    report.metric("deadband.saved_up", 1 - up / ticks);
    report.metric("deadband.saved_down", 1 - down / ticks);
    report.metric("deadband.saved_bytes", 1 - (kUp * up + kDown * down) / ((kUp + kDown) * ticks));
    report.metric("deadband.force_error_n.p99", error_n);
    report.metric("deadband.energy_mj.max", 1000 * energy_j);
  }
};

/// Each play with and without a deadband, over a network that needs 2 ms there and back. What 1 ms more would do to the force is given
/// beside what the deadband does.
void measure_deadband(Report& report) {
  using Play = Trace (*)(haptic::RenderMode, const Network&);
  constexpr std::array<std::pair<Play, const char*>, 4> kPlays{
      {{stroke, "stroke"}, {press_and_lift, "press"}, {slide, "slide"}, {turn_crank, "crank"}}};
  constexpr double kShare = 0.1;
  DeadbandSum sum;
  for (const auto& [play, play_name] : kPlays) {
    std::vector<std::array<double, 2>> saved, error;
    for (const auto& [mode, mode_name] : kModes) {
      const bool local = mode == haptic::RenderMode::local;
      const Trace right = play(mode, {.delay_ms = 2});
      report.metric(fmt::format("deadband0.{}.{}.one_ms_error_n.p99", mode_name, play_name),
                    error_of(play(mode, {.delay_ms = 3}), right).n);
      for (const double share : {0.05, kShare, 0.2}) {
        if (!local && share != kShare) continue;
        const Trace trace = play(mode, {.delay_ms = 2, .deadband = share});
        const ForceError off = error_of(trace, right);
        const auto ticks = static_cast<double>(trace.force_W.size());
        const std::string name = fmt::format("deadband{:g}.{}.{}", 100 * share, mode_name, play_name);
        report.metric(name + ".saved_up", 1 - trace.sent_up / ticks);
        report.metric(name + ".saved_down", 1 - trace.sent_down / ticks);
        report.metric(name + ".force_error_n.p99", off.n);
        report.metric(name + ".force_error_ratio.p99", off.ratio);
        if (!local) continue;
        saved.push_back({share, 1 - (trace.sent_up + trace.sent_down) / (2 * ticks)});
        error.push_back({share, off.n});
        if (share == kShare) sum.add(trace, off);
      }
    }
    report.curve(fmt::format("deadband.saved.{}", play_name), saved);
    report.curve(fmt::format("deadband.error.{}", play_name), error);
  }
  report.metric("deadband.share", kShare);
  sum.write(report);
}

/// Presses through everything that can fail, at random: what the device was given. `deadband`: the share, or 0.
void measure_faults(Report& report, const std::string& prefix, double deadband, std::uint64_t ticks) {
  double zero_ms = 0;
  std::uint64_t faults = 0, over_limit = 0, over_slew = 0, over_ramp = 0;
  for (const auto& [mode, name] : kModes) {
    test::FaultPlay play(mode, 1, deadband);
    const test::FaultFindings& found = play.play(ticks / kModes.size());
    zero_ms = std::max(zero_ms, found.zero_ms_max);
    faults += found.pressed;
    over_limit += found.over_limit;
    over_slew += found.over_slew;
    over_ramp += found.over_ramp;
  }
  report.note(fmt::format("{}{} faults while the hand was pressed, in {} ticks",
                          deadband > 0 ? "with a deadband: " : "", faults, ticks));
  report.metric(prefix + "fault.zero_ms.max", zero_ms);
  report.metric(prefix + "force.over_limit", static_cast<double>(over_limit));
  report.metric(prefix + "force.over_slew", static_cast<double>(over_slew));
  report.metric(prefix + "force.over_ramp", static_cast<double>(over_ramp));
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  CLI::App app{"Stability of rendered contacts, on a simulated stylus"};
  std::uint64_t ticks = 10'000'000;
  app.add_option("--fault-ticks", ticks, "how long faults are played, milliseconds of the simulated clock");
  CLI11_PARSE(app, argc, argv);
  mechane::benchmark::Report report;
  mechane::benchmark::measure_walls(report);
  mechane::benchmark::measure_presses(report);
  mechane::benchmark::measure_delays(report);
  mechane::benchmark::measure_grooves(report);
  mechane::benchmark::measure_clicks(report);
  mechane::benchmark::measure_deadband(report);
  mechane::benchmark::measure_faults(report, "", 0, ticks);
  mechane::benchmark::measure_faults(report, "deadband.", 0.1, ticks / 10);
  std::cout << report.text() << "\n";
  return 0;
}
