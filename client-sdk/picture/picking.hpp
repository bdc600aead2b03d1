// What a person clicks on: the object under a pixel. Nothing here knows OpenGL: rays meet the triangles that are drawn.
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

/// Through a pixel of one eye's picture; none: sky or ground. As slow as object_at().
[[nodiscard]] std::optional<Picked> picked_at(const RenderScene& scene, const SceneAssets& assets, const Sight& sight,
                                              PixelPlace place);

/// The index of the object (Instance::object) that is seen there: the nearest of all, of scenery too. None: scenery, sky or ground.
/// `pictured` is the whole picture's size. Takes as long as all triangles take once; for clicks, not for frames.
[[nodiscard]] std::optional<std::uint32_t> object_at(const RenderScene& scene, const SceneAssets& assets,
                                                     PixelPlace place, Stereo stereo, PixelSize pictured);

}  // namespace mechane::picture
