// Exact questions to a triangle mesh: distance, side, rays. Double precision, for builders and tests; never in a tick.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/box_quad.hpp"
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

/// How a MeshQuery tells the inside. Rays are exact for closed meshes and mean nothing for others; winding numbers serve any mesh.
enum class Inside { by_rays, by_winding_number };

/// A tree of boxes over the triangles of one mesh. Copies what it needs; immutable; any thread.
class MeshQuery {
 public:
  /// The mesh must be finite, its indices in range (see mesh_check.hpp). An empty mesh has no closest point and no hits.
  explicit MeshQuery(const Mesh& mesh, Inside inside = Inside::by_rays);

  /// The closest point within `max_distance_m`; infinite distance when there is none.
  [[nodiscard]] SurfacePoint closest(const Vec3& p,
                                     double max_distance_m = std::numeric_limits<double>::infinity()) const;

  /// The same answer as closest(p), sooner where `near` is the answer for a place nearby.
  [[nodiscard]] SurfacePoint closest(const Vec3& p, const SurfacePoint& near) const;

  /// Distance to the surface, negative where contains() holds.
  [[nodiscard]] double signed_distance(const Vec3& p) const;

  /// By rays: a winding above 0, so overlapping closed pieces are one solid. By winding number: one above 0.5, which closes holes.
  [[nodiscard]] bool contains(const Vec3& p) const;

  /// The generalized winding number: the solid angle under which the mesh is seen from p, outer sides counted negative, as a share of the
  /// full sphere. 1 in a closed mesh, 0 outside, between where there are holes. Far triangles are taken together (Barill et al. 2018),
  /// which errs by a thousandth or two. Only for Inside::by_winding_number.
  [[nodiscard]] double winding_number(const Vec3& p) const;

  /// How many closed pieces contain p: crossings towards the outside less crossings towards the inside, the middle of three rays.
  /// Means nothing for a mesh with open edges.
  [[nodiscard]] int winding(const Vec3& p) const;

  /// All hits with t > 0, sorted by t. `direction` need not be of unit length. Replaces what is in `hits`.
  void cast(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const;

  [[nodiscard]] Vec3 triangle_normal(std::uint32_t triangle) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;  // of the leaf's triangles, or of two child nodes that lie side by side
    std::uint32_t count = 0;  // 0: an inner node
  };
  /// The triangles of a leaf; or two generations of nodes under one: each child's children, or the child where it is a leaf.
  struct Quad {
    BoxQuad boxes;
    std::uint32_t node = 0;
    std::array<std::uint32_t, 4> child{};  // quads; in a leaf: slots of triangles
    std::uint8_t count = 0;
    bool is_leaf = false;
  };
  struct Triangle {
    Vec3 a, b, c;
    std::uint32_t index = 0;
  };
  /// What the triangles of a node look like from afar: integrals over their area, d being the way from the center, n the unit normal.
  struct Moments {
    Vec3 center = Vec3::Zero();
    double radius = 0;  // around the center, of the node's box
    double area = 0;
    Vec3 dipole = Vec3::Zero();                                             // of n
    Mat3 spread = Mat3::Zero();                                             // of d n^T
    std::array<Mat3, 3> bend = {Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};  // of d d^T n_k

    void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
    void add(const Moments& child);
    /// The solid angle under which they are seen, r being the way from there to the center.
    [[nodiscard]] double solid_angle(const Vec3& r) const;
  };
  void split(std::uint32_t node);
  void add_quads();
  [[nodiscard]] SurfacePoint closest_within(const Vec3& p, double square) const;
  /// Which of two triangles that are equally near to p answers for it: the one in the nearer child of the node where their ways part.
  [[nodiscard]] bool comes_before(std::uint32_t slot, std::uint32_t other, const Vec3& p) const;
  /// Calls `found(hit)` for each hit with t > 0, in no order.
  template <class Found>
  void cast_each(const Vec3& origin, const Vec3& direction, const Found& found) const;
  void add_moments();
  [[nodiscard]] Moments moments_of_leaf(const Node& leaf) const;
  [[nodiscard]] Moments moments_of_children(const Node& node) const;

  std::vector<Node> nodes_;
  std::vector<Quad> quads_;
  double reach_ = 0;  // the largest coordinate
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> slot_of_;  // mesh triangle -> triangles_
  std::vector<Moments> moments_;        // of each node; empty: inside by rays
};

}  // namespace mechane::geometry
