// Cameras and the two eyes. C is the camera's frame: it looks along -z, y up. Stereo uses parallel axes with off-axis
// frusta, so that there is no vertical disparity; what lies at `screen_distance_m` has no disparity at all and seems to
// lie in the screen.
#pragma once

#include <cstdint>

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::picture {

enum class Eye : std::uint8_t { middle, left, right };

struct Camera {
  Vec3 p_WC{0, 1.6, 4};
  Vec3 p_WT = Vec3::Zero();  ///< what it looks at
  Vec3 up_W = Vec3::UnitY();
  double field_of_view_rad = kPi / 4;  ///< vertical
  double least_horizontal_rad = 0;     ///< narrow pictures widen until they show this much across
  /// The picture shows this factor more, below and to the sides, while its upper edge stays: the scene moves up, to
  /// make room for words at the bottom.
  double room_below = 1;
  double near_m = 0.05;
  double far_m = 400;
  double eye_distance_m = 0.064;
  double screen_distance_m = 0;  ///< 0: the distance of p_WT
  double nearest_m = 0;          ///< distance along the axis of the nearest thing that visitors look at; 0: not known
  /// The position of the visitor's head in C, metres: 0 is p_WC. The rectangle in which the frusta meet does not move
  /// with the head, as a window does not.
  Vec3 head_C = Vec3::Zero();
  Vec3 eyes_C = Vec3::UnitX();  ///< from the left eye towards the right one, unit
};

/// What a shader needs to see through one eye. OpenGL clip space, depth -1..1.
struct EyeView {
  Eigen::Matrix4f V_CW = Eigen::Matrix4f::Identity();  ///< world to eye
  Eigen::Matrix4f P = Eigen::Matrix4f::Identity();     ///< eye to clip
  Vec3f p_WE = Vec3f::Zero();
};

/// `aspect` is width over height of one eye's picture.
[[nodiscard]] EyeView eye_view(const Camera& camera, Eye eye, double aspect);

/// The screen, and the distance and eyes of the person in front of it.
struct ScreenSetup {
  double width_m = 0;            ///< of the area that one eye's picture fills; 0: not known
  double viewer_distance_m = 0;  ///< from the eyes to the screen; 0: not known
  double eye_distance_m = 0;     ///< 0: the camera's own

  /// Whether depth can have its true proportions; the picture is then like a window.
  [[nodiscard]] bool known() const { return width_m > 0 && viewer_distance_m > 0; }
};

/// Where a head is before a screen. Frame S: the middle of the screen, x to the right, y up, z towards the visitor.
struct HeadPlace {
  Vec3 p_SV = Vec3::Zero();     ///< between the eyes, metres
  Vec3 eyes_S = Vec3::UnitX();  ///< from the left eye towards the right one, unit
};

/// The largest parallax, as a share of the picture's width. Behind the screen it is 60 mm on a wall of three metres,
/// less than the eyes' distance; in front of it, about the percentage rule of stereoscopic film.
inline constexpr double kMostParallaxBehind = 0.02;
inline constexpr double kMostParallaxBefore = 0.03;

/// The camera for such a screen. The plane of p_WT stays in the screen, at the same size; the eyes are placed as the
/// visitor's are in front of the screen, at the same scale. So depth has its true proportions, and far things have no
/// more parallax than the eyes' distance.
/// `head`: the visitor's tracked position; null: at the screen's viewer distance, in front of its middle.
/// For a screen of unknown size, only the eyes' distance is used, in metres of the world, limited to a comfortable
/// depth; the head is ignored.
[[nodiscard]] Camera for_screen(const Camera& camera, const ScreenSetup& screen, const HeadPlace* head, double aspect);

/// The value of Camera::nearest_m where visitors look at what is in the box; 0 for an empty box.
[[nodiscard]] double nearest_of(const Eigen::AlignedBox3d& box_W, const Camera& camera);

/// A part of what a camera shows, in the plane one metre in front of it: x to the right, y up, from the axis.
struct ViewWindow {
  double x = 0;
  double y = 0;
  double half_height = 0;
};
/// All that a picture of this aspect shows, without Camera::room_below.
[[nodiscard]] ViewWindow whole_window(const Camera& camera, double aspect);
/// Where a box appears in that plane. Empty: the box is empty, or some of it is behind the camera.
[[nodiscard]] Eigen::AlignedBox2d seen_box(const Camera& camera, const Eigen::AlignedBox3d& box_W);
/// The camera in the same place, turned and narrowed to this window of it. What is `depth_m` along the old axis lies in
/// the screen's plane.
[[nodiscard]] Camera narrowed_to(const Camera& camera, const ViewWindow& window, double aspect, double depth_m);

/// A camera that sees the whole box from `from_W` (a direction, from the box's middle towards the camera), with a
/// little room below for captions.
[[nodiscard]] Camera frame_box(const Eigen::AlignedBox3d& box_W, const Vec3& from_W, double field_of_view_rad);

}  // namespace mechane::picture
