// Why a hand that closed on a body does not hold it, as far as the scenario and the world's status show.
#pragma once

#include <span>
#include <string>

#include "server/state/description.hpp"

namespace mechane::visitor {

/// An attempt to grasp that ended with an empty hand.
struct FailedGrasp {
  BodyId body;           ///< the body to grasp
  double nearest_m = 0;  ///< least distance from the hand's middle to the grip
  bool touched = false;  ///< the hand felt something while it was closed
};

/// What is wrong, and what to do: "SHAFT is not graspable in step 'turn'; ...". `enabled_agents` is from the world's
/// status.
[[nodiscard]] std::string why_not_grasped(const FailedGrasp& grasp, const state::WorldDescription& world, StepId step,
                                          std::span<const std::string> enabled_agents);

}  // namespace mechane::visitor
