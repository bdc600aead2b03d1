// Which plane parts a piece best: one that the eye would take for the border of two parts.
#pragma once

#include <optional>
#include <span>

#include "server/geometry/pieces/concave_places.hpp"
#include "server/geometry/pieces/piece_region.hpp"

namespace mechane::geometry {

/// Tries planes at and between concave places of the surface (minima rule, short cuts) and across likely axes, and scores each: how
/// much of the concavity it parts, how large the cut is beside what it cuts off (short cuts, protrusion; Hoffman & Singh 1997), and
/// whether a child is then within the bound. Empty if no plane parts the region into two of sensible size.
[[nodiscard]] std::optional<HalfSpace> best_cut(const DecomposeModel& model, const PieceRegion& region,
                                                std::span<const ConcavePlace> places);

}  // namespace mechane::geometry
