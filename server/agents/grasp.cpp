// simulation.grasp: hands that touch a body and close on it hold it.
//
// A glove's hand closes on a body when the thumb and another finger touch it from opposite sides. A one-point device, or a glove that
// reports a grasp intent, closes by its intent while it touches. Either must last for holdTime. A hand must have been open before: it
// does not take again, without opening, what a snap, a step or a jump took out of it. Several agents may name one body, each with its
// own limits, switched by the steps; each ends only the grasps that it began.
#include <algorithm>
#include <array>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using hand::HandKind;
using state::ParameterKind;

constexpr double kIntentCloses = 0.5;
constexpr double kOpposed = -0.3;  // cosine between the thumb's and the finger's contact normals

/// How one hand touches one body.
struct Touch {
  bool any = false;
  bool opposed = false;
  Vec3 p_WG = Vec3::Zero();  ///< the grip's centre: between thumb and finger, or the contacts' middle
};

struct Patch {
  Vec3 p_sum = Vec3::Zero();
  Vec3 n_sum = Vec3::Zero();
  double depth = 0;

  void add(const state::Contact& contact) {
    const double weight = std::max(contact.depth_m, 1e-9);
    p_sum += weight * contact.p_WC;
    n_sum += weight * contact.n_BH_W;
    depth += weight;
  }
  [[nodiscard]] Vec3 middle() const { return p_sum / depth; }
};

/// 0 palm, 1 thumb, 2..5 the fingers.
std::size_t digit_of(std::uint8_t segment) {
  return segment == 0 ? 0 : hand::finger_of(segment) + 1;
}

Touch find_touch(const state::UserState& user, BodyId body) {
  std::array<Patch, 1 + hand::kFingers> digits{};
  Patch all;
  for (const state::Contact& contact : user.contact_span()) {
    if (contact.body != body) continue;
    all.add(contact);
    const std::size_t digit = digit_of(contact.segment);
    if (digit < digits.size()) digits[digit].add(contact);
  }
  Touch touch;
  touch.any = all.depth > 0;
  if (!touch.any) return touch;
  touch.p_WG = all.middle();
  const Patch& thumb = digits[1];
  if (user.sample.kind != HandKind::glove || thumb.depth <= 0) return touch;
  double best = kOpposed;
  for (std::size_t d = 2; d < digits.size(); ++d) {
    if (digits[d].depth <= 0) continue;
    const double cosine = thumb.n_sum.normalized().dot(digits[d].n_sum.normalized());
    if (cosine >= best) continue;
    best = cosine;
    touch.opposed = true;
    touch.p_WG = 0.5 * (thumb.middle() + digits[d].middle());
  }
  return touch;
}

class GraspAgent final : public Agent {
 public:
  explicit GraspAgent(const Build& build, std::vector<BodyId> bodies)
      : bodies_(std::move(bodies)),
        force_limit_n_(build.parameters.number("forceLimit")),
        torque_limit_nm_(build.parameters.number("torqueLimit")),
        hold_s_(build.parameters.number("holdTime")),
        opening_(build.parameters.number("opening")),
        break_m_(build.parameters.number("breakDistance")),
        active_(build.slot("active")),
        body_(build.slot("body", -1)) {
    for (std::size_t u = 0; u < hand::kMaxUsers; ++u) {
      const std::string user = "user" + std::to_string(u);
      was_open_[u] = build.slot(user + ".was_open", 1);
      closed_s_[u] = build.slot(user + ".closed_s");
      open_s_[u] = build.slot(user + ".open_s");
      holds_[u] = build.slot(user + ".holds");
    }
  }

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    state.memory[active_] = 0;
    state.memory[body_] = -1;
    for (std::size_t u = 0; u < state.users.size(); ++u) {
      const state::Grasp& grasp = state.users[u].grasp;
      if (!grasp.active) state.memory[holds_[u]] = 0;
      if (!state.users[u].present) {
        forget(state, u, true);
      } else if (state.memory[holds_[u]] != 0) {
        hold_on(state, u, enabled, dt_s);
      } else if (grasp.active) {
        forget(state, u, false);  // another agent's grasp: this one does not take it over until the hand has opened
      } else {
        reach(state, u, enabled, dt_s);
      }
      if (!grasp.active || state.memory[holds_[u]] == 0) continue;
      state.memory[active_] += 1;
      if (state.memory[body_] < 0) state.memory[body_] = static_cast<double>(grasp.body.index());
    }
  }

 private:
  void forget(state::WorldState& state, std::size_t u, bool was_open) const noexcept {
    state.memory[was_open_[u]] = was_open ? 1 : 0;
    state.memory[closed_s_[u]] = 0;
    state.memory[open_s_[u]] = 0;
  }

  /// A hand that holds a body keeps it, or lets go.
  void hold_on(state::WorldState& state, std::size_t u, bool enabled, double dt_s) const noexcept {
    const state::UserState& user = state.users[u];
    const state::BodyState& body = state[user.grasp.body];
    const Touch touch = find_touch(user, user.grasp.body);
    const bool open = user.sample.grasp_intent < opening_ && !touch.opposed;
    state.memory[open_s_[u]] = open ? state.memory[open_s_[u]] + dt_s : 0;
    const Vec3 p_WG_hand = user.X_WH * (user.grasp.X_HB * user.grasp.p_BG);
    const bool torn = (p_WG_hand - body.X_WB * user.grasp.p_BG).norm() > break_m_;
    const bool opened = state.memory[open_s_[u]] >= hold_s_;
    const bool gone = user.freshness <= 0;
    if (!opened && !gone && !torn && enabled && body.graspable && body.movable) return;
    let_go(state, u);
    state.memory[holds_[u]] = 0;
    forget(state, u, opened || gone);  // a hand whose samples stopped may take hold again when they come back
  }

  /// An empty hand takes hold, or not yet.
  void reach(state::WorldState& state, std::size_t u, bool enabled, double dt_s) const noexcept {
    const state::UserState& user = state.users[u];
    BodyId touched;
    Touch touch;
    bool any_opposed = false;
    for (const BodyId body : bodies_) {
      if (!state[body].graspable || !state[body].movable) continue;
      const Touch now = find_touch(user, body);
      any_opposed = any_opposed || now.opposed;
      if (!now.any || (touched && !(now.opposed && !touch.opposed))) continue;
      touched = body;
      touch = now;
    }
    const bool intends = user.sample.grasp_intent > kIntentCloses;
    if (user.sample.grasp_intent < opening_ && !any_opposed) state.memory[was_open_[u]] = 1;
    const bool closing =
        enabled && touched && (intends || touch.opposed) && state.memory[was_open_[u]] != 0 && user.freshness > 0;
    state.memory[closed_s_[u]] = closing ? state.memory[closed_s_[u]] + dt_s : 0;
    if (closing && state.memory[closed_s_[u]] >= hold_s_) take(state, u, touched, touch.p_WG);
  }

  void take(state::WorldState& state, std::size_t u, BodyId body, const Vec3& p_WG) const noexcept {
    state::UserState& user = state.users[u];
    const Pose& X_WB = state[body].X_WB;
    user.grasp = {true, body, user.X_WH.inverse() * X_WB, X_WB.inverse() * p_WG, force_limit_n_, torque_limit_nm_, {}};
    state.memory[holds_[u]] = 1;
    forget(state, u, false);
    state.emit(state::EventKind::grasped, static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(body.index()));
  }

  std::vector<BodyId> bodies_;
  double force_limit_n_;
  double torque_limit_nm_;
  double hold_s_;
  double opening_;
  double break_m_;
  std::size_t active_;
  std::size_t body_;
  std::array<std::size_t, hand::kMaxUsers> was_open_{};
  std::array<std::size_t, hand::kMaxUsers> closed_s_{};  // how long the hand has been closing on a body
  std::array<std::size_t, hand::kMaxUsers> holds_{};     // the grasp is this agent's: another may share its bodies
  std::array<std::size_t, hand::kMaxUsers> open_s_{};    // how long the holding hand has been open
};

Expected<std::unique_ptr<Agent>> make_grasp(const Build& build) {
  std::vector<BodyId> bodies;
  for (const std::string& name : build.parameters.texts("bodies"))
    bodies.push_back(build.description.find_body(name));
  if (!build.parameters.given("bodies")) {
    for (std::size_t i = 0; i < build.description.bodies.size(); ++i)
      bodies.emplace_back(i);
  }
  std::erase_if(bodies, [&](BodyId body) { return build.description.bodies[body.index()].fixed; });
  if (bodies.empty())
    return fail(ErrorCode::conflict, "every body that may be grasped is fixed", build.place("bodies"),
                "name bodies that are not fixed in 'bodies'");
  return std::make_unique<GraspAgent>(build, std::move(bodies));
}

constexpr state::ParameterType kGraspParameters[] = {
    {.name = "bodies",
     .kind = ParameterKind::texts,
     .summary = "what may be grasped, while it is graspable and movable; none named: every body",
     .reference = state::Reference::body},
    {.name = "forceLimit",
     .unit = "N",
     .summary = "what the hand can pull with, as felt",
     .default_value = 12,
     .min = 0,
     .max = 500},
    {.name = "torqueLimit",
     .unit = "N m",
     .summary = "what the hand can turn with before the body turns in it; small for a crank's handle",
     .default_value = 0.1,
     .min = 0,
     .max = 50},
    {.name = "holdTime",
     .unit = "s",
     .summary = "how long a hand must close, or open, before it counts",
     .default_value = 0.02,
     .min = 0,
     .max = 5},
    {.name = "opening",
     .summary = "grasp intent below which a hand is open",
     .default_value = 0.3,
     .min = 0,
     .max = 0.5},
    {.name = "breakDistance",
     .unit = "m",
     .summary = "the body is lost where it lags this far behind the hand",
     .default_value = 0.08,
     .min = 0.005,
     .max = 10},
};
constexpr state::ValueType kGraspValues[] = {
    state::amount("active", "", "hands that hold one of the bodies"),
    {"body", "", "index of the body that the first of them holds; -1: none", -1},
};

}  // namespace

const AgentKind& grasp_kind() {
  static const AgentKind kKind{{"simulation.grasp", "Lets hands take hold of bodies", kGraspParameters, kGraspValues},
                               make_grasp};
  return kKind;
}

}  // namespace mechane::agents
