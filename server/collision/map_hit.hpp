// The answer of a part's map about a point.
#pragma once

#include "server/base/math.hpp"

namespace mechane::collision {

/// All in the part's frame Q. Without `hit` the other fields mean nothing.
struct MapHit {
  bool hit = false;
  float depth_m = 0;           ///< > 0: distance to the surface along the normal
  float m = 0;                 ///< how central the point lies in this part: 0 (central, or exact) to 1
  Vec3f n_Q = Vec3f::UnitZ();  ///< outward unit normal of the surface
  Vec3f p_QS = Vec3f::Zero();  ///< the surface point: the query point moved by depth_m along n_Q
};

}  // namespace mechane::collision
