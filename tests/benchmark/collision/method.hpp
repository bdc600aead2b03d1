// What every way of asking answers: the hand's points in, depth and normal out. The culling that all share is in culling.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "server/collision/object.hpp"
#include "tests/benchmark/collision/scene.hpp"

namespace mechane::benchmark {

/// The hand's points that lie inside an object, each once, in any order. Structure of arrays with room behind the last hit, so that a
/// kernel may store whole vectors.
struct alignas(64) Hits {
  static constexpr std::size_t kRoom = kHandPoints + 16;

  std::size_t count = 0;
  alignas(64) std::array<std::uint32_t, kRoom> point;  ///< into HandStep::x
  alignas(64) std::array<float, kRoom> depth_m, n_x, n_y,
      n_z;                                             ///< depth > 0; outward unit normal of the object's surface, in W
  alignas(64) std::array<std::uint8_t, kRoom> object;  ///< into Scene::objects

  void add(std::size_t point_index, std::size_t object_index, float depth, const Vec3f& n_W) noexcept {
    if (count >= kHandPoints) return;
    point[count] = static_cast<std::uint32_t>(point_index);
    object[count] = static_cast<std::uint8_t>(object_index);
    depth_m[count] = depth;
    n_x[count] = n_W.x();
    n_y[count] = n_W.y();
    n_z[count] = n_W.z();
    ++count;
  }
};

/// The representation of one of our parts.
struct MapShare {
  std::size_t object = 0;
  std::string name;
  bool radial = false;
  std::size_t bytes = 0;
};

/// One way of asking, ready to be asked: built from a scene, which must outlive it.
class Method {
 public:
  Method() = default;
  virtual ~Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  /// As in the metrics: sqmap, brick, openvdb...
  [[nodiscard]] virtual std::string name() const = 0;
  /// Of everything that a query reads, all objects together.
  [[nodiscard]] virtual std::size_t bytes() const {
    const std::vector<std::size_t> bytes = bytes_by_object();
    return std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
  }
  /// The same object by object; empty where only bytes() counts.
  [[nodiscard]] virtual std::vector<std::size_t> bytes_by_object() const { return {}; }
  [[nodiscard]] virtual double build_s() const = 0;
  /// All hand points against all objects. `out` comes empty. What gives no depth of points leaves it empty.
  virtual void step(const HandStep& hand, Hits& out) = 0;

  /// False for what collides meshes and returns their contacts.
  [[nodiscard]] virtual bool answers_points() const { return true; }
  /// Cells along the longest side of each object's grid; empty for what has none.
  [[nodiscard]] virtual std::vector<int> cells() const { return {}; }
  /// What our parts are kept in; empty for the others.
  [[nodiscard]] virtual std::vector<MapShare> maps() const { return {}; }
  /// Whatever else is worth a metric of its own, by its whole name.
  [[nodiscard]] virtual std::vector<std::pair<std::string, double>> extra_metrics() const { return {}; }
  /// What the mesh methods found, the mean of all steps so far.
  [[nodiscard]] virtual double mesh_contacts_per_step() const { return 0; }
};

/// A known answer, for the choice of a grid's resolution.
struct KnownPoint {
  Vec3f p_O = Vec3f::Zero();
  double distance_m = 0;  ///< exact, negative inside
};

/// How fine the grids must be: for each object, points with their exact distance and the error that is allowed at their 99th percentile.
struct Accuracy {
  std::array<std::vector<KnownPoint>, kSceneObjects> points;
  std::array<double, kSceneObjects> p99_m{};
};

using MethodPtr = std::unique_ptr<Method>;

enum class Simd { best, scalar };

/// How our builder goes about it: as it is; without bricks; with boxes in place of the superquadrics; with fields.
enum class OurMaps { any, radial_only, boxes, fields };

inline constexpr double kOurErrorShare = 0.003;

/// What it made of the scene's objects. Several methods may ask the same.
struct OurObjects {
  std::vector<collision::Object> objects;
  double build_s = 0;
};

/// `error_share`: of an object's diagonal, what the 99th percentile of a depth's error may be; what counts as missed follows.
[[nodiscard]] std::shared_ptr<const OurObjects> build_ours(const Scene& scene, OurMaps maps,
                                                           double error_share = kOurErrorShare);

/// Whether our query remembers what is near (collision::NearList).
enum class NearLists { none, used };

MethodPtr make_sqmap(const Scene& scene, const std::string& name, std::shared_ptr<const OurObjects> built,
                     collision::InstructionSet set, NearLists lists = NearLists::none);
/// Fields among so many objects: the first is the scene's, and so on; those beyond the scene's are copies, side by side far off.
MethodPtr make_crowd(const Scene& scene, const std::string& name, std::shared_ptr<const OurObjects> built,
                     std::size_t objects);
/// 'paper': the depth as published; 'paper_along': along the normal (see collision::PaperDepth).
MethodPtr make_paper(const Scene& scene, const std::string& name, const OurObjects& built);
MethodPtr make_brick(const Scene& scene, const Accuracy& accuracy, Simd simd, NearLists lists = NearLists::none);
MethodPtr make_openvdb(const Scene& scene, const Accuracy& accuracy);
MethodPtr make_bt_sdf(const Scene& scene, const Accuracy& accuracy);
MethodPtr make_embree(const Scene& scene);
MethodPtr make_fcl_contacts(const Scene& scene);
MethodPtr make_fcl_yesno(const Scene& scene);
MethodPtr make_fcl_gjk(const Scene& scene);

/// The paper's Figure 4: the distance map of two spheres in an ellipsoid that bounds them, mm, coarse; from the north pole down, omega
/// from -pi on; NaN: no hit. Not in the superquadric that fits best: that is boxy, and the even grid jumps over the waist.
std::vector<std::vector<double>> paper_picture(const Scene& scene);

}  // namespace mechane::benchmark
