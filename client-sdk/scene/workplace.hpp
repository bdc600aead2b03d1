// Where hands work in a step: what the view shows large. Pure.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/picture/render_scene.hpp"
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

/// What is seen of that: of each hand what it holds and where that belongs, or what it can take; without hands, all that can be taken and where
/// it belongs. What is held, with its goals, comes first.
[[nodiscard]] std::vector<picture::SeenThing> things_at_work(std::span<const WorkingHand> hands,
                                                             std::span<const client::Affordance> affordances,
                                                             std::span<const std::string> enabled,
                                                             const StandingObjects& standing);

}  // namespace mechane::scene
