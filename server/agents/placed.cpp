// simulation.placed: tells when a snap has its object.
#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

class Placed final : public Agent {
 public:
  Placed(const Build& build, std::string snap, BodyId object)
      : id_(build.id), object_(object), snap_(std::move(snap)), placed_(build.slot("placed")) {}

  Expected<void> link(const state::MemoryLayout& layout) override {
    source_ = layout.find(snap_ + ".placed")->index;
    return {};
  }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const double now = state.memory[source_];
    if (enabled && now != 0 && state.memory[placed_] == 0) {
      state.emit(state::EventKind::placed, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(object_.index()));
    }
    state.memory[placed_] = now;
  }

 private:
  AgentId id_;
  BodyId object_;
  std::string snap_;
  std::size_t source_ = 0;
  std::size_t placed_;
};

Expected<std::unique_ptr<Agent>> make_placed(const Build& build) {
  const state::ComponentDescription& snap = build.agent(build.parameters.agent("snap"));
  if (snap.type != "geometry.snap")
    return fail(ErrorCode::invalid_value, "the agent '" + snap.name + "' in 'snap' is a " + snap.type,
                build.place("snap"), "name a geometry.snap in 'snap'");
  // Faults in the snap's own parameters are reported when the snap is made; here its object only names the event's body.
  const std::string* object = snap.written_text("object");
  return std::make_unique<Placed>(build, snap.name,
                                  object != nullptr ? build.description.find_body(*object) : BodyId::none());
}

constexpr state::ParameterType kPlacedParameters[] = {
    {.name = "snap",
     .kind = state::ParameterKind::text,
     .summary = "the geometry.snap that is watched",
     .required = true,
     .reference = state::Reference::agent},
};
constexpr state::ValueType kPlacedValues[] = {state::yes_or_no("placed", "1 while the snap has its object")};

}  // namespace

const AgentKind& placed_kind() {
  static const AgentKind kKind{
      {"simulation.placed", "Says when a body has come to its place", kPlacedParameters, kPlacedValues}, make_placed};
  return kKind;
}

}  // namespace mechane::agents
