// machine.torsion_spring: bundles of twisted sinew that drive an arm.
//
// Torque. A bundle is put into its frame with a preload and twists with the arm: torque = preload + stiffness * angle for each of
// `springs` bundles, towards rest (angle 0). The preload comes in over the first kHeel_rad, while the arm's heel leaves the frame
// that carries it at rest. The energy of the springs is the area under that curve. Times effort_scale the torque goes to the hinge as
// a load: it drives.
//
// Calibration. Philon (Belopoeica 51): the bundle's diameter in dactyls is 1.1 * cbrt(100 * the stone's weight in minas). (Vitruvius
// X.11.3 has a table for the same; as it has come down to us its springs are smaller.) Where an author gives both, they are checked
// against each other.
//
// The shot. When the release's quantity rises, the springs offer their energy to a projectile; while they do, they push nothing.
// The arm does not get what the stone takes: until it is at rest again its torque is smaller by that share. So the sum is never more
// than what was wound up. In the real machine stone and arms share the energy over some 30 ms; here the stone takes its part first.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/energy_store.hpp"
#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"

namespace mechane::machines {
namespace {

constexpr double kHeel_rad = 0.02;
constexpr double kCalibration = 0.1;  // how far a spring may be from Philon's rule

struct TorsionSpringSettings {
  JointId joint;
  double direction = 1;
  double springs = 2;
  double preload_nm = 0;
  double stiffness_nm_per_rad = 0;
  double effort_scale = 1;
  double calibre_dactyls = 0;
};

class TorsionSpring final : public Machine {
 public:
  TorsionSpring(const Build& build, const TorsionSpringSettings& settings, QuantityId release)
      : s_(settings),
        torque_nm_(build.slot("torque_nm")),
        energy_j_(build.slot("energy_j")),
        angle_(build.slot("angle")),
        shot_j_(build.slot("shot_j")),
        share_(build.slot("shot.share", 1)),
        before_j_(build.slot("shot.before_j")),
        store_(build, release) {
    (void)build.slot("calibre_dactyls", settings.calibre_dactyls);
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    state::JointState& joint = state[s_.joint];
    const double angle = joint.enabled ? std::max(0.0, s_.direction * joint.position) : 0;
    double& share = state.memory[share_];
    if (angle <= kHeel_rad) share = 1;
    const double energy_j = share * area_j(angle);
    if (store_.released(state)) {
      state.memory[before_j_] = energy_j;
      store_.offer(state, energy_j);
    }
    const bool offering = store_.wait(state, dt_s);
    take_off(state, share);
    const double torque_nm = share * torque(angle);
    state.memory[angle_] = angle;
    state.memory[torque_nm_] = torque_nm;
    state.memory[energy_j_] = share * area_j(angle);
    if (joint.enabled && !offering)
      joint.load -= s_.effort_scale * s_.direction * share * mean_torque(s_.direction * joint.velocity * dt_s, angle);
  }

 private:
  [[nodiscard]] double torque(double angle) const noexcept {
    return s_.springs * (s_.preload_nm * std::min(1.0, angle / kHeel_rad) + s_.stiffness_nm_per_rad * angle);
  }
  /// The mean over the way that the arm goes in this tick, so that a fast arm gets just the energy that the springs lose.
  [[nodiscard]] double mean_torque(double way, double angle) const noexcept {
    return std::abs(way) < 1e-6 ? torque(angle) : (area_j(std::max(0.0, angle + way)) - area_j(angle)) / way;
  }
  /// The area under torque(), from rest to `angle`.
  [[nodiscard]] double area_j(double angle) const noexcept {
    const double heel = std::min(angle, kHeel_rad);
    const double preload_j = s_.preload_nm * (heel * heel / (2 * kHeel_rad) + angle - heel);
    return s_.springs * (preload_j + 0.5 * s_.stiffness_nm_per_rad * angle * angle);
  }

  /// Takes from the arm's share what a projectile has taken since the release.
  void take_off(state::WorldState& state, double& share) const noexcept {
    const double before_j = state.memory[before_j_], taken_j = store_.taken_j(state);
    if (before_j <= 0 || taken_j <= 0) return;
    share *= std::clamp(1 - taken_j / before_j, 0.0, 1.0);
    state.memory[shot_j_] = taken_j;
    state.memory[before_j_] = 0;
  }

  TorsionSpringSettings s_;
  std::size_t torque_nm_;
  std::size_t energy_j_;
  std::size_t angle_;
  std::size_t shot_j_;
  std::size_t share_;     // of the torque that is left after a shot
  std::size_t before_j_;  // held at the release; 0: settled
  EnergyStore store_;
};

double philons_calibre_dactyls(double stone_kg) {
  return 1.1 * std::cbrt(100 * stone_kg / kMina_kg);
}

Expected<double> read_calibre(const Build& build) {
  const state::Parameters& p = build.parameters;
  if (!p.given("springDiameter")) return p.given("stoneMass") ? philons_calibre_dactyls(p.number("stoneMass")) : 0.0;
  const double calibre = p.number("springDiameter") / kDactyl_m;
  if (!p.given("stoneMass")) return calibre;
  const double philons = philons_calibre_dactyls(p.number("stoneMass"));
  if (std::abs(calibre / philons - 1) > kCalibration) {
    return fail(ErrorCode::conflict,
                fmt::format("springs of {:.1f} dactyls do not fit a stone of {:.1f} minas: Philon's rule gives {:.1f}",
                            calibre, p.number("stoneMass") / kMina_kg, philons),
                build.place("springDiameter"),
                fmt::format("write {:.4f} for springDiameter, or another stoneMass", philons * kDactyl_m));
  }
  return calibre;
}

Expected<std::unique_ptr<Machine>> make_torsion_spring(const Build& build) {
  const state::Parameters& p = build.parameters;
  TorsionSpringSettings s;
  const auto joint = build.joint("joint", state::JointKind::hinge);
  if (!joint) return tl::unexpected(joint.error());
  s.joint = *joint;
  s.direction = p.boolean("reversed") ? -1 : 1;
  const auto springs = build.whole_number("springs");
  if (!springs) return tl::unexpected(springs.error());
  s.springs = *springs;
  s.preload_nm = p.number("preload");
  s.stiffness_nm_per_rad = p.number("stiffness");
  s.effort_scale = build.effort_scale();
  const auto calibre = read_calibre(build);
  if (!calibre) return tl::unexpected(calibre.error());
  s.calibre_dactyls = *calibre;
  const QuantityId release = p.given("release") ? build.description.find_quantity(p.text("release")) : QuantityId();
  return std::make_unique<TorsionSpring>(build, s, release);
}

using state::ParameterKind;
constexpr state::ParameterType kTorsionSpringParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge of the arm, at 0 when the arm is at rest",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "springs",
     .summary = "how many bundles drive it; 0: they are cut",
     .default_value = 2,
     .min = 0,
     .max = 2},
    {.name = "preload",
     .unit = "N m",
     .summary = "torque of one bundle at rest",
     .required = true,
     .min = 0,
     .max = 1e6},
    {.name = "stiffness",
     .unit = "N m/rad",
     .summary = "torque of one bundle that each radian adds",
     .required = true,
     .min = 0,
     .max = 1e6},
    {.name = "springDiameter",
     .unit = "m",
     .summary = "of a bundle; checked against Philon's rule where stoneMass is given",
     .min = 0.001,
     .max = 2},
    {.name = "stoneMass",
     .unit = "kg",
     .summary = "what the machine is made to throw; the springs' diameter follows from it by Philon's rule",
     .min = 0.001,
     .max = 1000},
    {.name = "release",
     .kind = ParameterKind::text,
     .summary = "the quantity that lets the arm go as it rises above 0.5: a projectile may take the energy then",
     .reference = state::Reference::quantity},
    effort_scale_parameter("share of the torque that the hand feels; not given: the world's effort_scale"),
    {.name = "reversed", .kind = ParameterKind::boolean, .summary = "true: the arm is drawn to negative angles"},
};
constexpr state::ValueType kTorsionSpringValues[] = {
    state::amount("torque_nm", "N m", "of all springs on the arm, unscaled"),
    state::amount("energy_j", "J", "held by the springs, unscaled"),
    state::amount("angle", "rad", "how far the arm is drawn, from rest"),
    state::amount("shot_j", "J", "what the last projectile took"),
    state::amount("calibre_dactyls", "", "the springs' diameter in dactyls of 18.5 mm"),
};

}  // namespace

const MachineKind& torsion_spring_kind() {
  static const MachineKind kKind{{"machine.torsion_spring", "Twisted sinew that drives a catapult's arm",
                                  kTorsionSpringParameters, kTorsionSpringValues},
                                 make_torsion_spring};
  return kKind;
}

}  // namespace mechane::machines
