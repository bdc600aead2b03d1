// touch.surface: while it is on, a body feels otherwise than by itself.
#include <algorithm>
#include <array>

#include "server/agents/agent.hpp"
#include "server/state/surface_keys.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Surface final : public Agent {
 public:
  Surface(const Build& build, const state::HapticMaterial& surface)
      : object_(build.parameters.body("object")), surface_(surface), felt_(build.slot("felt")) {}

  /// A spring that hardened under a hand would give it energy that the hand never put in. So the surface changes only in a tick in which
  /// no hand touches the body.
  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const auto touches = [this](const state::UserState& user) { return user.touches(object_); };
    if (std::ranges::none_of(state.users, touches)) state.memory[felt_] = enabled ? 1 : 0;
    if (state.memory[felt_] != 0) state[object_].haptic = surface_;
  }

 private:
  BodyId object_;
  state::HapticMaterial surface_;
  std::size_t felt_;
};

Expected<std::unique_ptr<Agent>> make_surface(const Build& build) {
  const state::Parameters& p = build.parameters;
  const auto written = [&](std::string_view key) { return p.given(key) ? p.numbers(key) : std::vector<double>(); };
  std::vector<state::SurfaceFault> faults;
  state::HapticMaterial surface =
      changed_surface(build.description.bodies[p.body("object").index()].haptic, written, faults);
  if (p.given("stiffness")) surface.stiffness_n_per_m *= build.description.touch_scale;
  if (p.given("damping")) surface.damping_ns_per_m *= build.description.touch_scale;
  if (faults.empty()) return std::make_unique<Surface>(build, surface);
  const state::SurfaceFault& fault = faults.front();
  return fail(fault.code, fault.what, build.place(fault.key), fault.remedy);
}

/// The object, and the keys of its own surface; what is not written is as the body has it.
constexpr auto surface_parameters() {
  std::array<state::ParameterType, 1 + std::size(state::kSurfaceKeys)> all{};
  all[0] = {.name = "object",
            .kind = ParameterKind::text,
            .summary = "the body that feels otherwise",
            .required = true,
            .reference = state::Reference::body};
  std::ranges::copy(state::kSurfaceKeys, all.begin() + 1);
  for (std::size_t i = 1; i < all.size(); ++i)
    all[i].default_text = "the body's";
  return all;
}
constexpr auto kSurfaceParameters = surface_parameters();

constexpr state::ValueType kSurfaceValues[] = {
    state::yes_or_no("felt", "1 while the body feels so: a hand that touches it goes on feeling what it met"),
};

}  // namespace

const AgentKind& surface_kind() {
  static const AgentKind kKind{
      {"touch.surface",
       "While it is on, a body feels otherwise to hands; a hand that touches it goes on feeling what it met, until it "
       "leaves. Of two that are on, the later in `agents` counts, with all its keys; one that is written on the body "
       "itself is earlier than those",
       kSurfaceParameters, kSurfaceValues},
      make_surface};
  return kKind;
}

}  // namespace mechane::agents
