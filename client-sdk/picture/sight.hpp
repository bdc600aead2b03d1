// From a pixel into the world and back, through one eye.
#pragma once

#include <optional>
#include <vector>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::picture {

/// One eye's picture and the view that fills it. Pixels are this picture's own, (0, 0) its upper left corner.
struct Sight {
  EyeView view;
  PixelSize picture;
};

struct SightRay {
  Vec3 p_W = Vec3::Zero();
  Vec3 d_W = -Vec3::UnitZ();  ///< unit
};

/// A place of the whole picture, as the eye that it belongs to has it.
struct SeenPlace {
  Sight sight;
  PixelPlace place;
};
/// None where the picture has no pixels, or the place is not a number.
[[nodiscard]] std::optional<SeenPlace> seen_place(const Camera& camera, Stereo stereo, PixelSize picture,
                                                  PixelPlace place);

/// `place` must be finite.
[[nodiscard]] SightRay ray_through(const Sight& sight, PixelPlace place);
/// None for points behind the eye.
[[nodiscard]] std::optional<PixelPlace> pixel_of(const Sight& sight, const Vec3& p_WQ);
/// Distance along the direction of view, metres; below 0: behind the eye.
[[nodiscard]] double depth_of(const Sight& sight, const Vec3& p_WQ);
/// Where a thing is in the picture, pixels; of a large one, what is near the point that it is about. None: it is behind the eye, or beside the
/// picture.
[[nodiscard]] std::optional<PictureBox> box_of(const Sight& sight, const SeenThing& thing);
/// Where RenderScene::seen is in a picture of that size, in their order; for two eyes, boxes around both of a thing's places.
[[nodiscard]] std::vector<PictureBox> boxes_of(const RenderScene& scene, Stereo stereo, PixelSize seen_size);
/// The point of a pixel's ray at this depth.
[[nodiscard]] Vec3 point_at(const Sight& sight, PixelPlace place, double depth_m);

}  // namespace mechane::picture
