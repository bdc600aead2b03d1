// Where in a world a visitor's hand has something to do.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "client-sdk/studio/view/stillness.hpp"

namespace mechane::studio {

/// A body that a hand can take, turn or slide, or put somewhere.
struct WorkableBody {
  std::string def;
  Eigen::AlignedBox3d box_W;  ///< around its surface
};

/// Those that are seen, at their poses, in the order of the description. Pure; it takes time for each sample of their surfaces.
[[nodiscard]] std::vector<WorkableBody> workable_bodies(const state::WorldDescription& world, const SeenWorld& seen);

}  // namespace mechane::studio
