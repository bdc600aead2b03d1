// Makes the parts of a display from its options.
#pragma once

#include <memory>

#include "client-sdk/display/attract_loop.hpp"
#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/kiosk_desk.hpp"

namespace mechane::display {

[[nodiscard]] client::DisplaySettings settings_at_start(const DisplayOptions& options);
[[nodiscard]] DisplayIdentity identity_of(const DisplayOptions& options, const draw::GlContext& context);

/// The address must be valid. `catalogue` and `worker` may be null.
[[nodiscard]] scene::AssetSource open_assets(const DisplayOptions& options, const content::Catalogue* catalogue,
                                             Worker* worker);

/// Null where none is requested. Errors: those of FrameRecording.
[[nodiscard]] Expected<std::unique_ptr<AttractLoop>> open_attract(const DisplayOptions& options,
                                                                  const content::Catalogue* catalogue, Worker* worker);

}  // namespace mechane::display
