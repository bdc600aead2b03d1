// geometry.breakable: a joint, tie, gear or rope that lets go over a force or torque, and stays broken until the activity begins anew.
#include <cmath>
#include <limits>
#include <optional>

#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Breakable final : public Agent {
 public:
  Breakable(const Build& build, std::string target)
      : id_(build.id),
        target_(build.parameters.agent("agent")),
        target_name_(std::move(target)),
        most_n_(build.parameters.given("force") ? build.parameters.number("force") : kNever),
        most_nm_(build.parameters.given("torque") ? build.parameters.number("torque") : kNever),
        real_per_felt_(build.real_per_felt()),
        broken_(build.slot("broken")),
        force_(build.slot("force")),
        torque_(build.slot("torque")) {
    if (const JointId joint = switched_joint(build.description, build.agent(target_))) {
      state::Coupling watch;
      watch.kind = state::CouplingKind::watch;
      watch.joint1 = joint;
      coupling_ = build.coupling(watch);
    }
  }

  Expected<void> link(const state::MemoryLayout& layout) override {
    if (!coupling_) coupling_ = layout.find_coupling(target_name_)->index;
    if (const state::MemorySlot* placed = layout.find(target_name_ + ".placed")) placed_ = placed->index;
    return {};
  }

  [[nodiscard]] bool switches_others() const noexcept override { return true; }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const state::Coupling& bears = state.couplings[*coupling_];
    state.memory[force_] = bears.force_n * real_per_felt_;
    state.memory[torque_] = bears.torque_nm * real_per_felt_;
    const bool too_much = state.memory[force_] > most_n_ || state.memory[torque_] > most_nm_;
    if (enabled && too_much && state.memory[broken_] == 0) {
      state.memory[broken_] = 1;
      state.emit(state::EventKind::broke, static_cast<std::uint32_t>(id_.index()), 0xffffffffu,
                 state.memory[force_] > most_n_ ? state.memory[force_] : state.memory[torque_]);
    }
    if (state.memory[broken_] == 0) return;
    state.agent_enabled[target_.index()] = 0;
    if (placed_) state.memory[*placed_] = 0;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  AgentId id_;
  AgentId target_;
  std::string target_name_;
  double most_n_;
  double most_nm_;
  double real_per_felt_;
  std::optional<std::size_t> coupling_;
  std::optional<std::size_t> placed_;  // of a snap
  std::size_t broken_;
  std::size_t force_;
  std::size_t torque_;
};

bool is_tied_snap(const state::ComponentDescription& agent) {
  const bool* tied = agent.written<bool>("tied");
  return agent.type == "geometry.snap" && tied != nullptr && *tied;
}

Expected<std::unique_ptr<Agent>> make_breakable(const Build& build) {
  const state::ComponentDescription& target = build.agent(build.parameters.agent("agent"));
  bool bears = static_cast<bool>(switched_joint(build.description, target)) || is_tied_snap(target);
  for (const char* type : {"geometry.fixed", "geometry.gear", "geometry.worm", "geometry.ratchet", "geometry.rope"})
    bears = bears || target.type == type;
  if (!bears)
    return fail(ErrorCode::invalid_value,
                "'" + target.name + "' is a " + target.type + ", which bears no force or torque that could break it",
                build.place("agent"),
                "name a hinge, slider, ball, screw, fixed, gear, worm, ratchet, rope, or a snap with tied true");
  if (!build.parameters.given("force") && !build.parameters.given("torque"))
    return fail(ErrorCode::missing, "neither 'force' nor 'torque' is given: it would never break", build.place(),
                "give force, torque or both");
  return std::make_unique<Breakable>(build, target.name);
}

constexpr state::ParameterType kBreakableParameters[] = {
    {.name = "agent",
     .kind = ParameterKind::text,
     .summary = "what breaks: it is switched off, and stays off until the activity begins anew",
     .required = true,
     .reference = state::Reference::agent},
    {.name = "force",
     .unit = "N",
     .summary = "the real force that breaks it",
     .default_value = state::kNoDefault,
     .min = 0,
     .max = 1e9},
    {.name = "torque",
     .unit = "N m",
     .summary = "the real torque that breaks it",
     .default_value = state::kNoDefault,
     .min = 0,
     .max = 1e9},
};
constexpr state::ValueType kBreakableValues[] = {
    state::yes_or_no("broken", "1 once it is broken"),
    state::amount("force", "N", "what it bears: the real force"),
    state::amount("torque", "N m", "what it bears: the real torque"),
};

}  // namespace

const AgentKind& breakable_kind() {
  static const AgentKind kKind{
      {"geometry.breakable", "Something lets go over a force or a torque", kBreakableParameters, kBreakableValues},
      make_breakable};
  return kKind;
}

}  // namespace mechane::agents
