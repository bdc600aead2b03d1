#include "client-sdk/picture/sight.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::picture {

std::optional<SeenPlace> seen_place(const Camera& camera, Stereo stereo, PixelSize picture, PixelPlace place) {
  const PixelSize eye = seen_size(stereo, picture);
  // Pixels so far from any screen would overflow in float.
  constexpr double kAbsurd = 1e6;
  if (eye.width < 2 || eye.height < 2 || !(std::abs(place.x) < kAbsurd) || !(std::abs(place.y) < kAbsurd)) return {};
  const EyePlace seen = eye_at(stereo, picture, place);
  return SeenPlace{{eye_view(camera, seen.eye, seen.aspect), eye},
                   {(1 + seen.x) / 2 * eye.width, (1 - seen.y) / 2 * eye.height}};
}

SightRay ray_through(const Sight& sight, PixelPlace place) {
  const double x = 2 * place.x / sight.picture.width - 1;
  const double y = 1 - 2 * place.y / sight.picture.height;
  const Eigen::Matrix4d P = sight.view.P.cast<double>();
  const Vec3 d_C((x + P(0, 2)) / P(0, 0), (y + P(1, 2)) / P(1, 1), -1);
  const Mat3 R_CW = sight.view.V_CW.topLeftCorner<3, 3>().cast<double>();
  return {sight.view.p_WE.cast<double>(), (R_CW.transpose() * d_C).normalized()};
}

std::optional<PixelPlace> pixel_of(const Sight& sight, const Vec3& p_WQ) {
  if (!(depth_of(sight, p_WQ) > 1e-3)) return {};
  const Eigen::Vector4d clip = (sight.view.P * sight.view.V_CW).cast<double>() * p_WQ.homogeneous();
  const Eigen::Vector2d at = clip.head<2>() / clip.w();
  return PixelPlace{(1 + at.x()) / 2 * sight.picture.width, (1 - at.y()) / 2 * sight.picture.height};
}

double depth_of(const Sight& sight, const Vec3& p_WQ) {
  return -sight.view.V_CW.row(2).cast<double>().dot(p_WQ.homogeneous());
}

Vec3 point_at(const Sight& sight, PixelPlace place, double depth_m) {
  const SightRay ray = ray_through(sight, place);
  const Vec3 ahead_W = -sight.view.V_CW.block<1, 3>(2, 0).cast<double>().transpose().normalized();
  // A frustum opens by less than half a turn, so a ray through a pixel of the picture always goes forward.
  return ray.p_W + ray.d_W * (depth_m / std::max(ray.d_W.dot(ahead_W), 1e-3));
}

}  // namespace mechane::picture
