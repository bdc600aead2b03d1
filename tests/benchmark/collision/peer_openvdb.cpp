// OpenVDB: a narrow-band level set of each object, read with a box stencil: trilinear value, analytic gradient.
#include <algorithm>

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

struct Mesh {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

Mesh vdb_mesh(const geometry::Mesh& from) {
  Mesh mesh;
  for (const Vec3& v : from.vertices)
    mesh.points.emplace_back(static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
  for (const auto& t : from.triangles)
    mesh.triangles.emplace_back(t[0], t[1], t[2]);
  return mesh;
}

/// Points come to it in index space, voxels from the grid's origin.
struct Level {
  Grid::Ptr grid;
  float voxel_m = 1;
  float outside_m = 0;  ///< how far out the band holds distances
};

Level make_level(const SceneObject& object, const Mesh& mesh, float farthest_m, int cells) {
  Level level;
  const double voxel = object.mesh_O.bounds().sizes().maxCoeff() / cells;
  level.voxel_m = static_cast<float>(voxel);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  std::vector<openvdb::Vec3s> points;
  for (const openvdb::Vec3s& p : mesh.points)
    points.push_back(p / level.voxel_m);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points, mesh.triangles);
  // One voxel more on each side, for the corners of the stencil.
  const float out = std::max(3.0F, farthest_m / level.voxel_m + 1);
  const float in = std::max(3.0F, static_cast<float>(kDeepest * object.diagonal_m) / level.voxel_m + 1);
  level.outside_m = farthest_m;
  level.grid = openvdb::tools::meshToVolume<Grid>(adapter, *transform, out, in);
  level.grid->pruneGrid();
  return level;
}

float value_at(Stencil& stencil, const openvdb::Vec3f& p) {
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
      const Mesh mesh = vdb_mesh(object.mesh_O);
      cells_.push_back(fewest_cells(accuracy.p99_m[k], [&](int cells) {
        const Level level = make_level(object, mesh, 0, cells);
        Stencil stencil(*level.grid);
        return p99_error_m(accuracy.points[k], [&](const Vec3f& p_O) -> double {
          const Vec3f p = p_O / level.voxel_m;
          return value_at(stencil, {p.x(), p.y(), p.z()});
        });
      }));
    }
    const Stopwatch watch;
    for (std::size_t k = 0; k < kSceneObjects; ++k)
      levels_.push_back(make_level(scene.objects[k], vdb_mesh(scene.objects[k].mesh_O), farthest, cells_[k]));
    build_s_ = watch.seconds();
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

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      const SceneObject& object = scene_.objects[k];
      Stencil& stencil = stencils_[k];
      const float scale = 1 / levels_[k].voxel_m;
      const Eigen::Matrix3f R_WO = object.R_OW.transpose();
      visit_near_clusters(hand, object, [&](std::size_t cluster, const Vec3f& c_O, float radius) {
        const Vec3f c = scale * c_O;
        if (value_at(stencil, {c.x(), c.y(), c.z()}) > radius + 0.25F * levels_[k].voxel_m) return;
        for (std::size_t i = cluster * kClusterPoints; i < (cluster + 1) * kClusterPoints; ++i) {
          const Vec3f q = scale * point_O(hand, object, i);
          const openvdb::Vec3f p(q.x(), q.y(), q.z());
          const float distance = value_at(stencil, p);
          if (distance >= 0) continue;
          const auto g = stencil.gradient(p);
          out.add(i, k, -distance, R_WO * Vec3f(g.x(), g.y(), g.z()).normalized());
        }
      });
    }
  }

 private:
  const Scene& scene_;
  double build_s_ = 0;
  std::vector<int> cells_;
  std::vector<Level> levels_;
  std::vector<Stencil> stencils_;
};

}  // namespace

MethodPtr make_openvdb(const Scene& scene, const Accuracy& accuracy) {
  return std::make_unique<OpenVdb>(scene, accuracy);
}

}  // namespace mechane::benchmark
