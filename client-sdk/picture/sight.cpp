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

std::optional<PictureBox> box_of(const Sight& sight, const SeenThing& thing) {
  /// How much of a large thing is kept clear, as a share of the picture's height.
  constexpr float kNear = 0.14F;
  const auto height = static_cast<float>(sight.picture.height), width = static_cast<float>(sight.picture.width);
  Eigen::AlignedBox2f box;
  for (const Vec3f& p_W : thing.points_W) {
    const auto pixel = pixel_of(sight, p_W.cast<double>());
    if (!pixel) continue;
    // The frustum's half height at this depth is 1 / P(1, 1) of it.
    const auto depth_m = static_cast<float>(depth_of(sight, p_W.cast<double>()));
    const float around = thing.around_m * sight.view.P(1, 1) / depth_m * height / 2;
    const Eigen::Vector2f at(static_cast<float>(pixel->x), static_cast<float>(pixel->y));
    box.extend(Eigen::AlignedBox2f(at - Eigen::Vector2f::Constant(around), at + Eigen::Vector2f::Constant(around)));
  }
  if (thing.about_W && !box.isEmpty()) {
    const auto pixel = pixel_of(sight, thing.about_W->cast<double>());
    if (!pixel) return {};
    const Eigen::Vector2f at(static_cast<float>(pixel->x), static_cast<float>(pixel->y));
    const Eigen::Vector2f reach = Eigen::Vector2f::Constant(kNear * height);
    box = box.intersection({at - reach, at + reach});
  }
  box = box.intersection(Eigen::AlignedBox2f(Eigen::Vector2f::Zero(), Eigen::Vector2f(width, height)));
  if (box.isEmpty()) return {};
  return PictureBox{box.min().x(), box.min().y(), box.max().x(), box.max().y()};
}

std::vector<PictureBox> boxes_of(const RenderScene& scene, Stereo stereo, PixelSize seen_size) {
  std::vector<PictureBox> boxes;
  if (seen_size.width < 2 || seen_size.height < 2) return boxes;
  std::vector<Sight> sights;
  for (const Eye eye : eyes_of(stereo))
    sights.push_back({eye_view(scene.camera, eye, aspect_of(seen_size)), seen_size});
  for (const SeenThing& thing : scene.seen) {
    std::optional<PictureBox> both;
    for (const Sight& sight : sights) {
      const auto box = box_of(sight, thing);
      if (!box) continue;
      both = !both ? *box
                   : PictureBox{std::min(both->left, box->left), std::min(both->top, box->top),
                                std::max(both->right, box->right), std::max(both->bottom, box->bottom)};
    }
    if (both) boxes.push_back(*both);
  }
  return boxes;
}

Vec3 point_at(const Sight& sight, PixelPlace place, double depth_m) {
  const SightRay ray = ray_through(sight, place);
  const Vec3 ahead_W = -sight.view.V_CW.block<1, 3>(2, 0).cast<double>().transpose().normalized();
  // A frustum opens by less than half a turn, so a ray through a pixel of the picture always goes forward.
  return ray.p_W + ray.d_W * (depth_m / std::max(ray.d_W.dot(ahead_W), 1e-3));
}

}  // namespace mechane::picture
