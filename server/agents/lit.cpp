// simulation.lit: a flame that is near for a while sets something on fire. A fire behind a door needs the air that the open door lets
// in: with the door shut it cannot be lit, and goes out after a while if it burns.
#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Lit final : public Agent {
 public:
  explicit Lit(const Build& build)
      : id_(build.id),
        body_(build.parameters.body("body")),
        flame_(build.parameters.body("flame")),
        p_BQ_(build.vector("at")),
        p_FQ_(build.vector("flamePoint")),
        distance_m_(build.parameters.number("distance")),
        time_s_(build.parameters.number("time")),
        burn_s_(build.parameters.number("burnTime")),
        needs_(build.parameters.text("needs")),
        shows_(build.parameters.body("shows")),
        door_(build.parameters.joint("door")),
        shut_at_(build.parameters.number("shutAt")),
        smother_s_(build.parameters.number("smotherTime")),
        lit_(build.slot("lit")),
        near_(build.slot("distance")),
        near_s_(build.slot("own.near_s")),
        burnt_s_(build.slot("burnt_s")),
        shut_s_(build.slot("own.shut_s")) {}

  Expected<void> link(const state::MemoryLayout& layout) override {
    if (!needs_.empty()) needed_ = layout.find(needs_ + ".lit")->index;
    return {};
  }

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const Vec3 gap = state[flame_].X_WB * p_FQ_ - state[body_].X_WB * p_BQ_;
    state.memory[near_] = gap.norm();
    const bool burns = needs_.empty() || state.memory[needed_] != 0;
    const bool shut = door_ && state[door_].position >= shut_at_;
    state.memory[shut_s_] = shut ? state.memory[shut_s_] + dt_s : 0;
    const bool close = enabled && burns && !shut && state[flame_].visible && state.memory[near_] <= distance_m_;
    state.memory[near_s_] = close ? state.memory[near_s_] + dt_s : 0;
    if (state.memory[lit_] != 0) {
      state.memory[burnt_s_] += dt_s;
      const bool burnt_down = burn_s_ > 0 && state.memory[burnt_s_] >= burn_s_;
      const bool smothered = shut && state.memory[shut_s_] + 0.5 * dt_s >= smother_s_;
      if (burnt_down || smothered) state.memory[lit_] = 0;
    } else if (close && state.memory[near_s_] + 0.5 * dt_s >= time_s_) {
      state.memory[lit_] = 1;
      state.memory[burnt_s_] = 0;
      state.emit(state::EventKind::lit, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(body_.index()));
    }
    if (shows_) state[shows_].visible = state.memory[lit_] != 0;
  }

 private:
  AgentId id_;
  BodyId body_;
  BodyId flame_;
  Vec3 p_BQ_;
  Vec3 p_FQ_;
  double distance_m_;
  double time_s_;
  double burn_s_;
  std::string needs_;
  std::size_t needed_ = 0;
  BodyId shows_;
  JointId door_;
  double shut_at_;
  double smother_s_;
  std::size_t lit_;
  std::size_t near_;
  std::size_t near_s_;
  std::size_t burnt_s_;
  std::size_t shut_s_;
};

Expected<std::unique_ptr<Agent>> make_lit(const Build& build) {
  const state::Parameters& p = build.parameters;
  if (p.body("body") == p.body("flame"))
    return fail(ErrorCode::conflict, "'body' and 'flame' name the same body", build.place("flame"),
                "name another body in 'flame'");
  if (p.given("needs")) {
    const state::ComponentDescription& other = build.agent(p.agent("needs"));
    if (other.type != "simulation.lit" || &other == &build.component)
      return fail(ErrorCode::invalid_value, "'" + other.name + "' in 'needs' is not another simulation.lit",
                  build.place("needs"), "name another simulation.lit in 'needs'");
  }
  const bool door = p.given("door");
  if (!door && (p.given("shutAt") || p.given("smotherTime")))
    return fail(ErrorCode::missing, "shutAt or smotherTime is given, but no door",
                build.place(p.given("shutAt") ? "shutAt" : "smotherTime"), "name a joint in 'door'");
  if (door && !p.given("shutAt"))
    return fail(ErrorCode::missing, "a door is given, but not where it is shut", build.place("door"),
                "write the joint's position when shut in 'shutAt'");
  return std::make_unique<Lit>(build);
}

constexpr state::ParameterType kLitParameters[] = {
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "what is lit: a hearth, a lamp, a torch",
     .required = true,
     .reference = state::Reference::body},
    {.name = "flame",
     .kind = ParameterKind::text,
     .summary = "the body that brings the fire; while it is hidden, it lights nothing",
     .required = true,
     .reference = state::Reference::body},
    state::point("at", "where it catches fire, in its frame"),
    state::point("flamePoint", "where the flame is, in its body's frame"),
    {.name = "distance",
     .unit = "m",
     .summary = "how close they must be",
     .default_value = 0.1,
     .min = 0.001,
     .max = 10},
    {.name = "time", .unit = "s", .summary = "for how long", .default_value = 0.5, .min = 0, .max = 60},
    {.name = "burnTime", .unit = "s", .summary = "how long it burns; 0: on and on", .min = 0, .max = 1e5},
    {.name = "needs",
     .kind = ParameterKind::text,
     .summary = "the simulation.lit by which the flame itself must burn; none: it always does",
     .reference = state::Reference::agent},
    {.name = "shows",
     .kind = ParameterKind::text,
     .summary = "a body that is seen while it burns, and only then: its flames",
     .reference = state::Reference::body},
    {.name = "door",
     .kind = ParameterKind::text,
     .summary = "the hinge or slider of a door that lets air to the fire; none: it always has air",
     .reference = state::Reference::joint},
    state::joint_position("shutAt", "m or rad", "with door: from this position of the joint on no air comes in"),
    {.name = "smotherTime",
     .unit = "s",
     .summary = "with door: how long a fire burns without air",
     .default_value = 1,
     .min = 0,
     .max = 3600},
};
constexpr state::ValueType kLitValues[] = {
    state::yes_or_no("lit", "1 while it burns"),
    state::amount("distance", "m", "from the flame to where it catches fire"),
    state::amount("burnt_s", "s", "how long it has burned"),
};

}  // namespace

const AgentKind& lit_kind() {
  static const AgentKind kKind{
      {"simulation.lit", "A flame that is near for a while lights a fire", kLitParameters, kLitValues}, make_lit};
  return kKind;
}

}  // namespace mechane::agents
