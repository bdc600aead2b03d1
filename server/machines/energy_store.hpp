// How a spring hands its energy to what it throws: machines know each other by slots of memory alone.
#pragma once

#include <string>

#include "server/machines/machine.hpp"

namespace mechane::machines {

/// The side of the spring. On release it offers what it holds for a short while; whoever is thrown takes a share. A view of slots:
/// immutable itself.
class EnergyStore {
 public:
  /// Takes the slots. `release` may be none: then nothing is ever offered.
  EnergyStore(const Build& build, QuantityId release);

  /// Once a tick, first. True in the tick in which the release's quantity rises above a half.
  [[nodiscard]] bool released(state::WorldState& state) const noexcept;
  void offer(state::WorldState& state, double energy_j) const noexcept;
  /// Lets an offer grow old; returns whether one is still open.
  bool wait(state::WorldState& state, double dt_s) const noexcept;
  /// What was taken of the last offer, J.
  [[nodiscard]] double taken_j(const state::WorldState& state) const noexcept { return state.memory[taken_j_]; }

 private:
  QuantityId release_;
  std::size_t was_released_;
  std::size_t offered_j_;
  std::size_t left_s_;
  std::size_t taken_j_;
};

/// The side of what is thrown.
class EnergyOffer {
 public:
  /// Of the machine that the text parameter `parameter` names. Errors: it is not a spring, or stands below in the description.
  [[nodiscard]] static Expected<EnergyOffer> find(const Build& build, std::string_view parameter);

  /// What the spring offers in this tick, J; 0: nothing.
  [[nodiscard]] double open_j(const state::WorldState& state) const noexcept { return state.memory[offered_j_]; }
  /// Takes `energy_j` of it and closes it.
  void take(state::WorldState& state, double energy_j) const noexcept;

 private:
  std::size_t offered_j_ = 0;
  std::size_t taken_j_ = 0;
};

}  // namespace mechane::machines
