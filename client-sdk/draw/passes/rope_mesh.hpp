// A rope as a round tube, made for each frame from its points.
#pragma once

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// Adds the tube to `into`, in W: corners rounded, frames carried along without twist, flat ends. Tangents run along
/// the rope; uv: share of its circumference, length from the first point in radii. Points that repeat or are not
/// numbers are skipped; nothing is added for fewer than two others.
void append_rope(const picture::RenderRope& rope, picture::MeshData& into);

}  // namespace mechane::draw
