// The surface of one part as a cube map: seen from a centre, how far the surface lies in each direction. A query is closed form:
// no search, no pow. See ARCHITECTURE.md, 'Collision parts'.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"

namespace mechane::collision {

/// What a map says of a point inside the part. All in the part's frame Q. Without `hit` the other fields mean nothing.
struct MapHit {
  bool hit = false;
  float depth_m = 0;           ///< > 0: distance to the surface along the normal
  float m = 0;                 ///< max|x_i / half_i|, in [0, 1]: how central the point lies in this part
  Vec3f n_Q = Vec3f::UnitZ();  ///< outward unit normal of the surface
  Vec3f p_QS = Vec3f::Zero();  ///< the surface point: the query point moved by depth_m along n_Q
};

/// Six N x N faces of a cube around `center_Q`, scaled by `half_Q` (the superquadric's semi-axes): a direction d has
/// m = max|d_i / half_i| and two face coordinates (u, v) in [-1, 1].
///
/// Departure from the architecture's G = m - rho(u,v): the map stores sigma = 1/rho and uses G = m sigma(u,v) - 1, which has the same
/// zero set. A plane in the part's frame makes sigma linear in (u, v), so bilinear interpolation, depth and normal are exact for flat
/// faces, also seen at a slant, where rho is a hyperbola.
class RadialMap {
 public:
  static constexpr int kMaxResolution = 64;
  static constexpr float kMaxSigma = 65535.0F;

  /// An empty map, which nothing ever hits.
  RadialMap() = default;

  /// `texels` holds 6 N N values, face after face, u fastest; sigma = texel * sigma_step. Asserts on sizes and signs: use is_valid first.
  RadialMap(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
            std::vector<std::uint16_t> texels);

  /// Whether the arguments make a map: N of 16, 32 or 64, the right count of texels, finite positive scales.
  [[nodiscard]] static bool is_valid(int resolution, const Vec3f& center_Q, const Vec3f& half_Q, float sigma_step,
                                     std::size_t texels);

  /// Quantises exact values of sigma (6 N N, >= 0). Sigma 0: no surface in this direction, all is inside.
  [[nodiscard]] static RadialMap from_sigma(int resolution, const Vec3f& center_Q, const Vec3f& half_Q,
                                            std::span<const float> sigma);

  /// The direction of a texel's centre, from the centre, in Q, with m = 1: the point where sigma = 1 would put the surface.
  [[nodiscard]] static Vec3 texel_direction(int resolution, const Vec3f& half_Q, int face, int iu, int iv);

  /// Depth, normal and surface point; no hit outside the box m <= 1 and outside the surface. Any thread.
  ///
  /// Whether p is inside, its own ray from the centre says. That ray is no guide to the depth: in a plank it leads most points to the
  /// far end. So four tangent planes are asked, where p's own ray and where three lines along the axes meet the surface; the nearest
  /// counts, and one Newton step on the map improves it. Exact for boxes; still no search.
  [[nodiscard]] MapHit evaluate(const Vec3f& p_QP) const noexcept;

  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] const Vec3f& center_Q() const { return center_Q_; }
  [[nodiscard]] const Vec3f& half_Q() const { return half_Q_; }
  [[nodiscard]] float sigma_step() const { return sigma_step_; }
  [[nodiscard]] std::span<const std::uint16_t> texels() const { return texels_; }

 private:
  struct Local {
    float m = 0;
    float g = 1;                     // m sigma - 1: below 0 inside
    Vec3f gradient = Vec3f::Zero();  // dg/dp, 1/m
  };
  struct Plane {
    Vec3f n = Vec3f::UnitZ();
    float depth_m = 0;
  };
  [[nodiscard]] Local local(const Vec3f& x, int axis) const noexcept;
  [[nodiscard]] Plane tangent_plane(const Vec3f& x, const Vec3f& x_foot, int axis) const noexcept;
  [[nodiscard]] Plane nearest_plane(const Vec3f& x, const Local& here) const noexcept;
  [[nodiscard]] Plane newton_step(const Vec3f& x, const Plane& guess) const noexcept;

  int resolution_ = 0;
  Vec3f center_Q_ = Vec3f::Zero();
  Vec3f half_Q_ = Vec3f::Ones();
  Vec3f inverse_half_ = Vec3f::Ones();
  float sigma_step_ = 0;
  std::vector<std::uint16_t> texels_;
};

}  // namespace mechane::collision
