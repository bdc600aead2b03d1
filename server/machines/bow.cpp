// machine.bow: a bow whose string a slider draws back, as in the gastraphetes (Heron, Belopoeica 75-81).
//
// When the slider is pushed home, its claw catches the string. From there the string goes with it, and pulls it back with the force of
// the draw curve. By default that force grows evenly from 0 to fullForce over drawLength, so that the bow holds half of force times
// length. Times effort_scale it goes to the slider as a load. When the release's quantity rises, the claw lets go: the string leaps
// home, the bow offers its energy to a projectile, and the slider stays where it is, free. What no projectile takes is lost in the
// limbs. The share that reaches the arrow is the projectile's efficiency (0.8 for a bow: reconstructions).
//
// The bodies of limbs and string, where the author names them, are put where the draw has them (see BowLimbs).
#include <algorithm>
#include <cmath>
#include <vector>

#include "server/machines/bow_limbs.hpp"
#include "server/machines/energy_store.hpp"
#include "server/machines/machine.hpp"

namespace mechane::machines {
namespace {

constexpr std::size_t kMostPoints = 64;
constexpr double kCatch_m = 0.002;  // the claw catches the string from this near

/// Force over draw: points at equal steps, straight lines between them; beyond the last point the last line goes on.
class DrawCurve {
 public:
  DrawCurve(std::vector<double> forces_n, double length_m)
      : forces_n_(std::move(forces_n)), step_m_(length_m / static_cast<double>(forces_n_.size() - 1)) {}

  [[nodiscard]] double force_n(double draw_m) const noexcept {
    const Place at = place(draw_m);
    return forces_n_[at.point] + slope(at.point) * at.rest_m;
  }
  [[nodiscard]] double energy_j(double draw_m) const noexcept {
    const Place at = place(draw_m);
    double sum_j = 0;
    for (std::size_t i = 0; i < at.point; ++i)
      sum_j += 0.5 * (forces_n_[i] + forces_n_[i + 1]) * step_m_;
    return sum_j + (forces_n_[at.point] + 0.5 * slope(at.point) * at.rest_m) * at.rest_m;
  }

 private:
  struct Place {
    std::size_t point;
    double rest_m;  // beyond it
  };
  [[nodiscard]] Place place(double draw_m) const noexcept {
    const double steps = std::floor(std::max(0.0, draw_m) / step_m_);
    const auto last = static_cast<double>(forces_n_.size() - 2);
    const double point = std::min(steps, last);
    return {static_cast<std::size_t>(point), std::max(0.0, draw_m) - point * step_m_};
  }
  [[nodiscard]] double slope(std::size_t point) const noexcept {
    return (forces_n_[point + 1] - forces_n_[point]) / step_m_;
  }

  std::vector<double> forces_n_;
  double step_m_;
};

struct BowSettings {
  JointId joint;
  double direction = 1;
  double home_m = 0;
  double effort_scale = 1;
  bool strung = true;
};

class Bow final : public Machine {
 public:
  Bow(const Build& build, const BowSettings& settings, DrawCurve curve, const BowLimbs& limbs, QuantityId release)
      : s_(settings),
        curve_(std::move(curve)),
        limbs_(limbs),
        caught_(build.slot("caught")),
        string_m_(build.slot("string_m")),
        force_n_(build.slot("force_n")),
        energy_j_(build.slot("energy_j")),
        shot_j_(build.slot("shot_j")),
        released_(build.slot("shot.released")),
        store_(build, release) {}

  void run(state::WorldState& state, double dt_s) const noexcept override {
    state::JointState& joint = state[s_.joint];
    const double draw_m = s_.direction * joint.position - s_.home_m;
    double& caught = state.memory[caught_];
    if (store_.released(state) && caught != 0) {
      store_.offer(state, curve_.energy_j(draw_m));
      caught = 0;
      state.memory[released_] = 1;
    } else if (s_.strung && joint.enabled && draw_m <= kCatch_m && state.memory[released_] == 0) {
      caught = 1;
    } else if (draw_m > kCatch_m) {
      state.memory[released_] = 0;  // after a shot the claw catches again only when the slider has been drawn back once
    }
    (void)store_.wait(state, dt_s);
    if (store_.taken_j(state) > 0) state.memory[shot_j_] = store_.taken_j(state);
    const double string_m = caught != 0 ? std::max(0.0, draw_m) : 0;
    pull(state, joint, string_m, dt_s);
    limbs_.follow(state, string_m);
    if (!s_.strung) limbs_.lose_string(state);
  }

 private:
  void pull(state::WorldState& state, state::JointState& joint, double draw_m, double dt_s) const noexcept {
    state.memory[string_m_] = draw_m;
    state.memory[force_n_] = draw_m > 0 ? curve_.force_n(draw_m) : 0;
    state.memory[energy_j_] = curve_.energy_j(draw_m);
    if (!joint.enabled || draw_m <= 0) return;
    // The mean force over this tick's way, so that a fast slider gets just the energy that the bow loses.
    const double way_m = s_.direction * joint.velocity * dt_s;
    const double force_n = std::abs(way_m) < 1e-7 ? curve_.force_n(draw_m)
                                                  : (curve_.energy_j(draw_m + way_m) - curve_.energy_j(draw_m)) / way_m;
    joint.load -= s_.effort_scale * s_.direction * force_n;
  }

  BowSettings s_;
  DrawCurve curve_;
  BowLimbs limbs_;
  std::size_t caught_;
  std::size_t string_m_;
  std::size_t force_n_;
  std::size_t energy_j_;
  std::size_t shot_j_;
  std::size_t released_;
  EnergyStore store_;
};

Expected<DrawCurve> read_curve(const Build& build) {
  const state::Parameters& p = build.parameters;
  const double full_n = p.number("fullForce");
  std::vector<double> points{0, 1};
  if (p.given("curve")) points = p.numbers("curve");
  if (points.size() < 2 || points.size() > kMostPoints)
    return fail(ErrorCode::invalid_value, "the draw curve has " + std::to_string(points.size()) + " points",
                build.place("curve"),
                "write from 2 to " + std::to_string(kMostPoints) + " shares of fullForce, at equal steps of the draw");
  for (double& point : points)
    point *= full_n;
  return DrawCurve(std::move(points), p.number("drawLength"));
}

Expected<std::unique_ptr<Machine>> make_bow(const Build& build) {
  const state::Parameters& p = build.parameters;
  BowSettings s;
  const auto joint = build.joint("joint", state::JointKind::slider);
  if (!joint) return tl::unexpected(joint.error());
  s.joint = *joint;
  s.direction = p.boolean("reversed") ? -1 : 1;
  s.home_m = p.number("home");
  s.strung = p.boolean("strung");
  s.effort_scale = build.effort_scale();
  auto curve = read_curve(build);
  if (!curve) return tl::unexpected(curve.error());
  const auto limbs = BowLimbs::make(build, s.joint, s.direction);
  if (!limbs) return tl::unexpected(limbs.error());
  const QuantityId release = build.description.find_quantity(p.text("release"));
  return std::make_unique<Bow>(build, s, std::move(*curve), *limbs, release);
}

using state::ParameterKind;
constexpr state::ParameterType kBowParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the slider that draws the string back",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "fullForce", .unit = "N", .summary = "at the full draw", .required = true, .min = 1, .max = 1e5},
    {.name = "drawLength",
     .unit = "m",
     .summary = "of the full draw, from the string at rest",
     .required = true,
     .min = 0.01,
     .max = 10},
    {.name = "curve",
     .kind = ParameterKind::numbers,
     .summary = "shares of fullForce at equal steps of the draw; not given: 0 1, a straight line",
     .min = 0,
     .max = 1},
    {.name = "home",
     .unit = "m",
     .summary = "position of the slider (from 0 in the direction of the draw) where its claw meets the string",
     .min = -10,
     .max = 10},
    {.name = "release",
     .kind = ParameterKind::text,
     .summary = "the quantity that opens the claw as it rises above 0.5",
     .required = true,
     .reference = state::Reference::quantity},
    {.name = "strung",
     .kind = ParameterKind::boolean,
     .summary = "false: the bow has no string, or the string is cut",
     .default_value = 1},
    {.name = "limbs",
     .kind = ParameterKind::texts,
     .summary = "the bodies of its two limbs, which the string bends; origins where they leave its middle",
     .reference = state::Reference::body},
    {.name = "strings",
     .kind = ParameterKind::texts,
     .summary = "the bodies of the string's two halves, in the same order; origins at the limbs' tips",
     .reference = state::Reference::body},
    effort_scale_parameter("share of the force that the hand feels; not given: the world's effort_scale"),
    {.name = "reversed", .kind = ParameterKind::boolean, .summary = "true: the slider draws to negative positions"},
};
constexpr state::ValueType kBowValues[] = {
    state::yes_or_no("caught", "1 while the claw holds the string"),
    state::amount("string_m", "m", "how far the string is drawn"),
    state::amount("force_n", "N", "of the string on the slider, unscaled"),
    state::amount("energy_j", "J", "held by the bow, unscaled"),
    state::amount("shot_j", "J", "what the last projectile took"),
};

}  // namespace

const MachineKind& bow_kind() {
  static const MachineKind kKind{
      {"machine.bow", "A bow that a slider draws, and a claw that lets go", kBowParameters, kBowValues}, make_bow};
  return kKind;
}

}  // namespace mechane::machines
