// The scene of `deploy/bench collision`: five procedural objects, a hand of 2048 surface samples, and the steps in which it grasps
// them one after another. All from one seed: other seeds draw other objects of the same kinds, and other grasps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include "server/base/random.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/superquadric.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::benchmark {

inline constexpr std::uint64_t kDefaultSeed = 1;
inline constexpr std::size_t kDefaultTriangles = 8108;  ///< of the five objects of the default seed
inline constexpr std::size_t kSceneObjects = 5;

using hand::kFingers;
inline constexpr std::size_t kSegments = hand::kHandSegments;
inline constexpr std::size_t kJoints = hand::kPhalanges;
inline constexpr std::size_t kSegmentPoints = 128;
inline constexpr std::size_t kHandPoints = kSegments * kSegmentPoints;
inline constexpr std::size_t kClusterPoints = 16;
inline constexpr std::size_t kSegmentClusters = kSegmentPoints / kClusterPoints;
inline constexpr std::size_t kQuads = kHandPoints / 4;  ///< four points of a cluster, with a sphere of their own
inline constexpr std::size_t kClusters = kSegments * kSegmentClusters;

struct SceneObject {
  std::string name;
  geometry::Mesh mesh_O;
  geometry::Mesh skin_O;                     ///< the surface without the seams inside; empty: mesh_O has none
  std::vector<geometry::NamedMesh> parts_O;  ///< as the author gave them; empty: the mesh is to be decomposed
  double max_error_m = 1;                    ///< of our maps; 1: a share of the diagonal alone counts
  double probe_depth_m = 0;                  ///< how deep a hand presses, at most
  Pose X_WO;
  double diagonal_m = 0;       ///< of the mesh's bounding box: what errors are a share of
  Eigen::AlignedBox3f box_O;   ///< of the mesh
  geometry::Sphere bound_O;    ///< around the mesh
  Eigen::Matrix3f R_OW;        ///< X_WO's inverse, as the queries use it
  Vec3f p_OW = Vec3f::Zero();  ///< the same
};

/// One rigid piece of the hand, in its own frame S.
struct Segment {
  geometry::Superquadric shape;
  geometry::Mesh mesh_S;  ///< of as many vertices as there are samples: what a mesh library collides
  std::vector<Vec3f> samples_S;
  std::array<geometry::Sphere, kSegmentClusters> clusters_S;
  std::array<geometry::Sphere, kSegmentPoints / 4> quads_S;
  geometry::Sphere bound_S;
};

using HandModel = std::array<Segment, kSegments>;
using HandPose = std::array<Pose, kSegments>;  ///< X_WS of each segment

/// The hand as every method gets it: points of W and the spheres around them, structure of arrays.
struct alignas(64) HandStep {
  std::array<float, kHandPoints> x, y, z;
  // A kernel may read 16 spheres where 8 are left.
  std::array<float, kClusters + 16> cluster_x, cluster_y, cluster_z, cluster_r;
  std::array<float, kQuads> quad_x, quad_y, quad_z, quad_r;
  std::array<float, kSegments> segment_x, segment_y, segment_z, segment_r;
  std::array<std::array<float, kSegments>, 9> segment_R;  ///< of their rotations, row after row
  Vec3f center = Vec3f::Zero();                           ///< of a sphere around all
  float radius = 0;
  HandPose X_WS;
};

/// As our query wants them.
[[nodiscard]] std::array<const float*, 9> rotations_of(const HandStep& hand);

struct Scene {
  std::uint64_t seed = kDefaultSeed;
  std::vector<SceneObject> objects;
  HandModel hand;
  std::vector<HandPose> steps;
  std::vector<std::size_t> grasped;  ///< of each step: the object that is being grasped

  /// The hand in W at that step.
  void fill(std::size_t step, HandStep& out) const;
};

/// An object with all that follows from its mesh and its place. The mesh must not be empty.
[[nodiscard]] SceneObject make_scene_object(std::string name, geometry::Mesh mesh_O, const Pose& X_WO);

/// The five objects, side by side on a table. Closed, of positive volume, and of 8108 triangles for the default seed: asserted.
[[nodiscard]] std::vector<SceneObject> make_objects(std::uint64_t seed);

[[nodiscard]] HandModel make_hand();

/// How far each finger is bent at each of its joints, radians, from the knuckle on.
using Bends = std::array<std::array<double, kJoints>, kFingers>;

/// X_WS of all segments.
[[nodiscard]] HandPose hand_pose(const Pose& X_WPalm, const Bends& bent_rad);

/// Objects, hand and `steps` steps: for each object the palm comes, the fingers close around it, press and play, open, and the palm
/// leaves. How far they go is measured against the meshes, so that they press some tenths of a per cent of the diagonal into the object.
[[nodiscard]] Scene make_scene(std::uint64_t seed, std::size_t steps);

/// One object, of its true size, grasped at `grasps` places of its surface in turn, `steps` steps in all.
[[nodiscard]] Scene make_scene_of(SceneObject object, std::uint64_t seed, std::size_t grasps, std::size_t steps);

}  // namespace mechane::benchmark
