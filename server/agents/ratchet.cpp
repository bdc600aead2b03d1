// geometry.ratchet: a joint goes one way; the last tooth that it passed keeps it from going back.
#include <algorithm>
#include <cmath>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::JointKind;
using state::ParameterKind;

constexpr double kReached = 1e-6;  // of a tooth: so close counts as passed, because of rounding

class Ratchet final : public Agent {
 public:
  Ratchet(const Build& build, double pitch)
      : joint_(build.parameters.joint("joint")),
        pawl_(build.parameters.joint("pawl")),
        lift_(build.parameters.number("liftAngle")),
        pitch_(pitch),
        phase_(build.parameters.number("phase")),
        sign_(build.parameters.boolean("reverse") ? -1 : 1),
        real_per_felt_(build.real_per_felt()),
        engaged_(build.slot("engaged")),
        tooth_(build.slot("tooth")),
        holding_(build.slot("holding")),
        torque_(build.slot("torque")),
        force_(build.slot("force")) {
    state::Coupling stop;
    stop.kind = state::CouplingKind::stop;
    stop.joint1 = joint_;
    stop.sign = sign_;
    coupling_ = build.coupling(stop);
  }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const bool lifted = pawl_ && std::abs(state[pawl_].position) > lift_;
    const bool engaged = enabled && state[joint_].enabled && !lifted;
    const double passed = std::floor((sign_ * state[joint_].position - phase_) / pitch_ + kReached);
    const bool new_here = state.memory[engaged_] == 0;
    if (engaged) state.memory[tooth_] = new_here ? passed : std::max(state.memory[tooth_], passed);
    state.memory[engaged_] = engaged ? 1 : 0;
    state::Coupling& stop = state.couplings[coupling_];
    stop.enabled = engaged;
    stop.offset = sign_ * (state.memory[tooth_] * pitch_ + phase_);
    state.memory[holding_] = engaged && (stop.torque_nm > 0 || stop.force_n > 0) ? 1 : 0;
    state.memory[torque_] = stop.torque_nm * real_per_felt_;
    state.memory[force_] = stop.force_n * real_per_felt_;
  }

 private:
  JointId joint_;
  JointId pawl_;
  double lift_;
  double pitch_;
  double phase_;
  double sign_;
  double real_per_felt_;
  std::size_t coupling_ = 0;
  std::size_t engaged_;
  std::size_t tooth_;
  std::size_t holding_;
  std::size_t torque_;
  std::size_t force_;
};

Expected<std::unique_ptr<Agent>> make_ratchet(const Build& build) {
  constexpr const char* kTeethOrPitch = "give teeth for a hinge, pitch for a slider";
  const state::Parameters& p = build.parameters;
  const auto joint = build.hinge_or_slider("joint");
  if (!joint) return tl::unexpected(joint.error());
  if (!p.given("teeth") && !p.given("pitch"))
    return fail(ErrorCode::missing, "neither teeth nor pitch is given", build.place(), kTeethOrPitch);
  if (p.given("teeth") && p.given("pitch"))
    return fail(ErrorCode::conflict, "both teeth and pitch are given", build.place("pitch"), kTeethOrPitch);
  const bool hinge = build.description.joints[joint->index()].kind == JointKind::hinge;
  if (p.given("teeth") != hinge)
    return fail(ErrorCode::conflict,
                hinge ? "pitch is given, but the joint is a hinge" : "teeth are given, but the joint is a slider",
                build.place(hinge ? "pitch" : "teeth"), kTeethOrPitch);
  if (p.given("pawl") && p.joint("pawl") == *joint)
    return fail(ErrorCode::conflict, "'pawl' and 'joint' name the same joint", build.place("pawl"),
                "name the pawl's own joint, or none");
  return std::make_unique<Ratchet>(build, p.given("teeth") ? 2 * kPi / p.number("teeth") : p.number("pitch"));
}

constexpr state::ParameterType kRatchetParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge or slider that is held",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "teeth", .summary = "of a hinge's wheel", .min = 1, .max = 1e5},
    {.name = "pitch", .unit = "m", .summary = "from tooth to tooth of a slider's bar", .min = 1e-4, .max = 10},
    {.name = "phase", .unit = "rad or m", .summary = "position of a tooth", .min = -100, .max = 100},
    {.name = "reverse",
     .kind = ParameterKind::boolean,
     .summary = "it goes to lower positions and is held from higher"},
    {.name = "pawl",
     .kind = ParameterKind::text,
     .summary = "the joint of a pawl that a hand lifts; none: the pawl is down while this agent is on",
     .reference = state::Reference::joint},
    {.name = "liftAngle",
     .unit = "rad or m",
     .summary = "the pawl is off the teeth where it is further than this from where it was at the start",
     .default_value = 0.2,
     .min = 0,
     .max = 10},
};
constexpr state::ValueType kRatchetValues[] = {
    state::yes_or_no("engaged", "1 while the pawl is on the teeth"),
    {"tooth", "", "the last tooth passed"},
    state::yes_or_no("holding", "1 while the pawl bears a load"),
    {"torque", "N m", "what it bears on a hinge: the real torque"},
    {"force", "N", "what it bears on a slider: the real force"},
};

}  // namespace

const AgentKind& ratchet_kind() {
  static const AgentKind kKind{
      {"geometry.ratchet", "A joint goes one way; teeth hold it from going back", kRatchetParameters, kRatchetValues},
      make_ratchet};
  return kKind;
}

}  // namespace mechane::agents
