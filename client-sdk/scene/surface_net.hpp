// A mesh around a shape that is given by its distance function: surface nets (Gibson 1998), smooth and closed.
#pragma once

#include <functional>

#include "client-sdk/picture/scene_assets.hpp"

namespace mechane::scene {

/// The surface where `distance` (negative inside) is 0, within the box, from cells of `cell_m`. The shape must lie inside the box. Normals are
/// the distance's gradient.
[[nodiscard]] picture::MeshData surface_net(const std::function<float(const Vec3f&)>& distance,
                                            const Eigen::AlignedBox3f& box, float cell_m);

}  // namespace mechane::scene
