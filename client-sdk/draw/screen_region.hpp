// Rectangles of a picture that contain what is seen of things and of their shadows. Pure.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/picture/pixels.hpp"
#include "server/base/math.hpp"

namespace mechane::draw {

/// Pixels from (left, bottom) up to, but without, (right, top); rows are counted from the bottom, as OpenGL does.
struct ScreenRegion {
  int left = 0;
  int bottom = 0;
  int right = 0;
  int top = 0;

  [[nodiscard]] bool empty() const { return right <= left || top <= bottom; }
  friend bool operator==(const ScreenRegion&, const ScreenRegion&) = default;
};

[[nodiscard]] ScreenRegion whole_region(picture::PixelSize size);

/// Contains all pixels of the convex hull of these points, with a pixel more on each side; the whole picture where it
/// reaches behind the eye. PV: from W to clip space.
[[nodiscard]] ScreenRegion region_of(const Eigen::Matrix4f& PV, std::span<const Vec3f> points_W,
                                     picture::PixelSize size);

/// The corners of a box and of its shadow down to the height floor_m. to_sun_W: unit. None where the sun stands so low
/// that the shadow has no useful bound.
[[nodiscard]] std::vector<Vec3f> corners_with_shadow(const Eigen::AlignedBox3f& box_W, const Vec3f& to_sun_W,
                                                     float floor_m);

/// As few regions, none of which overlap, that contain all of these.
[[nodiscard]] std::vector<ScreenRegion> merged(std::vector<ScreenRegion> regions);

/// Regions, none of which overlap, that contain all of these and little else: they consist of square cells. These must
/// lie in the picture.
[[nodiscard]] std::vector<ScreenRegion> covered(std::span<const ScreenRegion> regions, picture::PixelSize size);

/// From the picture's clip space to that of the region alone.
[[nodiscard]] Eigen::Matrix4f crop_to(const ScreenRegion& region, picture::PixelSize size);

}  // namespace mechane::draw
