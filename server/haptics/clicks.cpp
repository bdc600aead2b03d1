#include "server/haptics/clicks.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::haptics {
namespace {

bool feels(const state::UserState& user, BodyId body) {
  if (!user.present) return false;
  if (user.grasp.active && user.grasp.body == body) return true;
  const auto contacts = user.contact_span();
  return std::any_of(contacts.begin(), contacts.end(), [body](const state::Contact& c) { return c.body == body; });
}

/// Whether a value has left the step that it was on, which then is the new one. A value that trembles at a step's lower end stays on it.
bool goes_on(double value, double& step) {
  constexpr double kTrembles = 0.2;
  if (!std::isfinite(value)) return false;
  const bool first = std::isnan(step);
  if (!first && value >= step - kTrembles && value < step + 1) return false;
  step = std::floor(value);
  return !first;
}

}  // namespace

void add_click(state::UserState& user, std::uint64_t tick, double strength_n) noexcept {
  constexpr std::uint64_t kApartTicks = 20;
  if (user.output.clicks.count > 0 && tick - user.click_tick < kApartTicks) return;
  user.click_tick = tick;
  ++user.output.clicks.count;
  user.output.clicks.strength_n = std::min(strength_n, hand::kMaxClick_n);
}

void find_clicks(const state::WorldDescription& description, state::WorldState& state) noexcept {
  for (std::size_t i = 0; i < description.effects.size(); ++i) {
    const state::EffectDescription& effect = description.effects[i];
    if (!effect.is_felt()) continue;
    if (!goes_on(state.quantities[effect.quantity.index()] / effect.full, state.click_steps[i])) continue;
    for (state::UserState& user : state.users) {
      if (feels(user, effect.body)) add_click(user, state.tick, effect.force_n);
    }
  }
}

}  // namespace mechane::haptics
