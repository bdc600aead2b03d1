// The surface of a fitted object: which part each triangle belongs to, where it borders on air, and how far what is felt is off.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/probe.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::fit {

/// Where a finger meets the surface, coming straight at a point of it.
struct SurfaceError {
  bool felt = false;   ///< false: nothing is felt down to `reach_m`, or to the middle of a thin wall
  double error_m = 0;  ///< distance from the place where it is met to the true surface, before or behind it
};

/// Built once; any thread may ask.
class Surface {
 public:
  explicit Surface(const FittedObject& fitted);

  [[nodiscard]] const geometry::Mesh& mesh() const { return mesh_; }  ///< all meshes, in O
  [[nodiscard]] const std::vector<std::uint32_t>& part_of_triangle() const { return part_of_triangle_; }
  [[nodiscard]] std::vector<std::size_t> triangles_of_parts() const;

  [[nodiscard]] double diagonal_m() const { return diagonal_m_; }

  /// How far `error_at` looks for the felt surface: 2 % of the diagonal, each way.
  [[nodiscard]] double reach_m() const;

  /// `p_O` lies on `triangle`. The maps are asked along the triangle's normal, in thin walls and narrow gaps to their middle. An error
  /// ends at the reach. Nothing for places that border on another part, not on air.
  [[nodiscard]] std::optional<SurfaceError> error_at(const Vec3& p_O, std::uint32_t triangle) const;

 private:
  void find_skin();
  void assign_parts(const FittedObject& fitted);
  [[nodiscard]] double free_way_m(const Vec3& p_O, const Vec3& direction) const;

  Probe probe_;
  geometry::Mesh mesh_;
  std::vector<bool> exposed_;
  std::vector<std::uint32_t> mesh_of_triangle_;
  std::vector<std::uint32_t> part_of_triangle_;
  collision_build::Solid solid_;  // of the meshes, as the builder sees them
  geometry::MeshQuery skin_;      // triangles that border on air somewhere
  double diagonal_m_ = 0;
  std::size_t parts_ = 0;
};

}  // namespace mechane::fit
