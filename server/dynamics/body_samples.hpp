// Fewer surface samples for bodies than for hands.
#pragma once

#include "server/collision/object.hpp"

namespace mechane::dynamics {

/// The same object with the samples that bodies need on each other: a hand feels the surface between two samples, a body rests on
/// four points. Each part keeps its outermost samples, corners and edges first, then what lies at least a quarter of its middle
/// extent from those, 12 mm at most; a slender part keeps more. Two edges that cross between samples sink in by up to half of that.
/// Not in the tick.
[[nodiscard]] collision::Object with_fewer_samples(const collision::Object& object);

}  // namespace mechane::dynamics
