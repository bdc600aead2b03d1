// machine.projectile: a stone or an arrow that a spring throws.
//
// The shot. When the spring (machine.torsion_spring, machine.bow) offers its energy E and the missile lies on its seat, free of hands
// and of the joint that held it, it gets the speed sqrt(2 * efficiency * E / m) along `direction`. This takes one tick; in the real
// machine the string pushes for some 10 ms. The spring is told what was taken.
//
// Flight. The dynamics see to gravity. Drag, 1/2 rho Cd A v^2 against the flight, is a load on the body. With `axis` the missile is
// fletched and keeps that axis along its flight (its turning is set, not computed). The flight ends where the speed changes by
// more than air and gravity can account for (it struck something), at `ground`, or in the target.
//
// Target. A disc on a body, of straw or wood that stops what enters with the force `stopForce`: the missile goes in by its
// energy / stopForce, and sticks. The way that the missile's tip sweeps in a tick is tested against the disc, so that no missile is
// too fast to hit it. Target and missile must not collide otherwise.
#include <algorithm>
#include <cmath>

#include "server/machines/energy_store.hpp"
#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"

namespace mechane::machines {
namespace {

constexpr double kStruck_m_s = 1.0;   // a change of speed in a tick that only a blow explains
constexpr double kStuck_m_s = 0.01;   // below this speed the missile sticks in the target
constexpr double kFledge_per_s = 60;  // how fast a fletched missile follows its flight

enum class Phase : int { rests = 0, flies = 1, struck = 2, enters = 3, sticks = 4 };

struct Target {
  BodyId body;  // none: there is no target
  Vec3 p_TC = Vec3::Zero();
  Vec3 n_T = Vec3::UnitZ();  // out of its face
  double radius_m = 0;
  double stop_n = 0;
};

struct ProjectileSettings {
  BodyId body;
  BodyId stock;
  JointId holder;
  double mass_kg = 1;
  double felt_scale = 1;  // of the body's mass, and so of the forces on it
  Vec3 p_BCm = Vec3::Zero();
  Vec3 p_BTip = Vec3::Zero();
  Vec3 axis_B = Vec3::Zero();  // zero: not fletched
  Vec3 p_FSeat = Vec3::Zero();
  Vec3 direction_F = Vec3::UnitX();
  double tolerance_m = 0.05;
  double efficiency = 0.6;
  double drag_kg_per_m = 0;  // 1/2 rho Cd A
  bool has_ground = false;
  double ground_m = 0;
  Vec3 gravity_W = Vec3::Zero();
  Target target;
};

/// A vector in three slots of memory, one after the other.
class VectorSlots {
 public:
  VectorSlots(const Build& build, const std::string& name) : first_(build.slot(name + "0")) {
    (void)build.slot(name + "1");
    (void)build.slot(name + "2");
  }
  [[nodiscard]] Vec3 read(const state::WorldState& state) const noexcept {
    return {state.memory[first_], state.memory[first_ + 1], state.memory[first_ + 2]};
  }
  void write(state::WorldState& state, const Vec3& v) const noexcept {
    for (std::size_t i = 0; i < 3; ++i)
      state.memory[first_ + i] = v[static_cast<Eigen::Index>(i)];
  }

 private:
  std::size_t first_;
};

class Projectile final : public Machine {
 public:
  Projectile(const Build& build, const ProjectileSettings& settings, const EnergyOffer& offer)
      : s_(settings),
        offer_(offer),
        flying_(build.slot("flying")),
        speed_(build.slot("speed_m_s")),
        range_(build.slot("range_m")),
        height_(build.slot("height_m")),
        time_(build.slot("flight_s")),
        energy_(build.slot("energy_j")),
        shots_(build.slot("shots")),
        struck_(build.slot("struck")),
        hit_(build.slot("hit")),
        off_centre_(build.slot("off_centre_m")),
        depth_(build.slot("depth_m")),
        phase_(build.slot("flight.phase")),
        carry_(build.slot("flight.carry")),
        from_(build, "flight.from"),
        expected_(build, "flight.expected") {}

  void run(state::WorldState& state, double dt_s) const noexcept override {
    const double energy_j = offer_.open_j(state);
    if (energy_j > 0 && lies_ready(state)) {
      launch(state, energy_j, dt_s);
      return;
    }
    switch (static_cast<Phase>(static_cast<int>(state.memory[phase_]))) {
      case Phase::flies:
        fly(state, dt_s);
        break;
      case Phase::enters:
        enter(state, 1 + state.memory[carry_], dt_s);
        state.memory[carry_] = 0;
        break;
      default:
        break;
    }
  }

 private:
  [[nodiscard]] Vec3 p_WCm(const state::BodyState& body) const noexcept { return body.X_WB * s_.p_BCm; }
  [[nodiscard]] Vec3 v_WCm(const state::BodyState& body) const noexcept {
    return body.V_WB.at(body.X_WB.rotate(s_.p_BCm));
  }
  [[nodiscard]] Vec3 gravity_W(const state::BodyState& body) const noexcept {
    return body.use_gravity ? s_.gravity_W : Vec3(Vec3::Zero());
  }
  void push(state::BodyState& body, const Vec3& f_W) const noexcept {
    state::add_force(body, s_.felt_scale * f_W, p_WCm(body));
  }
  void set_phase(state::WorldState& state, Phase phase) const noexcept {
    state.memory[phase_] = static_cast<double>(phase);
    state.memory[flying_] = phase == Phase::flies ? 1 : 0;
  }

  [[nodiscard]] Pose X_WF(const state::WorldState& state) const noexcept {
    return s_.stock ? state[s_.stock].X_WB : Pose{};
  }

  [[nodiscard]] bool lies_ready(const state::WorldState& state) const noexcept {
    if (s_.holder && state[s_.holder].enabled) return false;
    for (const state::UserState& user : state.users) {
      if (user.holds(s_.body)) return false;
    }
    return (X_WF(state) * s_.p_FSeat - state[s_.body].X_WB.p).norm() <= s_.tolerance_m;
  }

  void launch(state::WorldState& state, double offered_j, double dt_s) const noexcept {
    state::BodyState& body = state[s_.body];
    const double energy_j = s_.efficiency * offered_j;
    offer_.take(state, energy_j);
    const double speed = std::sqrt(2 * energy_j / s_.mass_kg);
    const Vec3 v_W = speed * X_WF(state).rotate(s_.direction_F);
    body.movable = true;
    push(body, s_.mass_kg * (v_W - v_WCm(body)) / dt_s);
    from_.write(state, p_WCm(body));
    expected_.write(state, v_W + dt_s * gravity_W(body));
    for (const std::size_t slot : {range_, height_, time_, struck_, hit_, off_centre_, depth_})
      state.memory[slot] = 0;
    state.memory[energy_] = energy_j;
    state.memory[speed_] = speed;
    state.memory[shots_] += 1;
    set_phase(state, Phase::flies);
  }

  void fly(state::WorldState& state, double dt_s) const noexcept {
    state::BodyState& body = state[s_.body];
    const Vec3 v_W = v_WCm(body);
    state.memory[time_] += dt_s;
    if ((v_W - expected_.read(state)).norm() > kStruck_m_s) {
      end(state, p_WCm(body));
      return;
    }
    state.memory[speed_] = v_W.norm();
    if (const double share = meets_target(state, v_W, dt_s); share < 1) {
      follow(state, p_WCm(body) + share * dt_s * v_W);
      state.memory[hit_] = 1;
      set_phase(state, Phase::enters);
      enter(state, first_push(state, 1 - share), dt_s);
      return;
    }
    follow(state, p_WCm(body));
    if (s_.has_ground && v_W.y() < 0 && p_WCm(body).y() <= s_.ground_m) {
      const double back_s = (s_.ground_m - p_WCm(body).y()) / -v_W.y();
      end(state, p_WCm(body) - back_s * v_W);
      return;
    }
    const Vec3 drag_W = -s_.drag_kg_per_m * v_W.norm() * v_W;
    push(body, drag_W);
    if (!s_.axis_B.isZero()) fledge(body, v_W, dt_s);
    expected_.write(state, v_W + dt_s * (gravity_W(body) + drag_W / s_.mass_kg));
  }

  void follow(state::WorldState& state, const Vec3& p_W) const noexcept {
    const Vec3 way = p_W - from_.read(state);
    state.memory[range_] = std::hypot(way.x(), way.z());
    state.memory[height_] = std::max(state.memory[height_], way.y());
  }

  void end(state::WorldState& state, const Vec3& p_W) const noexcept {
    follow(state, p_W);
    state.memory[struck_] = 1;
    set_phase(state, Phase::struck);
  }

  /// Turns the missile's axis towards its flight without changing the velocity of its centre of mass.
  void fledge(state::BodyState& body, const Vec3& v_W, double dt_s) const noexcept {
    if (v_W.norm() < 1) return;
    const Quat turn = Quat::FromTwoVectors(body.X_WB.rotate(s_.axis_B), v_W);
    const Vec3 w_W = std::min(kFledge_per_s, 1 / dt_s) * rotation_vector(turn);
    const Vec3 r_W = body.X_WB.rotate(s_.p_BCm);
    body.V_WB = {v_W - w_W.cross(r_W), w_W};
  }

  [[nodiscard]] Vec3 p_CTip_W(const state::WorldState& state) const noexcept {
    return state[s_.body].X_WB * s_.p_BTip - state[s_.target.body].X_WB * s_.target.p_TC;
  }
  [[nodiscard]] Vec3 face_normal_W(const state::WorldState& state) const noexcept {
    return state[s_.target.body].X_WB.rotate(s_.target.n_T);
  }
  [[nodiscard]] double over_face_m(const state::WorldState& state) const noexcept {
    return p_CTip_W(state).dot(face_normal_W(state));
  }

  /// The share of this tick after which the tip goes into the target's face; 1: it does not.
  double meets_target(state::WorldState& state, const Vec3& v_W, double dt_s) const noexcept {
    if (!s_.target.body) return 1;
    const double distance_m = over_face_m(state), closing_m = -dt_s * v_W.dot(face_normal_W(state));
    if (distance_m < 0 || closing_m <= distance_m) return 1;
    const double share = distance_m / closing_m;
    const Vec3 at_W = p_CTip_W(state) + share * dt_s * v_W;
    if (at_W.norm() > s_.target.radius_m) return 1;
    state.memory[off_centre_] = at_W.norm();
    return share;
  }

  /// Dynamics move a body by its speed at the end of a tick. So that the missile goes in as far as it should, the push lags by half a
  /// tick: of a push that begins with `left` of a tick to go, left^2 / 2 comes now, and the next tick brings the sum to left + 1/2.
  [[nodiscard]] double first_push(state::WorldState& state, double left) const noexcept {
    state.memory[carry_] = left - 0.5 - left * left / 2;
    return left * left / 2;
  }

  /// The target's force holds the missile back, for `ticks`; never more than what stops it.
  void enter(state::WorldState& state, double ticks, double dt_s) const noexcept {
    state::BodyState& body = state[s_.body];
    const Vec3 v_W = v_WCm(body);
    const double speed = v_W.norm();
    state.memory[depth_] = std::max(0.0, -over_face_m(state));
    if (speed < kStuck_m_s) {
      body.movable = false;
      body.V_WB = {};
      set_phase(state, Phase::sticks);
      return;
    }
    const double stop_n = std::min(ticks * s_.target.stop_n, s_.mass_kg * speed / dt_s);
    push(body, -stop_n / speed * v_W - s_.mass_kg * gravity_W(body));
    body.V_WB = {v_W, Vec3::Zero()};
    state.memory[speed_] = speed - stop_n * dt_s / s_.mass_kg;
  }

  ProjectileSettings s_;
  EnergyOffer offer_;
  std::size_t flying_;
  std::size_t speed_;
  std::size_t range_;
  std::size_t height_;
  std::size_t time_;
  std::size_t energy_;
  std::size_t shots_;
  std::size_t struck_;
  std::size_t hit_;
  std::size_t off_centre_;
  std::size_t depth_;
  std::size_t phase_;
  std::size_t carry_;     // of the target's push, from the tick of entering to the next
  VectorSlots from_;      // centre of mass at the shot
  VectorSlots expected_;  // its velocity after this tick if it meets nothing
};

Expected<Target> read_target(const Build& build) {
  const state::Parameters& p = build.parameters;
  Target target;
  if (!p.given("target")) return target;
  target.body = p.body("target");
  if (target.body == p.body("body"))
    return fail(ErrorCode::conflict, "'body' and 'target' name the same body", build.place("target"),
                "name another body in 'target'");
  const auto normal = build.direction("targetNormal", Vec3::UnitZ());
  if (!normal) return tl::unexpected(normal.error());
  target.n_T = *normal;
  target.p_TC = build.vector("targetCentre");
  target.radius_m = p.number("targetRadius");
  target.stop_n = p.number("stopForce");
  return target;
}

Expected<std::unique_ptr<Machine>> make_projectile(const Build& build) {
  const state::Parameters& p = build.parameters;
  ProjectileSettings s;
  s.body = p.body("body");
  const state::BodyDescription& body = build.description.bodies[s.body.index()];
  if (body.fixed)
    return fail(ErrorCode::conflict, "the body '" + body.name + "' is fixed", build.place("body"),
                "name a body that can fly");
  const auto offer = EnergyOffer::find(build, "spring");
  if (!offer) return tl::unexpected(offer.error());
  const auto direction = build.direction("direction", Vec3::UnitX());
  if (!direction) return tl::unexpected(direction.error());
  const auto axis = build.direction("axis", Vec3::Zero());
  if (!axis) return tl::unexpected(axis.error());
  const auto target = read_target(build);
  if (!target) return tl::unexpected(target.error());
  s.stock = p.given("stock") ? p.body("stock") : BodyId();
  s.holder = p.given("holder") ? p.joint("holder") : JointId();
  s.mass_kg = body.mass_kg;
  s.felt_scale = body.effort_scale;
  s.p_BCm = body.p_BCm;
  s.p_BTip = build.vector("tip");
  s.axis_B = *axis;
  s.p_FSeat = build.vector("seat");
  s.direction_F = *direction;
  s.tolerance_m = p.number("tolerance");
  s.efficiency = p.number("efficiency");
  const double radius_m = p.number("diameter") / 2;
  s.drag_kg_per_m = 0.5 * kAirDensity_kg_m3 * p.number("dragCoefficient") * kPi * radius_m * radius_m;
  s.has_ground = p.given("ground");
  s.ground_m = p.number("ground");
  s.gravity_W = build.description.gravity_W;
  s.target = *target;
  return std::make_unique<Projectile>(build, s, *offer);
}

using state::ParameterKind;
constexpr state::ParameterType kProjectileParameters[] = {
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "the missile",
     .required = true,
     .reference = state::Reference::body},
    {.name = "spring",
     .kind = ParameterKind::text,
     .summary = "the machine that throws it, written before this one",
     .required = true,
     .reference = state::Reference::machine},
    {.name = "stock",
     .kind = ParameterKind::text,
     .summary = "the body that seat and direction are measured in; not given: the world",
     .reference = state::Reference::body},
    state::point("seat", "where the missile's origin lies before the shot, in the stock's frame", true),
    {.name = "tolerance",
     .unit = "m",
     .summary = "how far from its seat it may lie to be thrown",
     .default_value = 0.05,
     .min = 1e-3,
     .max = 1},
    state::direction("direction", "of the shot, in the stock's frame", true),
    {.name = "holder",
     .kind = ParameterKind::text,
     .summary = "a joint that holds it before the shot: it is thrown when that is off",
     .reference = state::Reference::joint},
    {.name = "efficiency",
     .summary = "share of the spring's energy that it gets: 0.6 of torsion springs, 0.8 of a bow",
     .default_value = 0.6,
     .min = 0,
     .max = 1},
    {.name = "diameter",
     .unit = "m",
     .summary = "of its cross-section, for the drag",
     .required = true,
     .min = 1e-3,
     .max = 2},
    {.name = "dragCoefficient",
     .summary = "0.47 of a ball; 2 of an arrow's cross-section with its fletching",
     .default_value = 0.47,
     .min = 0,
     .max = 10},
    state::direction("axis",
                     "in its own frame, towards its tip: the missile is fletched. Not given: it flies as it turns"),
    {.name = "tip",
     .kind = ParameterKind::numbers,
     .unit = "m",
     .summary = "in its own frame: what meets the target",
     .min = -100,
     .max = 100,
     .count = 3},
    {.name = "ground",
     .unit = "m",
     .summary = "height in the world at which the flight ends",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m},
    {.name = "target",
     .kind = ParameterKind::text,
     .summary = "the body whose face holds what enters",
     .reference = state::Reference::body},
    state::point("targetCentre", "of the face, in the target's frame"),
    state::direction("targetNormal", "out of the face, in the target's frame; not given: its z"),
    {.name = "targetRadius", .unit = "m", .summary = "of the face", .default_value = 0.5, .min = 0.01, .max = 100},
    {.name = "stopForce",
     .unit = "N",
     .summary = "by which the target holds what enters; straw: some 1000",
     .default_value = 1000,
     .min = 1,
     .max = 1e7},
};
constexpr state::ValueType kProjectileValues[] = {
    state::yes_or_no("flying", "1 from the shot to the blow"),
    state::amount("speed_m_s", "m/s", "of the flight, the last one where it has ended"),
    state::amount("range_m", "m", "over ground, from the shot to here or to where the flight ended"),
    state::amount("height_m", "m", "the highest so far, above the shot"),
    state::amount("flight_s", "s", "since the shot"),
    state::amount("energy_j", "J", "at the shot"),
    state::amount("shots", "", "so far"),
    state::yes_or_no("struck", "1 when the flight ended at something else than the target"),
    state::yes_or_no("hit", "1 when it went into the target"),
    state::amount("off_centre_m", "m", "from the target's centre to the hit", "targetRadius"),
    state::amount("depth_m", "m", "how far it went in"),
};

}  // namespace

const MachineKind& projectile_kind() {
  static const MachineKind kKind{
      {"machine.projectile", "A stone or an arrow that a spring throws", kProjectileParameters, kProjectileValues},
      make_projectile};
  return kKind;
}

}  // namespace mechane::machines
