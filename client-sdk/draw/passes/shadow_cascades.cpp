#include "client-sdk/draw/passes/shadow_cascades.hpp"

#include <algorithm>
#include <cmath>

#include "client-sdk/picture/box_corners.hpp"

namespace mechane::draw {
namespace {

/// How much wider a cascade may be than the one within it: with more, its coarser texels would be visible.
constexpr float kMostWider = 9;
/// Step between half widths, so that a focus that grows a little changes nothing.
constexpr float kWidthStep = 1.25F;

Eigen::Matrix3f axes_of_sun(const Vec3f& to_sun_W) {
  const Vec3f back = to_sun_W.normalized();
  Vec3f right = Vec3f::UnitY().cross(back);
  if (right.norm() < 1e-4F) right = Vec3f::UnitX();
  right.normalize();
  Eigen::Matrix3f R_LW;
  R_LW.row(0) = right;
  R_LW.row(1) = back.cross(right);
  R_LW.row(2) = -back;
  return R_LW;
}

/// Rounds up to a geometric series, so that similar boxes give the same value.
float stepped(float half_m) {
  return std::pow(kWidthStep, std::ceil(std::log(half_m) / std::log(kWidthStep) - 1e-3F));
}

ShadowCascade square(const Eigen::AlignedBox3f& box_L, float half_m, std::uint32_t map_size) {
  ShadowCascade out{box_L.center().head<2>(), half_m};
  const float texel_m = out.texel_m(map_size);
  out.middle_L = (out.middle_L / texel_m).array().round().matrix() * texel_m;
  return out;
}

}  // namespace

Eigen::Matrix4f ShadowSetup::PV(std::size_t cascade) const {
  const ShadowCascade& c = cascades[cascade];
  Eigen::Matrix4f P = Eigen::Matrix4f::Identity();
  P(0, 0) = P(1, 1) = 1 / c.half_m;
  P(0, 3) = -c.middle_L.x() / c.half_m;
  P(1, 3) = -c.middle_L.y() / c.half_m;
  P(2, 2) = 2 / depth_m;
  P(2, 3) = -2 * nearest_m / depth_m - 1;
  return P * X_LW;
}

ShadowSetup shadow_setup(const Eigen::AlignedBox3f& focus_W, const Eigen::AlignedBox3f& all_W, const Vec3f& to_sun_W,
                         std::uint32_t map_size) {
  const Eigen::AlignedBox3f all =
      all_W.isEmpty() ? Eigen::AlignedBox3f(Vec3f::Constant(-1), Vec3f::Constant(1)) : all_W;
  const Eigen::Matrix3f R_LW = axes_of_sun(to_sun_W);
  const Eigen::AlignedBox3f all_L = picture::moved(all, R_LW);
  ShadowSetup out;
  out.X_LW.topLeftCorner<3, 3>() = R_LW;
  out.nearest_m = all_L.min().z() - 0.02F;
  out.depth_m = all_L.sizes().z() + 0.04F;
  // One texel more on each side, for snapping.
  const float margin = 1 + 4 / static_cast<float>(map_size);
  const float widest_m = stepped(std::max(0.5F * all_L.sizes().head<2>().maxCoeff() * margin, 0.1F));
  if (!focus_W.isEmpty()) {
    const Eigen::AlignedBox3f focus_L = picture::moved(focus_W, R_LW);
    const float radius_m = stepped(std::max(0.5F * focus_W.diagonal().norm() / kCascadeBlend * margin, 0.1F));
    const float ratio = widest_m / radius_m;
    if (ratio > 1.5F) out.cascades.push_back(square(focus_L, radius_m, map_size));
    if (ratio > kMostWider) out.cascades.push_back(square(focus_L, stepped(radius_m * std::sqrt(ratio)), map_size));
  }
  out.cascades.push_back(square(all_L, widest_m, map_size));
  return out;
}

bool is_shadow_within(const ShadowSetup& setup, std::size_t cascade, const Eigen::Affine3f& X_WM,
                      const Eigen::AlignedBox3f& box_M) {
  if (cascade == 0 || box_M.isEmpty()) return false;
  const ShadowCascade& inner = setup.cascades[cascade - 1];
  const Eigen::Matrix4f X_LM = setup.X_LW * X_WM.matrix();
  for (const Eigen::Vector3f& p_M : picture::corners_of(box_M)) {
    const Eigen::Vector4f p_L = X_LM * p_M.homogeneous();
    // For a soft edge, the shader also samples the surroundings.
    const float away_m = (p_L.head<2>() - inner.middle_L).cwiseAbs().maxCoeff();
    if (away_m > 0.85F * kCascadeBlend * inner.half_m) return false;
  }
  return true;
}

}  // namespace mechane::draw
