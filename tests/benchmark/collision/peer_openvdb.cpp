// OpenVDB: a narrow-band level set of each object, read with a box stencil: trilinear value, analytic gradient.
#include <algorithm>
#include <cmath>

#include <openvdb/math/Stencils.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"

namespace mechane::benchmark {
namespace {

using Grid = openvdb::FloatGrid;
using Stencil = openvdb::math::BoxStencil<Grid, false>;

constexpr double kDeepest = 0.025;  // of the diagonal: the band inside reaches as deep as a hand presses

struct Level {
  Grid::Ptr grid;
  float voxel_m = 1;
  Vec3f origin_O =
      Vec3f::Zero();  // of index space: all indices are positive, or the tree would have a branch for each octant

  [[nodiscard]] Vec3f index(const Vec3f& p_O) const { return (p_O - origin_O) / voxel_m; }
};

/// `farthest_m`: how far out of the object the grid must know distances.
Level make_level(const SceneObject& object, float farthest_m, int cells) {
  Level level;
  const double voxel = object.mesh_O.bounds().sizes().maxCoeff() / cells;
  level.voxel_m = static_cast<float>(voxel);
  // One voxel more on each side, for the corners of the stencil.
  const float out = std::max(3.0F, farthest_m / level.voxel_m + 1);
  const float in = std::max(3.0F, static_cast<float>(kDeepest * object.diagonal_m) / level.voxel_m + 1);
  // By whole voxels, so that a wider band moves no voxel against the mesh.
  level.origin_O = object.box_O.min() - Vec3f::Constant((std::ceil(out) + 2) * level.voxel_m);
  std::vector<openvdb::Vec3s> points;
  for (const Vec3& v : object.mesh_O.vertices) {
    const Vec3f p = level.index(v.cast<float>());
    points.emplace_back(p.x(), p.y(), p.z());
  }
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& t : object.mesh_O.triangles)
    triangles.emplace_back(t[0], t[1], t[2]);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points, triangles);
  level.grid =
      openvdb::tools::meshToVolume<Grid>(adapter, *openvdb::math::Transform::createLinearTransform(voxel), out, in);
  level.grid->pruneGrid();
  return level;
}

float value_at(Stencil& stencil, const Vec3f& index) {
  const openvdb::Vec3f p(index.x(), index.y(), index.z());
  stencil.moveTo(openvdb::Vec3d(p));
  return stencil.interpolation(p);
}

class OpenVdb final : public Method {
 public:
  OpenVdb(const Scene& scene, const Accuracy& accuracy) : scene_(scene) {
    openvdb::initialize();
    // A sphere of a cluster that is farther from the surface than its radius is culled: the band must reach that far.
    float farthest = 0;
    for (const Segment& segment : scene.hand)
      for (const geometry::Sphere& cluster : segment.clusters_S)
        farthest = std::max(farthest, static_cast<float>(cluster.radius));
    for (std::size_t k = 0; k < kSceneObjects; ++k) {
      const SceneObject& object = scene.objects[k];
      cells_.push_back(fewest_cells(accuracy.p99_m[k], [&](int cells) {
        const Level level = make_level(object, 0, cells);
        Stencil stencil(*level.grid);
        return p99_error_m(accuracy.points[k],
                           [&](const Vec3f& p_O) -> double { return value_at(stencil, level.index(p_O)); });
      }));
    }
    const Stopwatch watch;
    for (std::size_t k = 0; k < kSceneObjects; ++k)
      levels_.push_back(make_level(scene.objects[k], farthest, cells_[k]));
    build_s_ = watch.seconds();
    for (std::size_t k = 0; k < kSceneObjects; ++k)
      narrow_bytes_ += make_level(scene.objects[k], 0, cells_[k]).grid->memUsage();
    for (const Level& level : levels_)
      stencils_.emplace_back(*level.grid);
  }

  [[nodiscard]] std::string name() const override { return "openvdb"; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const Level& level : levels_)
      sum += level.grid->memUsage();
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] std::vector<int> cells() const override { return cells_; }
  /// The grids that are asked know distances outside, for culling. Without, they are as small as they get.
  [[nodiscard]] std::vector<std::pair<std::string, double>> extra_metrics() const override {
    return {{"bytes.openvdb_narrow", static_cast<double>(narrow_bytes_)}};
  }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      Stencil& stencil = stencils_[k];
      const Level& level = levels_[k];
      const Eigen::Matrix3f R_WO = object.R_OW.transpose();
      visit_near_clusters(hand, object, [&](std::size_t cluster, const Vec3f& c_O, float radius) {
        if (value_at(stencil, level.index(c_O)) > radius + 0.25F * level.voxel_m) return;
        for (std::size_t i = cluster * kClusterPoints; i < (cluster + 1) * kClusterPoints; ++i) {
          const Vec3f p = level.index(point_O(hand, object, i));
          const float distance = value_at(stencil, p);
          if (distance >= 0) continue;
          const auto g = stencil.gradient({p.x(), p.y(), p.z()});
          out.add(i, k, -distance, R_WO * Vec3f(g.x(), g.y(), g.z()).normalized());
        }
      });
    }
  }

 private:
  const Scene& scene_;
  double build_s_ = 0;
  std::size_t narrow_bytes_ = 0;
  std::vector<int> cells_;
  std::vector<Level> levels_;
  std::vector<Stencil> stencils_;
};

}  // namespace

MethodPtr make_openvdb(const Scene& scene, const Accuracy& accuracy) {
  return std::make_unique<OpenVdb>(scene, accuracy);
}

}  // namespace mechane::benchmark
