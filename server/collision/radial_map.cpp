#include "server/collision/radial_map.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::collision {
namespace {

constexpr float kTiny = 1e-20F;

float largest_sigma(std::span<const float> sigma) {
  float largest = 0;
  for (const float s : sigma)
    largest = std::max(largest, s);
  return largest;
}

int longest_axis(const Vec3f& x) noexcept {
  const Vec3f ax = x.cwiseAbs();
  if (ax.x() >= ax.y() && ax.x() >= ax.z()) return 0;
  return ax.y() >= ax.z() ? 1 : 2;
}

}  // namespace

bool RadialMap::is_valid(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
                         std::size_t texels) {
  if (resolution != 16 && resolution != 32 && resolution != 64) return false;
  const auto edge = static_cast<std::size_t>(resolution);
  if (texels != 6 * edge * edge) return false;
  if (!center_Q.allFinite() || !half_Q.allFinite() || half_Q.minCoeff() < 1e-6F || half_Q.maxCoeff() > 1e4F)
    return false;
  return std::isfinite(sigma_step) && sigma_step > 0 && sigma_step <= 1.0F;
}

RadialMap::RadialMap(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
                     std::vector<std::uint16_t> texels)
    : resolution_(resolution),
      center_Q_(center_Q),
      half_Q_(half_Q),
      inverse_half_(half_Q.cwiseInverse()),
      sigma_step_(sigma_step),
      texels_(std::move(texels)) {
  MECHANE_ASSERT(is_valid(resolution_, center_Q_, half_Q_, sigma_step_, texels_.size()));
}

RadialMap RadialMap::from_sigma(int resolution, const Vec3f& center_Q, const Vec3f& half_Q,
                                std::span<const float> sigma) {
  const float step = std::min(std::max(largest_sigma(sigma), 1e-3F), kMaxSigma) / 65535.0F;
  std::vector<std::uint16_t> texels(sigma.size());
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    texels[i] = static_cast<std::uint16_t>(std::lround(std::clamp(sigma[i] / step, 0.0F, 65535.0F)));
  }
  return {resolution, center_Q, half_Q, step, std::move(texels)};
}

Vec3 RadialMap::texel_direction(int resolution, const Vec3f& half_Q, int face, int iu, int iv) {
  const int axis = face / 2;
  Vec3 scaled;
  scaled[axis] = face % 2 == 0 ? 1 : -1;
  scaled[(axis + 1) % 3] = -1 + 2.0 * iu / (resolution - 1);
  scaled[(axis + 2) % 3] = -1 + 2.0 * iv / (resolution - 1);
  return scaled.cwiseProduct(half_Q.cast<double>());
}

/// g and its gradient at the scaled point x, on the face of `axis`, which must be (nearly) the longest.
RadialMap::Local RadialMap::local(const Vec3f& x, int axis) const noexcept {
  const int axis_u = axis == 2 ? 0 : axis + 1;
  const int axis_v = axis == 0 ? 2 : axis - 1;
  const float sign = x[axis] < 0 ? -1.0F : 1.0F;
  Local at;
  at.m = std::abs(x[axis]);

  const float half_n = 0.5F * static_cast<float>(resolution_ - 1);
  const float m = at.m + kTiny;
  const float u = x[axis_u] / m;
  const float v = x[axis_v] / m;
  const float tu = std::clamp(u * half_n + half_n, 0.0F, 2 * half_n);
  const float tv = std::clamp(v * half_n + half_n, 0.0F, 2 * half_n);
  const int iu = std::min(static_cast<int>(tu), resolution_ - 2);
  const int iv = std::min(static_cast<int>(tv), resolution_ - 2);
  const float fu = tu - static_cast<float>(iu);
  const float fv = tv - static_cast<float>(iv);

  const int face = 2 * axis + (sign < 0 ? 1 : 0);
  const std::uint16_t* texel = texels_.data() + static_cast<std::size_t>((face * resolution_ + iv) * resolution_ + iu);
  const float s00 = texel[0];
  const float s10 = texel[1];
  const float s01 = texel[resolution_];
  const float s11 = texel[resolution_ + 1];
  const float s0 = s00 + (s10 - s00) * fu;
  const float s1 = s01 + (s11 - s01) * fu;
  const float sigma = (s0 + (s1 - s0) * fv) * sigma_step_;
  const float sigma_u = ((s10 - s00) + ((s11 - s01) - (s10 - s00)) * fv) * sigma_step_ * half_n;
  const float sigma_v = (s1 - s0) * sigma_step_ * half_n;

  // g = m sigma(u, v) - 1 with u = x_u / m, v = x_v / m: the chain rule's 1/m cancels against m.
  at.g = at.m * sigma - 1;
  at.gradient[axis] = sign * (sigma - u * sigma_u - v * sigma_v);
  at.gradient[axis_u] = sigma_u;
  at.gradient[axis_v] = sigma_v;
  at.gradient = at.gradient.cwiseProduct(inverse_half_);
  return at;
}

/// The tangent plane where the direction of `x_foot` meets the surface, and the depth of x under it. Depth 0: no such plane.
RadialMap::Plane RadialMap::tangent_plane(const Vec3f& x, const Vec3f& x_foot, int axis) const noexcept {
  const Local foot = local(x_foot, axis);
  const float square = foot.gradient.squaredNorm();
  if (!(square > kTiny)) return {};  // every direction hereabouts is covered: no surface
  // g is nearly linear along a ray and from it to the sides, so the plane g + gradient (y - x_foot) = 0 is the tangent plane.
  const float g_at_x = foot.g + foot.gradient.dot((x - x_foot).cwiseProduct(half_Q_));
  const float norm = std::sqrt(square);
  return {foot.gradient / norm, std::max(0.0F, -g_at_x / norm)};
}

RadialMap::Plane RadialMap::nearest_plane(const Vec3f& x, const Local& here) const noexcept {
  Plane nearest;
  const float norm_here = here.gradient.norm();
  if (norm_here > kTiny) nearest = {here.gradient / norm_here, -here.g / norm_here};
  for (int axis = 0; axis < 3; ++axis) {
    Vec3f x_foot = x;
    x_foot[axis] = x[axis] < 0 ? -1.0F : 1.0F;
    const Plane plane = tangent_plane(x, x_foot, axis);
    if (plane.depth_m > 0 && (plane.depth_m < nearest.depth_m || !(nearest.depth_m > 0))) nearest = plane;
  }
  return nearest;
}

/// The surface's own normal where the guess lands, and the depth along it; the guess itself where the map says that it was better.
RadialMap::Plane RadialMap::newton_step(const Vec3f& x, const Plane& guess) const noexcept {
  const Vec3f x_landed = x + (guess.depth_m * guess.n).cwiseProduct(inverse_half_);
  const Plane there = tangent_plane(x, x_landed, longest_axis(x_landed));
  const bool sound = there.depth_m > 0 && there.n.dot(guess.n) > 0.5F && there.depth_m < 2 * guess.depth_m;
  return sound ? there : guess;
}

MapHit RadialMap::evaluate(const Vec3f& p_QP) const noexcept {
  MapHit result;
  if (texels_.empty()) return result;
  const Vec3f x = (p_QP - center_Q_).cwiseProduct(inverse_half_);
  // Written so that NaN is outside.
  if (!(std::abs(x.x()) <= 1.0F && std::abs(x.y()) <= 1.0F && std::abs(x.z()) <= 1.0F)) return result;
  const Local here = local(x, longest_axis(x));
  if (!(here.g < 0)) return result;
  const Plane nearest = nearest_plane(x, here);
  if (!(nearest.depth_m > 0)) return result;  // covered on all sides: deep in the wood of several parts
  const Plane surface = newton_step(x, nearest);
  result.hit = true;
  result.depth_m = surface.depth_m;
  result.m = here.m;
  result.n_Q = surface.n;
  result.p_QS = p_QP + surface.depth_m * surface.n;
  return result;
}

}  // namespace mechane::collision
