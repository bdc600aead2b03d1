// Which water mirrors what stands about it, and from where its mirror image is seen.
#pragma once

#include <optional>

#include "client-sdk/draw/gpu_assets.hpp"
#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

/// y in W of a water's surface; none where it is not level.
[[nodiscard]] std::optional<float> level_m(const picture::WaterInstance& water, const GpuAssets& assets);

/// Whether both lie in one plane, as far as an eye can see.
[[nodiscard]] bool is_same_level(float a_m, float b_m);

/// The level of the water that fills most of what the eye sees, by its boxes; none where no level water is in sight below the eye.
[[nodiscard]] std::optional<float> mirror_level_m(const picture::RenderScene& scene, const GpuAssets& assets,
                                                  const picture::EyeView& view);

/// The eye under the mirror: what it sees at a place of the picture is what the eye sees mirrored there. Turns clockwise what was
/// counter-clockwise.
[[nodiscard]] picture::EyeView mirrored(const picture::EyeView& view, float level_m);

}  // namespace mechane::draw
