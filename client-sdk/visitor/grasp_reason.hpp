// Why a hand that closed on a body does not hold it, as far as one can tell who sees the exhibit and has its description.
#pragma once

#include <span>
#include <string>

#include "server/state/description.hpp"

namespace mechane::visitor {

/// A hand that closed, and held nothing at the end.
struct FailedGrasp {
  BodyId body;           ///< that it was to hold
  double nearest_m = 0;  ///< from its middle to the grip, at the best moment
  bool touched = false;  ///< it felt something while it was closed
};

/// What is wrong, and what to do: "SHAFT may not be grasped in step 'turn'; ...". `enabled_agents` are those of the world's status.
[[nodiscard]] std::string why_not_grasped(const FailedGrasp& grasp, const state::WorldDescription& world, StepId step,
                                          std::span<const std::string> enabled_agents);

}  // namespace mechane::visitor
