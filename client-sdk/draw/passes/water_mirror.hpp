// Chooses the water that mirrors its surroundings, and computes the mirrored eye.
#pragma once

#include <optional>

#include "client-sdk/draw/gpu_assets.hpp"
#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

/// Height (y in W) of a water's surface; none if it is not level.
[[nodiscard]] std::optional<float> level_m(const picture::WaterInstance& water, const GpuAssets& assets);

/// Whether both heights are practically the same.
[[nodiscard]] bool is_same_level(float a_m, float b_m);

/// The height of the water that fills most of the eye's picture, estimated from boxes; none if no level water is
/// visible below the eye.
[[nodiscard]] std::optional<float> mirror_level_m(const picture::RenderScene& scene, const GpuAssets& assets,
                                                  const picture::EyeView& view);

/// The mirrored eye: its picture at a place shows what the real eye sees mirrored there. Triangles change their
/// orientation.
[[nodiscard]] picture::EyeView mirrored(const picture::EyeView& view, float level_m);

}  // namespace mechane::draw
