// Finds the object under a pixel, for clicks. Without OpenGL: rays are intersected with the triangles that are drawn.
#pragma once

#include <cstdint>
#include <optional>

#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/sight.hpp"

namespace mechane::picture {

/// What a pixel meets.
struct Picked {
  std::optional<std::uint32_t> object;  ///< none: scenery
  Vec3 p_WT = Vec3::Zero();             ///< of its surface
};

/// What lies under a pixel of one eye's picture; none: sky or ground. As slow as object_at().
[[nodiscard]] std::optional<Picked> picked_at(const RenderScene& scene, const SceneAssets& assets, const Sight& sight,
                                              PixelPlace place);

/// The index (Instance::object) of the object at a pixel. None where scenery, sky or ground is seen there. `pictured`
/// is the whole picture's size. Tests every triangle once: for clicks, not for each frame.
[[nodiscard]] std::optional<std::uint32_t> object_at(const RenderScene& scene, const SceneAssets& assets,
                                                     PixelPlace place, Stereo stereo, PixelSize pictured);

}  // namespace mechane::picture
