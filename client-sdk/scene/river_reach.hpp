// A river beyond the piece of it that was modelled: on over the plain, in bends, until haze has it.
#pragma once

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::scene {

struct RiverReach {
  picture::MeshData mesh_W;  ///< uv: share of the way across, metres from where it begins
  float width_m = 0;         ///< where it begins
};

/// From the border of a water's mesh that lies farthest along `way_W`. Nothing where the mesh has no width there.
[[nodiscard]] RiverReach river_reach(const picture::MeshData& water_M, const Eigen::Affine3f& X_WM, const Vec3f& way_W);

}  // namespace mechane::scene
