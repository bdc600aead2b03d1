// The surface of a fitted object: to which part each triangle belongs, where it borders on air, and the error of what
// is felt.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/probe.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::fit {

/// Where a finger that moves straight towards a point of the surface meets it.
struct SurfaceError {
  bool felt = false;   ///< false: nothing is felt down to `reach_m`, or to the middle of a thin wall
  double error_m = 0;  ///< distance of the contact from the true surface, on either side
};

/// Built once; any thread may query it.
class Surface {
 public:
  explicit Surface(const FittedObject& fitted);

  [[nodiscard]] const geometry::Mesh& mesh() const { return mesh_; }  ///< all solids, in O
  [[nodiscard]] const std::vector<geometry::SurfaceOrigin>& origin_of_triangle() const { return origin_; }
  [[nodiscard]] const std::vector<std::uint32_t>& part_of_triangle() const { return part_of_triangle_; }
  [[nodiscard]] std::vector<std::size_t> triangles_of_parts() const;

  [[nodiscard]] double diagonal_m() const { return diagonal_m_; }

  /// How far `error_at` searches for the felt surface: 2 % of the diagonal in each direction.
  [[nodiscard]] double reach_m() const;

  /// `p_O` lies on `triangle`. Searches along the triangle's normal; in thin walls and narrow gaps only to their
  /// middle. The error is at most the reach. None for places that border on another part instead of air.
  [[nodiscard]] std::optional<SurfaceError> error_at(const Vec3& p_O, std::uint32_t triangle) const;

 private:
  void find_skin();
  void assign_parts(const FittedObject& fitted);
  [[nodiscard]] double clearance_m(const Vec3& p_O, const Vec3& direction) const;

  Probe probe_;
  geometry::Mesh mesh_;
  std::vector<geometry::SurfaceOrigin> origin_;
  std::vector<bool> exposed_;
  std::vector<std::uint32_t> mesh_of_triangle_;
  std::vector<std::uint32_t> part_of_triangle_;
  collision_build::Solid solid_;  // the meshes, as the builder treats them
  geometry::MeshQuery skin_;      // the triangles that border on air somewhere
  double diagonal_m_ = 0;
  std::size_t parts_ = 0;
};

}  // namespace mechane::fit
