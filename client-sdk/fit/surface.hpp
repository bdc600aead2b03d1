// The surface of a fitted object: which part each triangle belongs to, where it borders on air, and how far what is felt is off.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client-sdk/fit/fitted_object.hpp"
#include "client-sdk/fit/probe.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::fit {

/// What a probe says just under a point of the surface.
struct SurfaceError {
  bool felt = false;   ///< false: the point inside the object is not felt at all
  double error_m = 0;  ///< |depth by the maps - exact depth|; where nothing is felt, the whole exact depth
};

/// Built once; any thread may ask.
class Surface {
 public:
  explicit Surface(const FittedObject& fitted);

  [[nodiscard]] const geometry::Mesh& mesh() const { return mesh_; }  ///< all meshes, in O
  [[nodiscard]] const std::vector<std::uint32_t>& part_of_triangle() const { return part_of_triangle_; }
  [[nodiscard]] std::vector<std::size_t> triangles_of_parts() const;

  /// How deep under the surface `error_at` asks: the lesser of 2 mm and 0.5 % of the diagonal.
  [[nodiscard]] double probe_depth_m() const { return probe_depth_m_; }
  [[nodiscard]] double diagonal_m() const { return diagonal_m_; }

  /// `p_O` lies on `triangle`. The probe goes in along the triangle's normal, in thin walls to their middle at most. Nothing for
  /// triangles that border on another part, not on air.
  [[nodiscard]] std::optional<SurfaceError> error_at(const Vec3& p_O, std::uint32_t triangle) const;

 private:
  void find_skin(const FittedObject& fitted);
  void assign_parts(const FittedObject& fitted);

  Probe probe_;
  geometry::Mesh mesh_;
  std::vector<bool> exposed_;
  std::vector<std::uint32_t> mesh_of_triangle_;
  std::vector<std::uint32_t> part_of_triangle_;
  geometry::MeshQuery skin_;
  double diagonal_m_ = 0;
  double probe_depth_m_ = 0;
  std::size_t parts_ = 0;
};

}  // namespace mechane::fit
