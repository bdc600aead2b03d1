// A plane that the distance to a mesh never goes below, block by block.
#pragma once

#include <cstddef>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/distance_field.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::collision_build {

/// Made once from a mesh, given in units of blocks. Any thread may ask.
///
/// The proof. Let L(p) = v + g . (p - c) over the block around c. For a triangle T and any vector u no longer than 1, |p - s| >= u . (p -
/// s) for all p of the block and s of T; so |p - s| - L(p) is at least the least value of (u - g) . (p - c) over the block's corners, less
/// the largest of u . (s - c) over T's corners, less v. A v that makes this 0 or more for each T, with a u of its own, bounds the distance
/// from below everywhere in the block. Where L > 0 there is then no surface; that is a convex region, so it lies in air as a whole if one
/// point of it does, and what is left inside has L <= 0.
class BoundingPlanes {
 public:
  /// `mesh_B`: vertices in units of blocks, from the grid's lowest corner on.
  explicit BoundingPlanes(const geometry::Mesh& mesh_B);

  /// `slope` is a wish; `distance` is that of the block's middle, unsigned. Whether the place where the plane is highest is inside has
  /// still to be asked: see highest() and sunk().
  [[nodiscard]] collision::DistanceField::Plane make(const Vec3& middle, const Vec3& slope, double distance) const;

  /// The place in the block, 0 to 1, where a plane is highest.
  [[nodiscard]] static Vec3 highest(const collision::DistanceField::Plane& plane);
  /// The plane lowered until it is nowhere above 0: for a block that is solid where it was highest.
  [[nodiscard]] static collision::DistanceField::Plane sunk(collision::DistanceField::Plane plane);

 private:
  struct Facet {
    Vec3 a, b, c;
    Vec3 n;  // outward; zero where the triangle has no area
    Vec3 middle;
    double radius = 0;
  };
  /// Facets from `begin` on, in two halves down to a few. The first half comes right after it.
  struct Branch {
    Eigen::AlignedBox3d box;
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t second = 0;  // 0: it has no halves
  };
  void grow(std::size_t begin, std::size_t end);
  [[nodiscard]] static double least(const Facet& facet, const Vec3& middle, const Vec3& g, double enough);

  std::vector<Facet> facets_;
  std::vector<Branch> tree_;
};

}  // namespace mechane::collision_build
