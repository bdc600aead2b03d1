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

RadialView RadialMap::view() const noexcept {
  const auto array = [](const Vec3f& v) { return std::array<float, 3>{v.x(), v.y(), v.z()}; };
  return {texels_.data(), resolution_, sigma_step_, array(center_Q_), array(half_Q_), array(half_Q_.cwiseInverse())};
}

BoxView RadialMap::box() const noexcept {
  const RadialView v = view();
  return {v.center, v.half};
}

MapHit RadialMap::evaluate(const Vec3f& p_QP) const noexcept {
  return evaluate_one(p_QP, view(), portable().radial_inside, portable().radial_depth);
}

}  // namespace mechane::collision
