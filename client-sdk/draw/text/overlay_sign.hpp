// The signs beside a notice, drawn with the overlay's rounded boxes. Used by the files overlay_*.cpp only.
#pragma once

#include "client-sdk/draw/text/overlay_page.hpp"

namespace mechane::draw {

/// Adds the sign on its tile, which fills the square box.
void add_sign(Page& page, picture::OverlayNotice::Sign sign, const Box& tile);

}  // namespace mechane::draw
