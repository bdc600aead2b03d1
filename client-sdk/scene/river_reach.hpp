// The continuation of a river beyond its modelled piece: over the plain, in bends, until haze hides it.
#pragma once

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::scene {

struct RiverReach {
  picture::MeshData mesh_W;  ///< uv: share of its width, metres from its beginning
  float width_m = 0;         ///< at its beginning
};

/// Begins at the border of a water's mesh that lies farthest in `direction_W`. Empty if the mesh has no width there.
[[nodiscard]] RiverReach river_reach(const picture::MeshData& water_M, const Eigen::Affine3f& X_WM,
                                     const Vec3f& direction_W);

}  // namespace mechane::scene
