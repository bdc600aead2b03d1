// Exact questions to an object: which side a point is on, all parts' meshes say; how far the surface is, the surface without the seams.
#pragma once

#include <limits>

#include "server/geometry/mesh_query.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {

class SolidQuery {
 public:
  explicit SolidQuery(const SceneObject& object)
      : sides_(object.mesh_O), skin_(object.skin_O.triangles.empty() ? object.mesh_O : object.skin_O) {}

  [[nodiscard]] geometry::SurfacePoint closest(const Vec3& p,
                                               double max_distance_m = std::numeric_limits<double>::infinity()) const {
    return skin_.closest(p, max_distance_m);
  }
  [[nodiscard]] int winding(const Vec3& p) const { return sides_.winding(p); }
  [[nodiscard]] double signed_distance(const Vec3& p) const {
    const double distance_m = skin_.closest(p).distance_m;
    return sides_.winding(p) > 0 ? -distance_m : distance_m;
  }
  /// Of a triangle that `closest` named.
  [[nodiscard]] Vec3 triangle_normal(std::uint32_t triangle) const { return skin_.triangle_normal(triangle); }

 private:
  geometry::MeshQuery sides_, skin_;
};

}  // namespace mechane::benchmark
