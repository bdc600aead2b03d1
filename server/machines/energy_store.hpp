// How a spring hands its energy to what it throws. Machines know of each other only through slots of memory.
#pragma once

#include <string>

#include "server/machines/machine.hpp"

namespace mechane::machines {

/// The spring's side. On release it offers its energy for a short while; the missile takes a share. A view of slots: immutable itself.
class EnergyStore {
 public:
  /// Takes the slots. Without a `release` nothing is ever offered.
  EnergyStore(const Build& build, QuantityId release);

  /// To be called once a tick, before the others. True in the tick in which the release's quantity rises above a half.
  [[nodiscard]] bool released(state::WorldState& state) const noexcept;
  void offer(state::WorldState& state, double energy_j) const noexcept;
  /// Counts down an offer's time; returns whether one is still open.
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

/// The missile's side.
class EnergyOffer {
 public:
  /// Of the machine that the text parameter `parameter` names. Errors: it has no spring, or is written after this one.
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
