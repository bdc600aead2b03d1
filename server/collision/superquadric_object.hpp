// An object that is one superquadric: a segment of a hand, a tip of a stylus.
#pragma once

#include "server/collision/object.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::collision {

/// One part that is the superquadric itself, its frame Q being the object's frame. `shape` must be valid, the spacing positive.
[[nodiscard]] Object make_superquadric_object(const geometry::Superquadric& shape, double sample_spacing_m);

/// It in a mirror at z = 0. For an object whose parts are what they are in that mirror, as superquadrics without deformation whose frame is
/// the object's: only its surface samples change.
[[nodiscard]] Object mirrored(Object object);

}  // namespace mechane::collision
