// The parts of an object as one solid: what is inside and what is air, where parts touch, overlap, or leave a crack at a seam.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::collision_build {

[[nodiscard]] geometry::Mesh merged(std::span<const geometry::Mesh> parts);

/// Built once from part meshes as make_solid gives them; any thread may ask.
class Solid {
 public:
  /// `seam_gap_m`: cracks between parts up to this width are solid.
  Solid(std::span<const geometry::Mesh> parts, double seam_gap_m);

  /// Whether p lies inside some part.
  [[nodiscard]] bool contains(const Vec3& p) const;

  /// Whether a surface point of `part`, n its triangle's outward normal, borders on air, and not on another part.
  [[nodiscard]] bool is_exposed(std::size_t part, const Vec3& p, const Vec3& n) const;

  /// Whether no other part comes near the triangle of `part`.
  [[nodiscard]] bool is_alone(std::size_t part, const std::array<Vec3, 3>& triangle) const;

  /// Whether p, which is in no part, lies in a crack at a seam: some wall is nearer than the surface that borders on air, which is
  /// `air_side_m` away.
  [[nodiscard]] bool is_in_crack(const Vec3& p, double air_side_m) const;

  /// How far one can go from `origin` along `direction` inside the solid, in units of `direction`; at most `limit`. Seams are passed.
  /// 0: the ray starts in air.
  [[nodiscard]] double walk(const Vec3& origin, const Vec3& direction, double limit) const;

  /// Cracks at seams up to this width are solid; 0 for an object of one part.
  [[nodiscard]] double seam_gap_m() const { return seam_gap_m_; }

  [[nodiscard]] const geometry::MeshQuery& part(std::size_t part) const { return parts_[part]; }

 private:
  /// Half a gap more than the widest crack, so that a neighbour across it is reached.
  [[nodiscard]] double reach_m() const;
  [[nodiscard]] bool is_crack(const geometry::RayHit& exit, const geometry::RayHit& entry, const Vec3& direction) const;
  [[nodiscard]] double walk_by_counting(std::span<const geometry::RayHit> hits, const Vec3& direction,
                                        double limit) const;
  [[nodiscard]] double walk_by_asking(std::span<const geometry::RayHit> hits, const Vec3& origin, const Vec3& direction,
                                      double limit) const;

  double seam_gap_m_;
  std::vector<geometry::MeshQuery> parts_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  bool closed_ = true;         // all of them: rays can count
  geometry::MeshQuery whole_;  // all parts
};

}  // namespace mechane::collision_build
