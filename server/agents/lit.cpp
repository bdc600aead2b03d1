// simulation.lit: a flame that is near for a while sets something on fire.
#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

Vec3 point_of(const Build& build, const char* name) {
  const std::vector<double> numbers = build.parameters.numbers(name);
  return {numbers[0], numbers[1], numbers[2]};
}

class Lit final : public Agent {
 public:
  explicit Lit(const Build& build)
      : id_(build.id),
        body_(build.parameters.body("body")),
        flame_(build.parameters.body("flame")),
        p_BQ_(point_of(build, "at")),
        p_FQ_(point_of(build, "flamePoint")),
        distance_m_(build.parameters.number("distance")),
        time_s_(build.parameters.number("time")),
        burn_s_(build.parameters.number("burnTime")),
        needs_(build.parameters.text("needs")),
        lit_(build.slot("lit")),
        near_(build.slot("distance")),
        near_s_(build.slot("own.near_s")),
        burnt_s_(build.slot("burnt_s")) {}

  Expected<void> link(const state::MemoryLayout& layout) override {
    if (!needs_.empty()) needed_ = layout.find(needs_ + ".lit")->index;
    return {};
  }

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const Vec3 gap = state[flame_].X_WB * p_FQ_ - state[body_].X_WB * p_BQ_;
    state.memory[near_] = gap.norm();
    const bool burns = needs_.empty() || state.memory[needed_] != 0;
    const bool close = enabled && burns && state[flame_].visible && state.memory[near_] <= distance_m_;
    state.memory[near_s_] = close ? state.memory[near_s_] + dt_s : 0;
    if (state.memory[lit_] != 0) {
      state.memory[burnt_s_] += dt_s;
      if (burn_s_ > 0 && state.memory[burnt_s_] >= burn_s_) state.memory[lit_] = 0;
    } else if (close && state.memory[near_s_] + 0.5 * dt_s >= time_s_) {
      state.memory[lit_] = 1;
      state.memory[burnt_s_] = 0;
      state.emit(state::EventKind::lit, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(body_.index()));
    }
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
  std::size_t lit_;
  std::size_t near_;
  std::size_t near_s_;
  std::size_t burnt_s_;
};

Expected<std::unique_ptr<Agent>> make_lit(const Build& build) {
  const std::string where = state::component_place(build.component);
  if (build.parameters.body("body") == build.parameters.body("flame"))
    return fail("the body is to light itself", where, "name another body in 'flame'");
  if (build.parameters.given("needs")) {
    const state::ComponentDescription& other = build.agent(build.parameters.agent("needs"));
    if (other.type != "simulation.lit" || &other == &build.component)
      return fail("'" + other.name + "' says of no flame whether it burns", where, "name another simulation.lit");
  }
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
     .summary = "what brings the fire: a body that is hidden brings none",
     .required = true,
     .reference = state::Reference::body},
    {.name = "at",
     .kind = ParameterKind::numbers,
     .unit = "m",
     .summary = "where it catches fire, in its frame",
     .count = 3},
    {.name = "flamePoint",
     .kind = ParameterKind::numbers,
     .unit = "m",
     .summary = "where the flame is, in its body's frame",
     .count = 3},
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
};
constexpr state::ValueType kLitValues[] = {
    {"lit", "", "1 while it burns"},
    {"distance", "m", "from the flame to where it catches fire"},
    {"burnt_s", "s", "how long it has burned"},
};

}  // namespace

const AgentKind& lit_kind() {
  static const AgentKind kKind{
      {"simulation.lit", "A flame that is near for a while lights a fire", kLitParameters, kLitValues}, make_lit};
  return kKind;
}

}  // namespace mechane::agents
