// geometry.snap: a body that comes close to its place goes there and stays.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/agents/pose_slots.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

/// Draws a point home. The force is 0 at home, strongest at 0.45 of the reach, and 0 again from the reach on, without a step or a kink:
/// with s = distance / reach it is 3.49 s (1 - s^2)^2 of the strongest. It has a potential, whose depth is 0.58 of strongest_n * reach_m.
struct Pull {
  double strongest_n = 0;
  double reach_m = 0;

  /// The force over the distance from home. Nowhere is it steeper than at 0.
  [[nodiscard]] double stiffness_n_per_m(double distance_m) const noexcept {
    constexpr double kNormed = 3.4938562148434216;  // 1 over the largest s (1 - s^2)^2, that of s^2 = 1/5
    const double left = std::max(0.0, 1 - distance_m * distance_m / (reach_m * reach_m));
    return kNormed * strongest_n / reach_m * left * left;
  }
};

class Snap final : public Agent {
 public:
  explicit Snap(const Build& build, const Pose& X_IT, const Vec3& axis_B)
      : object_(build.parameters.body("object")),
        into_(build.parameters.body("into")),
        X_IT_(X_IT),
        axis_B_(axis_B),
        reach_m_(build.parameters.numbers("tolerance")[0]),
        reach_rad_(build.parameters.numbers("tolerance")[1]),
        duration_s_(build.parameters.number("duration")),
        pull_(pull_of(build.parameters)),
        tied_(build.parameters.boolean("tied")),
        placed_(build.slot("placed")),
        distance_(build.slot("distance")),
        angle_(build.slot("angle")),
        moving_(build.slot("moving")),
        time_s_(build.slot("time")),
        X_IFrom_(build, "from"),
        X_ITo_(build, "to") {
    if (!tied_) return;
    state::Coupling tie;
    tie.kind = state::CouplingKind::fixed;
    tie.body1 = into_;
    tie.body2 = object_;
    tie_ = build.coupling(tie);
  }

  [[nodiscard]] static Pull pull_of(const state::Parameters& parameters) {
    return {parameters.number("pull"), parameters.number("pullFrom")};
  }

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    measure(state);
    if (state.memory[moving_] != 0) {
      move(state, dt_s);
    } else if (state.memory[placed_] != 0) {
      if (state[object_].movable && !within(state, 1.5)) state.memory[placed_] = 0;
    } else if (enabled && within(state, 1)) {
      begin(state);
    } else if (enabled && pull_.strongest_n > 0 && state[object_].movable && is_held(state)) {
      draw(state);
    }
    if (!tied_) return;
    state::Coupling& tie = state.couplings[tie_];
    tie.enabled = state.memory[placed_] != 0;
    tie.X_B1B2 = X_ITo_.read(state);
  }

 private:
  /// The frame that the place is in: a body's, or the world's.
  [[nodiscard]] Pose X_WI(const state::WorldState& state) const noexcept { return into_ ? state[into_].X_WB : Pose{}; }

  /// The place in the frame I. With an insertion axis the body may have any rotation about it: the one that it has.
  [[nodiscard]] Pose place(const state::WorldState& state) const noexcept {
    if (axis_B_.isZero()) return X_IT_;
    const Pose X_IB = X_WI(state).inverse() * state[object_].X_WB;
    const Quat tilt = Quat::FromTwoVectors(X_IB.R * axis_B_, X_IT_.R * axis_B_);
    return {X_IT_.p, (tilt * X_IB.R).normalized()};
  }

  void measure(state::WorldState& state) const noexcept {
    const Pose X_WT = X_WI(state) * place(state);
    const Pose& X_WB = state[object_].X_WB;
    state.memory[distance_] = (X_WT.p - X_WB.p).norm();
    state.memory[angle_] = rotation_vector(X_WT.R * X_WB.R.conjugate()).norm();
  }

  [[nodiscard]] bool within(const state::WorldState& state, double share) const noexcept {
    return state.memory[distance_] <= share * reach_m_ && state.memory[angle_] <= share * reach_rad_;
  }

  [[nodiscard]] bool is_held(const state::WorldState& state) const noexcept {
    return std::ranges::any_of(state.users, [this](const state::UserState& user) { return user.holds(object_); });
  }

  /// The hand that carries the body feels this through its grasp. A body that nobody holds does not go home by itself.
  void draw(state::WorldState& state) const noexcept {
    const Vec3 p_WB = state[object_].X_WB.p;
    const Vec3 f_W = pull_.stiffness_n_per_m(state.memory[distance_]) * (X_WI(state) * X_IT_.p - p_WB);
    add_force(state[object_], f_W, p_WB);
    if (into_) add_force(state[into_], -f_W, p_WB);
  }

  /// The hands let go first: the body is led home without pulling anyone's hand along.
  void begin(state::WorldState& state) const noexcept {
    for (std::size_t u = 0; u < state.users.size(); ++u) {
      if (state.users[u].holds(object_)) let_go(state, u);
    }
    X_IFrom_.write(state, X_WI(state).inverse() * state[object_].X_WB);
    X_ITo_.write(state, place(state));
    state.memory[moving_] = 1;
    state.memory[time_s_] = 0;
    state[object_].movable = false;
    state[object_].V_WB = {};
  }

  void move(state::WorldState& state, double dt_s) const noexcept {
    state.memory[time_s_] += dt_s;
    const double t = std::min(1.0, state.memory[time_s_] / duration_s_);
    const double s = t * t * (3 - 2 * t);  // starts and ends at rest
    const Pose from = X_IFrom_.read(state), to = X_ITo_.read(state);
    const Pose X_IB{from.p + s * (to.p - from.p), t < 1 ? from.R.slerp(s, to.R) : to.R};
    state::BodyState& body = state[object_];
    body.X_WB = X_WI(state) * (t < 1 ? X_IB : to);
    body.V_WB = {};
    body.movable = t >= 1 && tied_;
    if (t < 1) return;
    state.memory[moving_] = 0;
    state.memory[placed_] = 1;
  }

  BodyId object_;
  BodyId into_;
  Pose X_IT_;
  Vec3 axis_B_;
  double reach_m_;
  double reach_rad_;
  double duration_s_;
  Pull pull_;
  bool tied_;
  std::size_t tie_ = 0;
  std::size_t placed_;
  std::size_t distance_;
  std::size_t angle_;
  std::size_t moving_;
  std::size_t time_s_;
  PoseSlots X_IFrom_;
  PoseSlots X_ITo_;
};

/// A lower bound, kg, of the mass that is felt at the body's origin, in any direction.
double least_mass_kg(const state::BodyDescription& body) {
  Mat3 arm;
  arm << 0, -body.p_BCm.z(), body.p_BCm.y(), body.p_BCm.z(), 0, -body.p_BCm.x(), -body.p_BCm.y(), body.p_BCm.x(), 0;
  const Mat3 per_kg = Mat3::Identity() / body.mass_kg + arm * body.inertia_kg_m2.inverse() * arm.transpose();
  return body.effort_scale / per_kg.norm();
}

/// The pull is an explicit spring, and must stay well below what would reverse the motion of the lighter body within one step.
Expected<void> check_pull(const Build& build, const Pull& pull) {
  constexpr double kStiffnessBound = 0.1;  // as that of touches, see haptics::bounded_spring()
  if (pull.strongest_n == 0) return {};
  const double taken_m = build.parameters.numbers("tolerance")[0];
  if (pull.reach_m <= taken_m)
    return fail(
        ErrorCode::conflict,
        fmt::format("the pull begins {:g} m from the place, where the snap takes the body already", pull.reach_m),
        build.place("pullFrom"),
        fmt::format("write a pullFrom that is larger than the tolerance's distance, {:g}", taken_m));
  for (const char* end : {"object", "into"}) {
    const BodyId id = build.parameters.body(end);
    if (!id || build.description.bodies[id.index()].fixed) continue;
    const double mass_kg = least_mass_kg(build.description.bodies[id.index()]);
    const double share = pull.stiffness_n_per_m(0) * kTickSeconds * kTickSeconds / (kStiffnessBound * mass_kg);
    if (share > 1)
      return fail(
          ErrorCode::conflict,
          fmt::format(
              "the pull would shake the body '{}': it is too light, and feels like {:.2g} kg (mass times effortScale)",
              build.parameters.text(end), mass_kg),
          build.place("pull"),
          fmt::format("write a pull of at most {:g}, or a larger pullFrom",
                      std::floor(100 * pull.strongest_n / share) / 100));
  }
  return {};
}

Expected<std::unique_ptr<Agent>> make_snap(const Build& build) {
  const state::Parameters& p = build.parameters;
  if (build.description.bodies[p.body("object").index()].fixed)
    return fail(ErrorCode::conflict, "the object '" + p.text("object") + "' is fixed", build.place("object"),
                "name a body that can be carried to its place");
  if (p.given("into") && p.body("into") == p.body("object"))
    return fail(ErrorCode::conflict, "'object' and 'into' name the same body", build.place("into"),
                "name another body in 'into', or none for the world");
  if (auto checked = check_pull(build, Snap::pull_of(p)); !checked) return tl::unexpected(checked.error());
  const std::vector<double> turn = p.numbers("rotation");
  const Vec3 about(turn[0], turn[1], turn[2]);
  if (about.norm() < 1e-9 && turn[3] != 0)
    return fail(ErrorCode::invalid_value, "the rotation has an angle, but its axis is 0 0 0", build.place("rotation"),
                "write axis and angle: x y z radians");
  const Pose X_IT{build.vector("position"),
                  about.norm() < 1e-9 ? Quat::Identity() : Quat(Eigen::AngleAxisd(turn[3], about.normalized()))};
  const auto axis_B = build.direction("axis", Vec3::Zero());
  if (!axis_B) return tl::unexpected(axis_B.error());
  return std::make_unique<Snap>(build, X_IT, *axis_B);
}

constexpr state::ParameterType kSnapParameters[] = {
    {.name = "object",
     .kind = ParameterKind::text,
     .summary = "the body that goes to its place",
     .required = true,
     .reference = state::Reference::body},
    {.name = "into",
     .kind = ParameterKind::text,
     .summary = "the body in whose frame the place is; none: the world",
     .reference = state::Reference::body},
    state::point("position", "where the object's frame goes"),
    {.name = "rotation",
     .kind = ParameterKind::numbers,
     .unit = "rad",
     .summary = "how it stands there: axis x y z, angle",
     .min = -state::kFarthest_m,
     .max = state::kFarthest_m,
     .count = 4},
    {.name = "tolerance",
     .kind = ParameterKind::numbers,
     .unit = "m, rad",
     .summary = "how close it must come: distance, angle",
     .required = true,
     .min = 0,
     .max = 100,
     .count = 2},
    state::direction("axis", "insertion axis in the object's frame: any rotation about it is right"),
    {.name = "duration",
     .unit = "s",
     .summary = "how long the last way takes",
     .default_value = 0.2,
     .min = 0.001,
     .max = 10},
    {.name = "pull",
     .unit = "N",
     .summary =
         "how strongly the place draws the body while a hand carries it, at most; the hand feels it; 0: not at all",
     .min = 0,
     .max = 5},
    {.name = "pullFrom",
     .unit = "m",
     .summary = "how far from the place the pull begins, more than the tolerance; it is strongest at 0.45 of this",
     .default_value = 0.2,
     .min = 0.02,
     .max = 2},
    {.name = "tied",
     .kind = ParameterKind::boolean,
     .summary = "held in its place by a tie, which bears forces and can break, instead of standing still"},
};
constexpr state::ValueType kSnapValues[] = {
    state::yes_or_no("placed", "1 once the object is in its place"),
    state::amount("distance", "m", "from the object to its place"),
    state::amount("angle", "rad", "between the object's attitude and the place's"),
};

}  // namespace

const AgentKind& snap_kind() {
  static const AgentKind kKind{{"geometry.snap", "Leads a body that is close to its place home and holds it there",
                                kSnapParameters, kSnapValues},
                               make_snap};
  return kKind;
}

}  // namespace mechane::agents
