#include "server/collision/radial_map.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"
#include "server/collision/evaluate_one.hpp"

namespace mechane::collision {
namespace {

float largest_sigma(std::span<const float> sigma) {
  float largest = 0;
  for (const float s : sigma)
    largest = std::max(largest, s);
  return largest;
}

}  // namespace

bool RadialMap::is_valid(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
                         std::size_t texels) {
  if (std::find(kResolutions.begin(), kResolutions.end(), resolution) == kResolutions.end()) return false;
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
      sigma_step_(sigma_step),
      texels_(std::move(texels)) {
  MECHANE_ASSERT(is_valid(resolution_, center_Q_, half_Q_, sigma_step_, texels_.size()));
  for (int face = 0; face < 6; ++face) {
    for (int cell = 0; cell < (resolution_ - 1) * (resolution_ - 1); ++cell) {
      const float slope = steepest_in(face, cell % (resolution_ - 1), cell / (resolution_ - 1));
      steepest_ = std::max(steepest_, slope);
    }
  }
  steepest_ *= 1.001F;  // rounding
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

/// The largest |dg/dp| in one cell of a face. Each part of the gradient is bilinear in the cell, so its length is convex along both
/// edges and largest in a corner.
float RadialMap::steepest_in(int face, int iu, int iv) const {
  const float half_n = 0.5F * static_cast<float>(resolution_ - 1);
  const auto texel = [&](int u, int v) {
    const int index = (face * resolution_ + iv + v) * resolution_ + iu + u;
    return static_cast<float>(texels_[static_cast<std::size_t>(index)]);
  };
  const int axis = face / 2;
  const Vec3f inverse = half_Q_.cwiseInverse();
  float steepest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const int cu = corner % 2;
    const int cv = corner / 2;
    const float sigma = sigma_step_ * texel(cu, cv);
    const float slope_u = sigma_step_ * half_n * (texel(1, cv) - texel(0, cv));
    const float slope_v = sigma_step_ * half_n * (texel(cu, 1) - texel(cu, 0));
    Vec3f gradient;
    gradient[axis] = sigma - (static_cast<float>(iu + cu) / half_n - 1) * slope_u -
                     (static_cast<float>(iv + cv) / half_n - 1) * slope_v;
    gradient[(axis + 1) % 3] = slope_u;
    gradient[(axis + 2) % 3] = slope_v;
    steepest = std::max(steepest, gradient.cwiseProduct(inverse).norm());
  }
  return steepest;
}

RadialView RadialMap::view() const noexcept {
  const auto array = [](const Vec3f& v) { return std::array<float, 3>{v.x(), v.y(), v.z()}; };
  return {texels_.data(),
          resolution_,
          sigma_step_,
          steepest_,
          array(center_Q_),
          array(half_Q_),
          array(half_Q_.cwiseInverse())};
}

BoxView RadialMap::box() const noexcept {
  const RadialView v = view();
  return {v.center, v.half};
}

MapHit RadialMap::evaluate(const Vec3f& p_QP) const noexcept {
  return evaluate_one(p_QP, view(), portable().radial_inside, portable().radial_depth);
}

}  // namespace mechane::collision
