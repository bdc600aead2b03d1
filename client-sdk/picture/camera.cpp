#include "client-sdk/picture/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "client-sdk/picture/box_corners.hpp"

namespace mechane::picture {
namespace {

Eigen::Matrix4d frustum(double left, double right, double bottom, double top, double near_m, double far_m) {
  Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  P(0, 0) = 2 * near_m / (right - left);
  P(1, 1) = 2 * near_m / (top - bottom);
  P(0, 2) = (right + left) / (right - left);
  P(1, 2) = (top + bottom) / (top - bottom);
  P(2, 2) = -(far_m + near_m) / (far_m - near_m);
  P(2, 3) = -2 * far_m * near_m / (far_m - near_m);
  P(3, 2) = -1;
  return P;
}

/// Rows are the camera's axes in W: right, up, back.
Mat3 axes_of(const Camera& camera) {
  const Vec3 back = (camera.p_WC - camera.p_WT).normalized();
  Vec3 right = camera.up_W.cross(back);
  // Straight up or down: any horizontal axis will do.
  if (right.norm() < 1e-9) right = Vec3::UnitX();
  right.normalize();
  Mat3 R_CW;
  R_CW.row(0) = right;
  R_CW.row(1) = back.cross(right);
  R_CW.row(2) = back;
  return R_CW;
}

/// Nobody works nearer to the eyes than this, whatever a box says.
constexpr double kArm_m = 0.3;

/// Half the picture's height at one metre, and the distance of the plane without parallax.
struct Window {
  double half_tan = 0;
  double distance_m = 0;
};

Window window_of(const Camera& camera, double aspect) {
  return {std::max(std::tan(camera.field_of_view_rad / 2),
                   std::tan(std::min(camera.least_horizontal_rad, 3.0) / 2) / aspect),
          camera.screen_distance_m > 0 ? camera.screen_distance_m : (camera.p_WT - camera.p_WC).norm()};
}

/// Limits the eyes' distance to what the depth budget allows, for infinitely far things and for the nearest.
double comfortable_eyes_m(const Camera& camera, double wanted_m, double aspect) {
  const auto [half_tan, distance_m] = window_of(camera, aspect);
  const double width_m = 2 * half_tan * distance_m * aspect;
  double most_m = kMostParallaxBehind * width_m;
  // With the screen at distance d, a thing at distance n has a parallax of d / n - 1 times the eyes' distance.
  if (camera.nearest_m > 0 && camera.nearest_m < distance_m)
    most_m = std::min(most_m, kMostParallaxBefore * width_m * camera.nearest_m / (distance_m - camera.nearest_m));
  return std::min(wanted_m, most_m);
}

}  // namespace

EyeView eye_view(const Camera& camera, Eye eye, double aspect) {
  const Mat3 R_CW = axes_of(camera);
  const double side = eye == Eye::left ? -0.5 : eye == Eye::right ? 0.5 : 0.0;
  const Vec3 p_CE = camera.head_C + side * camera.eye_distance_m * camera.eyes_C;
  const Vec3 p_WE = camera.p_WC + R_CW.transpose() * p_CE;

  const auto [half_tan, distance] = window_of(camera, aspect);
  // All frusta meet in the same rectangle, at the screen's distance from the camera's place without a head.
  const double half_height = camera.room_below * half_tan * distance;
  const double middle_y =
      half_tan * distance - half_height;  // the upper edge stays where it would be without room_below
  const double half_width = half_height * aspect;
  const double nearer = camera.near_m / std::max(distance + p_CE.z(), camera.near_m);

  EyeView view;
  view.V_CW.topLeftCorner<3, 3>() = R_CW.cast<float>();
  view.V_CW.topRightCorner<3, 1>() = (-R_CW * p_WE).cast<float>();
  view.P = frustum(nearer * (-half_width - p_CE.x()), nearer * (half_width - p_CE.x()),
                   nearer * (middle_y - half_height - p_CE.y()), nearer * (middle_y + half_height - p_CE.y()),
                   camera.near_m, camera.far_m)
               .cast<float>();
  view.p_WE = p_WE.cast<float>();
  return view;
}

Camera for_screen(const Camera& camera, const ScreenSetup& screen, const HeadPlace* head, double aspect) {
  Camera out = camera;
  const double eyes_m = screen.eye_distance_m > 0 ? screen.eye_distance_m : camera.eye_distance_m;
  out.eye_distance_m = screen.known() ? eyes_m : comfortable_eyes_m(camera, eyes_m, aspect);
  if (!screen.known()) return out;
  const auto [half_tan, distance_m] = window_of(camera, aspect);
  const double scale = 2 * half_tan * distance_m * aspect / screen.width_m;
  const Vec3 back = (camera.p_WC - camera.p_WT).normalized();
  out.p_WT = camera.p_WC - distance_m * back;
  out.screen_distance_m = scale * screen.viewer_distance_m;
  out.p_WC = out.p_WT + out.screen_distance_m * back;
  out.field_of_view_rad = 2 * std::atan(half_tan * distance_m / out.screen_distance_m);
  out.least_horizontal_rad = 0;
  out.eye_distance_m = scale * eyes_m;
  if (head != nullptr) {  // S and C have parallel axes
    out.head_C = scale * (head->p_SV - Vec3(0, 0, screen.viewer_distance_m));
    out.eyes_C = head->eyes_S;
  }
  return out;
}

double nearest_of(const Eigen::AlignedBox3d& box_W, const Camera& camera) {
  if (box_W.isEmpty()) return 0;
  const Vec3 ahead_W = (camera.p_WT - camera.p_WC).normalized();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Vec3& p_W : corners_of(box_W))
    nearest_m = std::min(nearest_m, ahead_W.dot(p_W - camera.p_WC));
  return std::max(nearest_m, kArm_m);
}

ViewWindow whole_window(const Camera& camera, double aspect) {
  return {0, 0, window_of(camera, aspect).half_tan};
}

Eigen::AlignedBox2d seen_box(const Camera& camera, const Eigen::AlignedBox3d& box_W) {
  Eigen::AlignedBox2d seen;
  if (box_W.isEmpty()) return seen;
  const Mat3 R_CW = axes_of(camera);
  for (const Vec3& p_W : corners_of(box_W)) {
    const Vec3 p_C = R_CW * (p_W - camera.p_WC);
    if (-p_C.z() < camera.near_m) return {};
    seen.extend(Eigen::Vector2d(p_C.head<2>() / -p_C.z()));
  }
  return seen;
}

Camera narrowed_to(const Camera& camera, const ViewWindow& window, double aspect, double depth_m) {
  const Vec3 middle_C(window.x, window.y, -1);
  const double half_tan = window.half_height / middle_C.norm();
  Camera out = camera;
  out.p_WT = camera.p_WC + depth_m * axes_of(camera).transpose() * middle_C;
  out.field_of_view_rad = 2 * std::atan(half_tan);
  // As much less across as the window is narrower.
  const double share = window.half_height / whole_window(camera, aspect).half_height;
  out.least_horizontal_rad = 2 * std::atan(share * std::tan(camera.least_horizontal_rad / 2) / middle_C.norm());
  out.screen_distance_m = 0;
  return out;
}

Camera frame_box(const Eigen::AlignedBox3d& box_W, const Vec3& from_W, double field_of_view_rad) {
  Camera camera;
  camera.field_of_view_rad = field_of_view_rad;
  const Vec3 middle = box_W.isEmpty() ? Vec3::Zero() : Vec3(box_W.center());
  const Vec3 extent = box_W.isEmpty() ? Vec3::Ones() : Vec3(box_W.sizes());
  camera.p_WT = middle;
  camera.p_WC = middle + from_W.normalized();
  const Mat3 R_CW = axes_of(camera);

  // Looking a little below the middle leaves room for the caption: by this share of the picture's half height.
  constexpr double kDrop = 0.12;
  constexpr double kMost = 0.98;
  constexpr double kMostAcross = 1.45;
  const double t = std::tan(field_of_view_rad / 2);
  const double tan_across = kMostAcross * t;
  // The least distance at which every corner is in the picture.
  double distance = 0.3;
  for (const Vec3& p : corners_of(Eigen::AlignedBox3d(-extent / 2, extent / 2))) {
    const Vec3 p_C = R_CW * p;
    distance = std::max({distance, (std::abs(p_C.y()) / t + kMost * p_C.z()) / (kMost - kDrop),
                         p_C.z() + std::abs(p_C.x()) / (kMost * tan_across)});
  }
  const Vec3 up = R_CW.row(1);
  camera.p_WT = middle - kDrop * distance * t * up;
  camera.p_WC = camera.p_WT + distance * from_W.normalized();
  camera.least_horizontal_rad = 2 * std::atan(tan_across);
  camera.nearest_m = nearest_of(box_W, camera);
  return camera;
}

}  // namespace mechane::picture
