// Points in, depths and normals out: the query below find_contacts, which can also be used alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/collision/kernels.hpp"
#include "server/collision/near_list.hpp"
#include "server/collision/object.hpp"
#include "server/collision/placed_part.hpp"

namespace mechane::collision {

/// Points of some frame S, in clusters of 16 with a sphere around each, the clusters in groups with a sphere around each. Views of the
/// caller's arrays: points by cluster, cluster spheres by group, so that point = 16 cluster + lane and
/// cluster = clusters_per_group * group + k. A kernel reads 16 spheres at a time: up to 15 beyond the last must be readable.
struct PointSet {
  PointsView points;
  SpheresView clusters;
  SpheresView groups;
  std::size_t group_count = 0;
  std::size_t clusters_per_group = 0;  ///< 1 to 16
  Vec3f center = Vec3f::Zero();        ///< of a sphere around everything
  float radius = 0;
  SpheresView quads{};  ///< around each four points, if the caller has them: a query of a DistanceField is quicker then
  /// For a NearList: the rotation of each group, row after row, number i of group g at rotations[i][g]; the groups are rigid then.
  std::array<const float*, 9> rotations{};
};

/// Which points lie inside, each once and in no order; structure of arrays. The storage is kept from one query to the next.
struct PointHits {
  std::vector<std::uint32_t> point;
  std::vector<float> depth_m;        ///< > 0
  std::vector<float> n_x, n_y, n_z;  ///< outward unit normal of the target's surface, in S
  std::size_t count = 0;

  /// Room for every point of a set, so that a query allocates nothing. The vectors are longer: kernels write whole vectors.
  explicit PointHits(std::size_t points);
  [[nodiscard]] std::size_t room() const noexcept { return point.size() - kLanes - count; }
};

/// An object at a place. Made again when it moves; a query then only reads. The object must outlive it.
class PlacedObject {
 public:
  PlacedObject(const Object& object, const Pose& X_SO);

  /// Adds the points that lie inside to `out`, while it has room. Allocates nothing. Any thread.
  void query(const PointSet& points, PointHits& out, const Kernels& kernels = best_kernels()) const noexcept;
  /// The same, to the bit, and quicker where the object is one DistanceField and the set has quads and rotations: the fours of points that
  /// are near are found anew only when something has moved by more than the list's margin.
  void query(const PointSet& points, NearList& near, PointHits& out,
             const Kernels& kernels = best_kernels()) const noexcept;

 private:
  [[nodiscard]] bool reaches(const PointSet& points) const noexcept;
  [[nodiscard]] bool is_field() const noexcept;
  [[nodiscard]] bool still_holds(const NearList& near, const PointSet& points, const Kernels& kernels) const noexcept;
  void renew(NearList& near, const PointSet& points, const Kernels& kernels) const noexcept;
  template <class Take>
  void sift_field(const PointSet& points, const FieldView& field, const Kernels& kernels,
                  const Take& take) const noexcept;
  void add_hits(const PointSet& points, std::uint32_t* quads, std::size_t count, PointHits& out,
                const Kernels& kernels) const noexcept;

  std::vector<PlacedPart> parts_;
  std::vector<Eigen::Matrix3f> R_SQ_;
  Vec3f center_S_ = Vec3f::Zero();
  float radius_ = 0;
};

}  // namespace mechane::collision
