// A mesh around a shape that is given by its distance function: surface nets (Gibson 1998), smooth and closed.
#pragma once

#include <functional>

#include "client-sdk/display/render_scene.hpp"

namespace mechane::display {

/// The surface where `distance` (negative inside) is 0, within the box, from cells of `cell_m`. The shape must lie inside the box. Normals are
/// the distance's gradient.
[[nodiscard]] MeshData surface_net(const std::function<float(const Vec3f&)>& distance, const Eigen::AlignedBox3f& box,
                                   float cell_m);

}  // namespace mechane::display
