// The distance map of a part as a picture (the paper's Figure 4): how far the felt surface lies under the superquadric.
#pragma once

#include <cstddef>

#include "client-sdk/fit/image.hpp"
#include "server/collision/object.hpp"

namespace mechane::fit {

/// Departs from the paper's (eta, omega) grid, which crowds at the poles and gapes along the edges of a boxy part: here
/// the superquadric is unrolled like a box around its z axis, +x +y -x -y from left to right, +z above +x, -z below it.
struct MapPicture {
  Image image;
  double deepest_mm = 0;     ///< at the dark end of the scale
  double no_hit_share = 0;   ///< share of places where the ray does not meet the part; shown dotted
  double covered_share = 0;  ///< share of places where the superquadric's surface lies inside the part; shown grey
};

/// Rays go inwards along the superquadric's normal, and query the part's map as a contact would, whatever its
/// representation. Their steps are 1/64 of the part's diagonal; thinner features may be missed. `texels` along an edge
/// of the box.
[[nodiscard]] MapPicture draw_map(const collision::Object& object, std::size_t part, int texels);

}  // namespace mechane::fit
