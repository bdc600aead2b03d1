// An object that is one superquadric: a segment of a hand, a tip of a stylus.
#pragma once

#include "server/collision/object.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::collision {

/// One part that is the superquadric itself, its frame Q being the object's frame. `shape` must be valid, the spacing positive.
[[nodiscard]] Object make_superquadric_object(const geometry::Superquadric& shape, double sample_spacing_m);

}  // namespace mechane::collision
