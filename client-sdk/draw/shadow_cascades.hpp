// Where the sun's shadow maps lie. Up to three squares about what is touched, each several times as wide as the one within it: sharp where
// the visitor works, and still there at the far houses. They stand in the world, not before the camera: a camera that moves, two eyes and a
// close-up all see the same shadows, and none of them shimmers. L is the sun's frame: x and y across its rays, z away from it, metres.
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
  float nearest_m = -1;                 ///< along the rays: nothing that throws a shadow is nearer to the sun
  float depth_m = 2;                    ///< from there on
  std::vector<ShadowCascade> cascades;  ///< the narrowest first; at least one

  /// World to clip space of a cascade's map.
  [[nodiscard]] Eigen::Matrix4f PV(std::size_t cascade) const;
};

/// For all shadows in all_W, sharpest in focus_W; without a focus all is equally sharp. The squares lie on whole texels, so that a focus that
/// moves takes the edges of shadows nowhere.
[[nodiscard]] ShadowSetup shadow_setup(const Eigen::AlignedBox3f& focus_W, const Eigen::AlignedBox3f& all_W,
                                       const Vec3f& to_sun_W, std::uint32_t map_size);

/// Whether what the box throws falls on places alone for which a narrower cascade than this one is looked at: then it need not be drawn here.
[[nodiscard]] bool is_shadow_within(const ShadowSetup& setup, std::size_t cascade, const Eigen::Affine3f& X_WM,
                                    const Eigen::AlignedBox3f& box_M);

/// From this share of a cascade's half width on, the next one is mixed in: lighting.glsl has the same number.
inline constexpr float kCascadeBlend = 0.9F;

}  // namespace mechane::draw
