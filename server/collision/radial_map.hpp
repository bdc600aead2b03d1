// The surface of one part as a cube map: seen from a centre, how far the surface lies in each direction. A query is closed form:
// no search, no pow. See ARCHITECTURE.md, 'Collision parts'.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/map_hit.hpp"

namespace mechane::collision {

/// Six N x N faces of a cube around `center_Q`, scaled by `half_Q` (the superquadric's semi-axes): a direction d has
/// m = max|d_i / half_i| and two face coordinates (u, v) in [-1, 1].
///
/// Departure from the architecture's G = m - rho(u,v): the map stores sigma = 1/rho and uses G = m sigma(u,v) - 1, which has the same
/// zero set. A plane in the part's frame makes sigma linear in (u, v), so bilinear interpolation, depth and normal are exact for flat
/// faces, also seen at a slant, where rho is a hyperbola.
class RadialMap {
 public:
  static constexpr std::array<int, 7> kResolutions = {8, 12, 16, 24, 32, 48, 64};
  static constexpr float kMaxSigma = 65535.0F;

  /// `texels` holds 6 N N values, face after face, u fastest; sigma = texel * sigma_step. Asserts on sizes and signs: use is_valid first.
  RadialMap(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
            std::vector<std::uint16_t> texels);

  /// Whether the arguments make a map: N of kResolutions, the right count of texels, finite positive scales.
  [[nodiscard]] static bool is_valid(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
                                     std::size_t texels);

  /// Quantises exact values of sigma (6 N N, >= 0). Sigma 0: no surface in this direction, all is inside.
  [[nodiscard]] static RadialMap from_sigma(int resolution, const Vec3f& center_Q, const Vec3f& half_Q,
                                            std::span<const float> sigma);

  /// The direction of a texel's centre, from the centre, in Q, with m = 1: the point where sigma = 1 would put the surface.
  [[nodiscard]] static Vec3 texel_direction(int resolution, const Vec3f& half_Q, int face, int iu, int iv);

  /// Depth, normal and surface point; no hit outside the box m <= 1 and outside the surface. Any thread.
  ///
  /// The ray from the centre through p tells whether p is inside. It does not tell the depth: in a plank it leads most points to the far
  /// end. So seven tangent planes are tried, where p's own ray and the six ways along the axes meet the surface; the nearest counts, and
  /// one Newton step on the map improves it. Exact for boxes; still no search. Not for the loop, which asks 16 points
  /// at a time.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;

  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] const Vec3f& center_Q() const { return center_Q_; }
  [[nodiscard]] const Vec3f& half_Q() const { return half_Q_; }
  [[nodiscard]] float sigma_step() const { return sigma_step_; }
  [[nodiscard]] std::span<const std::uint16_t> texels() const { return texels_; }

  [[nodiscard]] RadialView view() const noexcept;
  [[nodiscard]] BoxView box() const noexcept;

 private:
  [[nodiscard]] float steepest_in(int face, int iu, int iv) const;

  int resolution_ = 0;
  Vec3f center_Q_ = Vec3f::Zero();
  Vec3f half_Q_ = Vec3f::Ones();
  float sigma_step_ = 0;
  float steepest_ = 0;
  std::vector<std::uint16_t> texels_;
};

}  // namespace mechane::collision
