// An object made ready for contact queries: parts with superquadric bounds and distance maps, surface samples in clusters, spheres.
// Immutable once built; any number of worlds and threads read one object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include "server/collision/kernels.hpp"
#include "server/collision/part_map.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::collision {

// Eigen's alignment depends on the instruction set that it is compiled for, and must be the same in all code that shares an Object.
// mechane::collision's target sets it.
static_assert(alignof(Quat) == 16, "define EIGEN_MAX_ALIGN_BYTES=16, as the library was built");

inline constexpr std::size_t kMaxParts = 1024;  ///< of one object

/// A part close to convex: its superquadric bounds it (F <= 1 on every vertex), its map holds the surface.
struct Part {
  std::string name;
  Pose X_OQ;  ///< the superquadric's frame in the object's frame
  geometry::Superquadric superquadric;
  PartMap map;
  geometry::Sphere bound_O;  ///< around the part's mesh
};

/// A sphere around each four points of a cluster.
struct alignas(16) QuadSpheres {
  std::array<float, kLanes / 4> x, y, z, radius;
  [[nodiscard]] SpheresView view() const noexcept { return {x.data(), y.data(), z.data(), radius.data()}; }
};

/// Up to 16 surface samples with a common bounding sphere, all of one part.
struct Cluster {
  geometry::Sphere bound_O;
  PointBlock samples_O{};          ///< the lanes beyond `count` repeat the first
  QuadSpheres quads_O{};           ///< around each four of them
  std::uint32_t first_sample = 0;  ///< among all of the object's
  std::uint16_t count = 0;
  std::uint16_t part = 0;

  [[nodiscard]] Vec3f sample_O(std::size_t lane) const {
    return {samples_O.x[lane], samples_O.y[lane], samples_O.z[lane]};
  }
};

/// The spheres of up to 16 clusters that follow one another in Object::clusters, all of one part.
struct ClusterGroup {
  SphereBlock bounds_O{};
  geometry::Sphere bound_O;  ///< around all of them
  std::uint32_t first_cluster = 0;
  std::uint32_t count = 0;
};

/// See samples.hpp for how clusters and groups are made.
struct Object {
  std::vector<Part> parts;
  std::vector<Cluster> clusters;           ///< sorted by part
  std::vector<ClusterGroup> groups;        ///< sorted by part
  std::vector<std::uint32_t> first_group;  ///< of each part; one more entry closes the last
  geometry::Sphere bound_O;                ///< around all parts
};

/// One point of overlap between objects A and B. See Drake's PenetrationAsPointPair for the conventions.
struct PointContact {
  Vec3 p_WC = Vec3::Zero();    ///< the point, on B's surface
  Vec3 n_BA_W = Vec3::Zero();  ///< unit, from B into A: moving A along it separates
  double depth_m = 0;          ///< > 0
  std::uint16_t part_a = 0;
  std::uint16_t part_b = 0;
};

/// A fixed buffer of contacts that keeps the deepest when it is full. The storage is the caller's. The deepest lie close together: for
/// the whole patch give it enough room (a fingertip on a face: some 100; a hand around a handle: some 1000).
class ContactBuffer {
 public:
  explicit ContactBuffer(std::span<PointContact> storage) : storage_(storage) {}
  void add(const PointContact& contact) noexcept;
  /// Whether a contact so deep would be kept.
  [[nodiscard]] bool wants(double depth_m) const noexcept {
    return count_ < storage_.size() || (!storage_.empty() && depth_m > storage_.front().depth_m);
  }
  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::span<const PointContact> contacts() const { return storage_.first(count_); }

 private:
  std::span<PointContact> storage_;
  std::size_t count_ = 0;
};

/// The samples of all clusters, as kernels read them. There must be at least one.
[[nodiscard]] PointRuns runs_of(const Object& object) noexcept;

/// All overlaps of A and B: A's samples in B's parts and B's samples in A's parts, after culling by spheres (objects, parts,
/// clusters). Both directions report the same way: the point on B's surface, the normal from B into A. Allocates nothing, throws
/// nothing; the cost grows with the number of points that the spheres do not exclude. Any thread.
void find_contacts(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB, ContactBuffer& out) noexcept;

/// Where the surface of a target is above a point inside it, in the target's frame.
struct SurfaceHit {
  Vec3f p_T;  ///< on the surface
  Vec3f n_T;  ///< outward unit normal there
  float depth_m;
};

/// The samples of `points` that lie inside the target, in no order, as many as `out` has room for; returns how many. As find_contacts, in
/// one direction.
[[nodiscard]] std::size_t find_surface(const Object& points, const Pose& X_TS, const Object& target,
                                       std::span<SurfaceHit> out) noexcept;

}  // namespace mechane::collision
