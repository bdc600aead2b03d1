// Joins pieces that were cut apart needlessly: the wedges of a gear's hub, between cuts that separated its teeth.
#pragma once

#include <vector>

#include "server/geometry/pieces/piece_region.hpp"

namespace mechane::geometry {

/// Joins pairs, neighbours in the list first, whose union is again the solid within a convex cell, holds nothing of other pieces and
/// is within the bound. The pieces must be the whole solid, and measured.
void merge_pieces(const DecomposeModel& model, std::vector<PieceRegion>& pieces);

}  // namespace mechane::geometry
