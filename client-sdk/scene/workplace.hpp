// Where hands work in a step: what the view shows large. Pure.
#pragma once

#include <functional>
#include <span>
#include <string>

#include <Eigen/Dense>

#include <mechane/client/types.hpp>

namespace mechane::scene {

struct WorkingHand {
  Eigen::AlignedBox3d box_W;  ///< as it is drawn
  bool holding = false;
};

/// An object as it stands now. B is its frame.
struct StandingObject {
  Pose X_WB;
  Eigen::AlignedBox3d box_B;  ///< of its model; empty: nothing is drawn
};
using StandingObjects = std::function<StandingObject(std::uint32_t object)>;

/// With hands: contains them, the nearest place of each object that a free hand can take, and where an object belongs
/// that a hand holds, or the arc on which it turns it. Without hands: all that can be taken, and where it belongs.
/// Empty: nothing can be taken in this step. `enabled` has the step's enabled agents.
[[nodiscard]] Eigen::AlignedBox3d workplace(std::span<const WorkingHand> hands,
                                            std::span<const client::Affordance> affordances,
                                            std::span<const std::string> enabled, const StandingObjects& standing);

}  // namespace mechane::scene
