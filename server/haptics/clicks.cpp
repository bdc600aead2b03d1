#include "server/haptics/clicks.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::haptics {
namespace {

bool feels(const state::UserState& user, BodyId body) {
  return user.present && (user.holds(body) || user.touches(body));
}

/// Whether a value is on another step than before; if so, `step` becomes the new one. A value that trembles at a step's lower end stays on
/// it. The first value only sets the step.
bool enters_new_step(double value, double& step) {
  constexpr double kHysteresis = 0.2;
  constexpr double kReached = 1e-6;  // so close to a step counts as on it, because of rounding
  if (!std::isfinite(value)) return false;
  const bool first = std::isnan(step);
  if (!first && value >= step - kHysteresis && value + kReached < step + 1) return false;
  step = std::floor(value + kReached);
  return !first;
}

}  // namespace

void add_click(state::UserState& user, std::uint64_t tick, double strength_n) noexcept {
  constexpr double kFelt_n = 0.05;
  constexpr std::uint64_t kApartTicks = 20;
  strength_n = std::min(strength_n, hand::kMaxClick_n);
  const bool masked =
      user.clicks.count > 0 && tick - user.click_tick < kApartTicks && strength_n <= user.clicks.strength_n;
  if (strength_n < kFelt_n || masked) return;
  user.click_tick = tick;
  user.clicks = {user.clicks.count + 1, strength_n};
}

void find_clicks(const state::WorldDescription& description, state::WorldState& state) noexcept {
  for (std::size_t i = 0; i < description.effects.size(); ++i) {
    const state::EffectDescription& effect = description.effects[i];
    if (!effect.felt) continue;
    if (!enters_new_step(state.quantities[effect.quantity.index()] / effect.full, state.click_steps[i])) continue;
    for (state::UserState& user : state.users) {
      if (feels(user, effect.body)) add_click(user, state.tick, effect.force_n);
    }
  }
}

}  // namespace mechane::haptics
