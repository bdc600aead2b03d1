// The places of the sun's shadow maps: up to three squares around the touchable things, each several times as wide as
// the one within it. Shadows are sharp where the visitor works, and still present at far houses. The squares are fixed
// in the world, not to the camera, so that a moving camera, two eyes and a close-up see the same shadows, which never
// shimmer. L is the sun's frame: x and y across its rays, z away from it, metres.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::draw {

inline constexpr std::size_t kMostCascades = 3;

/// One map's place: a square in L's x and y.
struct ShadowCascade {
  Eigen::Vector2f middle_L = Eigen::Vector2f::Zero();
  float half_m = 1;

  [[nodiscard]] float texel_m(std::uint32_t map_size) const { return 2 * half_m / static_cast<float>(map_size); }
};

struct ShadowSetup {
  Eigen::Matrix4f X_LW = Eigen::Matrix4f::Identity();
  float nearest_m = -1;                 ///< along the rays: everything that casts a shadow is farther from the sun
  float depth_m = 2;                    ///< range from there
  std::vector<ShadowCascade> cascades;  ///< the narrowest first; at least one

  /// World to clip space of a cascade's map.
  [[nodiscard]] Eigen::Matrix4f PV(std::size_t cascade) const;
};

/// For all shadows in all_W, sharpest in focus_W; without a focus all are equally sharp. The squares are aligned to
/// whole texels, so that the edges of shadows stay in place when the focus moves.
[[nodiscard]] ShadowSetup shadow_setup(const Eigen::AlignedBox3f& focus_W, const Eigen::AlignedBox3f& all_W,
                                       const Vec3f& to_sun_W, std::uint32_t map_size);

/// Whether the box's shadow falls only on places that use a narrower cascade: then it need not be drawn in this one.
[[nodiscard]] bool is_shadow_within(const ShadowSetup& setup, std::size_t cascade, const Eigen::Affine3f& X_WM,
                                    const Eigen::AlignedBox3f& box_M);

/// From this share of a cascade's half width outwards, the next one is blended in; the same number is in lighting.glsl.
inline constexpr float kCascadeBlend = 0.9F;

}  // namespace mechane::draw
