// Exact questions to a triangle mesh: distance, side, rays. Double precision, for builders and tests; never in a tick.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

struct SurfacePoint {
  Vec3 p = Vec3::Zero();  ///< the closest point of the mesh
  double distance_m = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = 0;
};

struct RayHit {
  double t = 0;  ///< the hit is origin + t direction
  std::uint32_t triangle = 0;
  bool entering = true;  ///< the ray meets the outer side of the triangle
};

/// A tree of boxes over the triangles of one mesh. Copies what it needs; immutable; any thread.
class MeshQuery {
 public:
  /// The mesh must be finite, its indices in range (see mesh_check.hpp). An empty mesh has no closest point and no hits.
  explicit MeshQuery(const Mesh& mesh);

  /// The closest point within `max_distance_m`; infinite distance when there is none.
  [[nodiscard]] SurfacePoint closest(const Vec3& p,
                                     double max_distance_m = std::numeric_limits<double>::infinity()) const;

  /// Distance to the surface, negative inside. Inside is a winding number above 0, so overlapping closed pieces are one solid.
  [[nodiscard]] double signed_distance(const Vec3& p) const;

  /// How many closed pieces contain p: crossings towards the outside less crossings towards the inside, the middle of three rays.
  /// Means nothing for a mesh with open edges.
  [[nodiscard]] int winding(const Vec3& p) const;

  /// All hits with t > 0, sorted by t. `direction` need not be of unit length. Replaces what is in `hits`.
  void cast(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const;

  [[nodiscard]] Vec3 triangle_normal(std::uint32_t triangle) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d padded;  // for rays, whose arithmetic rounds
    std::uint32_t first = 0;     // of the leaf's triangles, or of two child nodes that lie side by side
    std::uint32_t count = 0;     // 0: an inner node
  };
  struct Triangle {
    Vec3 a, b, c;
    std::uint32_t index = 0;
  };
  void split(std::uint32_t node);
  /// Calls `found(hit)` for each hit with t > 0, in no order.
  template <class Found>
  void cast_each(const Vec3& origin, const Vec3& direction, const Found& found) const;

  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> slot_of_;  // mesh triangle -> triangles_
};

}  // namespace mechane::geometry
