// A pose in seven slots of memory. Inside this room only.
#pragma once

#include <array>

#include "server/agents/agent.hpp"

namespace mechane::agents {

class PoseSlots {
 public:
  PoseSlots(const Build& build, const std::string& name) {
    for (std::size_t i = 0; i < at_.size(); ++i)
      at_[i] = build.slot(name + "." + std::to_string(i), i == 6 ? 1 : 0);
  }
  [[nodiscard]] Pose read(const state::WorldState& state) const noexcept {
    const auto& m = state.memory;
    return {Vec3(m[at_[0]], m[at_[1]], m[at_[2]]), Quat(m[at_[6]], m[at_[3]], m[at_[4]], m[at_[5]])};
  }
  void write(state::WorldState& state, const Pose& X) const noexcept {
    for (int i = 0; i < 3; ++i)
      state.memory[at_[static_cast<std::size_t>(i)]] = X.p[i];
    for (int i = 0; i < 4; ++i)
      state.memory[at_[3 + static_cast<std::size_t>(i)]] = X.R.coeffs()[i];
  }

 private:
  std::array<std::size_t, 7> at_{};
};

}  // namespace mechane::agents
