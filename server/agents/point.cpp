// simulation.point: an index finger, or a one-point device, at a sign or pointing at it; or a click on it.
#include <algorithm>
#include <cmath>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using hand::HandKind;
using state::ParameterKind;

constexpr std::size_t kIndexTip = 6;  // segment of the index finger's last phalanx; x along it, origin in its middle
constexpr double kHalfTip_m = 0.5 * 0.020 + 0.0075;  // from that origin to the fingertip's skin, for a hand of scale 1

struct Finger {
  Vec3 p_W;
  Vec3 direction_W;
};

/// A one-point device points away from the person who holds it: along -z, as a view does.
Finger finger_of(const state::UserState& user) {
  if (user.sample.kind == HandKind::one_point) return {user.X_WH.p, user.X_WH.rotate(-Vec3::UnitZ())};
  const Pose& X_WS = user.X_WS[kIndexTip];
  return {X_WS * Vec3(kHalfTip_m * user.sample.length_scale(kIndexTip), 0, 0), X_WS.rotate(Vec3::UnitX())};
}

class Point final : public Agent {
 public:
  explicit Point(const Build& build)
      : id_(build.id),
        body_(build.parameters.body("body")),
        p_BQ_(build.vector("position")),
        distance_m_(build.parameters.given("distance") || !build.parameters.given("cone")
                        ? build.parameters.number("distance")
                        : 0),
        cone_rad_(build.parameters.given("cone") ? build.parameters.number("cone") : 0),
        reach_m_(build.parameters.number("reach")),
        time_s_(build.parameters.number("time")),
        pointed_(build.slot("pointed")),
        distance_(build.slot("distance")),
        angle_(build.slot("angle")),
        time_(build.slot("time")),
        clicked_(build.slot("clicked")) {}

  bool click(state::WorldState& state, BodyId body) const noexcept override {
    if (body != body_ || !state[body_].visible) return false;
    state.memory[clicked_] = kClickLasts_s;
    return true;
  }

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const Vec3 p_WQ = state[body_].X_WB * p_BQ_;
    double nearest = kFar, best_angle = kPi;
    double who = -1;
    for (std::size_t u = 0; u < state.users.size(); ++u) {
      const state::UserState& user = state.users[u];
      if (!user.present || user.stale) continue;
      const Finger finger = finger_of(user);
      const Vec3 way = p_WQ - finger.p_W;
      const double distance = way.norm();
      const double angle = std::atan2(finger.direction_W.cross(way).norm(), finger.direction_W.dot(way));
      const bool hits = distance <= distance_m_ || (cone_rad_ > 0 && angle <= cone_rad_ && distance <= reach_m_);
      if (hits && who < 0) who = static_cast<double>(u);
      nearest = std::min(nearest, distance);
      best_angle = std::min(best_angle, angle);
    }
    const bool points = enabled && state[body_].visible && who >= 0;
    state.memory[distance_] = nearest;
    state.memory[angle_] = best_angle;
    state.memory[time_] = points ? state.memory[time_] + dt_s : 0;
    const bool clicked = enabled && state[body_].visible && state.memory[clicked_] > 0;
    state.memory[clicked_] = clicked ? state.memory[clicked_] - dt_s : 0;
    const bool long_enough = clicked || (points && state.memory[time_] + 0.5 * dt_s >= time_s_);
    if (long_enough && state.memory[pointed_] == 0) {
      state.emit(state::EventKind::pointed, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(body_.index()), who);
    }
    state.memory[pointed_] = long_enough ? 1 : 0;
  }

 private:
  static constexpr double kFar = 1e6;  // m: without any hand
  // A click is one message: it stands for a finger that stays this long.
  static constexpr double kClickLasts_s = 1.0;

  AgentId id_;
  BodyId body_;
  Vec3 p_BQ_;
  double distance_m_;
  double cone_rad_;
  double reach_m_;
  double time_s_;
  std::size_t pointed_;
  std::size_t distance_;
  std::size_t angle_;
  std::size_t time_;
  std::size_t clicked_;
};

Expected<std::unique_ptr<Agent>> make_point(const Build& build) {
  return std::make_unique<Point>(build);
}

constexpr state::ParameterType kPointParameters[] = {
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "the sign; a hidden one is not pointed at",
     .required = true,
     .reference = state::Reference::body},
    state::point("position",
                 "the point meant, in its frame; behind a board's face, so that the fingertip is near it only where it "
                 "touches the board"),
    {.name = "distance",
     .unit = "m",
     .summary = "the fingertip is at the sign within this of the point. Where a cone is given and this is not, only "
                "pointing counts",
     .default_value = 0.03,
     .min = 0.001,
     .max = 10},
    {.name = "cone",
     .unit = "rad",
     .summary = "from afar too: the finger points at the point within this angle, and is within reach",
     .min = 0.01,
     .max = 1.5},
    {.name = "reach", .unit = "m", .summary = "how far pointing reaches", .default_value = 3, .min = 0.01, .max = 100},
    {.name = "time", .unit = "s", .summary = "for how long", .default_value = 0.3, .min = 0, .max = 60},
};
constexpr state::ValueType kPointValues[] = {
    state::yes_or_no("pointed", "1 while a finger has been on it for long enough"),
    state::amount("distance", "m", "from the nearest fingertip"),
    state::amount("angle", "rad", "between the sign and where the best finger points"),
    state::amount("time", "s", "for how long"),
    state::amount("clicked", "s", "how long a click on the sign still counts as a finger"),
};

}  // namespace

const AgentKind& point_kind() {
  static const AgentKind kKind{{"simulation.point",
                                "An index finger is at a sign, or points at it; or somebody clicks on it. For a sign "
                                "that opens an exhibit: a quantity "
                                "NAME.pointed, a trigger on it, a step with opens; village/village.x3d has eight",
                                kPointParameters, kPointValues},
                               make_point};
  return kKind;
}

}  // namespace mechane::agents
