// A rope as a round tube, made anew for each frame from where its points are.
#pragma once

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// Adds the tube to `into`, in W: corners rounded, frames carried along without twist, flat ends. Tangents run along the rope; uv: share of
/// the way about it, length from the first point in radii. Points that repeat or are not numbers are passed over;
/// fewer than two others: nothing.
void append_rope(const picture::RenderRope& rope, picture::MeshData& into);

}  // namespace mechane::draw
