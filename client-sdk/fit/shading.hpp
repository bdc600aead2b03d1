// Light on a depth buffer, so that a picture of triangles looks like a solid thing.
#pragma once

#include <vector>

#include "client-sdk/fit/raster.hpp"

namespace mechane::fit {

/// Brightness of each pixel, about 0.25 to 1: a lamp at the viewer's upper left and light from the sky (Lambert),
/// darker hollows, and a dark line along the object's outlines.
[[nodiscard]] std::vector<float> light_of(const DepthBuffer& buffer, const geometry::Mesh& mesh, const View& view);

}  // namespace mechane::fit
