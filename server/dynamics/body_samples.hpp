// Fewer surface samples for bodies than for hands.
#pragma once

#include "server/collision/object.hpp"

namespace mechane::dynamics {

/// The same object with the fewer samples that bodies need for each other: a hand feels the surface between two samples, but a body
/// rests on four points. Each part keeps its outermost samples, corners and edges first, then those at least a quarter of its middle
/// extent away from these, 12 mm at most; a slender part keeps more. Two edges that cross between samples sink in by up to half of
/// that distance. Not in the tick.
[[nodiscard]] collision::Object with_fewer_samples(const collision::Object& object);

}  // namespace mechane::dynamics
