// Cameras and the two eyes. C is the camera's frame: it looks along -z, y up. Stereo uses parallel axes with off-axis frusta, so that
// there is no vertical disparity; what lies at `screen_distance_m` has none at all and seems to lie in the screen.
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
  /// So many times as much is shown, below and to the sides: the upper edge stays, and what was seen goes up and in, for words that cover
  /// what is below.
  double room_below = 1;
  double near_m = 0.05;
  double far_m = 400;
  double eye_distance_m = 0.064;
  double screen_distance_m = 0;  ///< 0: the distance of p_WT
  double nearest_m = 0;          ///< of what visitors look at, along the axis; 0: not known
  /// Where the visitor's head is, in C, metres: 0 is p_WC. The rectangle in which the frusta meet stays where it is, as a window does that one
  /// looks through from elsewhere.
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

/// The screen and who stands before it.
struct ScreenSetup {
  double width_m = 0;            ///< of what one eye's picture fills; 0: not known
  double viewer_distance_m = 0;  ///< from the eyes to the screen; 0: not known
  double eye_distance_m = 0;     ///< 0: the camera's own

  /// Depth can have its true proportions: the picture is a window, which stays where it is.
  [[nodiscard]] bool known() const { return width_m > 0 && viewer_distance_m > 0; }
};

/// Where a head is before a screen. Frame S: the middle of the screen, x to the right, y up, z towards the visitor.
struct HeadPlace {
  Vec3 p_SV = Vec3::Zero();     ///< between the eyes, metres
  Vec3 eyes_S = Vec3::UnitX();  ///< from the left eye towards the right one, unit
};

/// Of the picture's width, how far apart an eye's picture of a thing may lie from the other's: behind the screen 60 mm on a wall of three
/// metres, less than eyes are apart; before it about the percentage rule of stereoscopic film.
inline constexpr double kMostParallaxBehind = 0.02;
inline constexpr double kMostParallaxBefore = 0.03;

/// The camera for such a screen. What lay in the plane of p_WT stays in the screen, as large as it was; the eyes stand before it as the visitor
/// stands before the screen, all at one scale: depth has its true proportions, and what is far away has no more parallax than eyes are apart.
/// `head`: where the visitor stands instead; null: at the screen's viewer distance, before its middle.
/// For a screen that is not known only the eyes' distance is taken over, in metres of the world, and no head: as much of it as keeps the depth
/// comfortable.
[[nodiscard]] Camera for_screen(const Camera& camera, const ScreenSetup& screen, const HeadPlace* head, double aspect);

/// For Camera::nearest_m, where visitors look at what is in the box; 0 of an empty one.
[[nodiscard]] double nearest_of(const Eigen::AlignedBox3d& box_W, const Camera& camera);

/// A camera that sees the whole box from `from_W` (a direction, from the box's middle towards the camera), a little room left below for captions.
[[nodiscard]] Camera frame_box(const Eigen::AlignedBox3d& box_W, const Vec3& from_W, double field_of_view_rad);

}  // namespace mechane::picture
