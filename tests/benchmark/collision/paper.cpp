// The paper's method: superquadric parts with a distance map each, a sphere around each part, a pyramid search for each point.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "server/base/assert.hpp"
#include "server/collision/samples.hpp"
#include "server/geometry/fitting/fit.hpp"
#include "tests/benchmark/collision/culling.hpp"
#include "tests/benchmark/collision/method.hpp"
#include "tests/benchmark/collision/resolution.hpp"
#include "tests/benchmark/paper_map/paper_map.hpp"

namespace mechane::benchmark {
namespace {

/// A part's map and the ways between its frame and the others.
struct PaperPart {
  PaperMap map;
  Eigen::Matrix3f R_QW;
  Vec3f p_QW;
  Vec3f center_O;  // of the sphere around the superquadric
  float radius = 0;

  [[nodiscard]] bool reaches(const Vec3f& c_O, float r) const noexcept {
    const float sum = r + radius;
    return (c_O - center_O).squaredNorm() <= sum * sum;
  }
};

PaperPart place_part(const collision::Part& part, const geometry::MeshQuery& query, const SceneObject& object) {
  const Pose X_QW = (object.X_WO * part.X_OQ).inverse();
  PaperPart placed{cast_paper_map({query}, part.superquadric, part.X_OQ), X_QW.R.toRotationMatrix().cast<float>(),
                   X_QW.p.cast<float>(), Vec3f::Zero(), 0};
  const PaperGrid& grid = placed.map.grid();
  std::vector<Vec3> surface_O;
  for (int i = 0; i < grid.eta * grid.omega; ++i)
    surface_O.push_back(
        part.X_OQ * geometry::surface_point(part.superquadric, PaperMap::angles(grid, i / grid.omega, i % grid.omega)));
  const geometry::Sphere bound_O = collision::bounding_sphere(surface_O);
  placed.center_O = bound_O.center.cast<float>();
  placed.radius = static_cast<float>(1.001 * bound_O.radius);
  return placed;
}

class Paper final : public Method {
 public:
  /// Of our builder's parts it takes the superquadrics alone.
  Paper(const Scene& scene, std::string name, const OurObjects& built, PaperDepth depth)
      : scene_(scene), name_(std::move(name)), how_{PaperWindow::corrected, depth} {
    const Stopwatch watch;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
      const geometry::MeshQuery query(scene.objects[k].mesh_O);
      auto& parts = objects_.emplace_back();
      for (const collision::Part& part : built.objects[k].parts)
        parts.push_back(place_part(part, query, scene.objects[k]));
    }
    build_s_ = built.build_s + watch.seconds();
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::size_t bytes() const override {
    std::size_t sum = 0;
    for (const auto& parts : objects_)
      for (const PaperPart& part : parts)
        sum += part.map.bytes() + sizeof(part) - sizeof(part.map);
    return sum;
  }
  [[nodiscard]] double build_s() const override { return build_s_; }
  [[nodiscard]] std::vector<std::pair<std::string, double>> extra_metrics() const override {
    std::size_t parts = 0;
    for (const auto& object : objects_)
      parts += object.size();
    return {{"parts." + name_, static_cast<double>(parts)},
            {"evaluations_per_search." + name_, 8.0 * objects_.front().front().map.levels() + 1}};
  }

  void step(const HandStep& hand, Hits& out) override {
    for (std::size_t k = 0; k < objects_.size(); ++k) {
      visit_near_clusters(hand, scene_.objects[k], [&](std::size_t cluster, const Vec3f& c_O, float radius) {
        query_cluster(k, cluster, c_O, radius, hand, out);
      });
    }
  }

 private:
  /// Of several parts that hold a point the one out of which the way is shortest speaks: each looks along its own normal only.
  void query_cluster(std::size_t k, std::size_t cluster, const Vec3f& c_O, float radius, const HandStep& hand,
                     Hits& out) const {
    std::array<float, kClusterPoints> depth_m;
    depth_m.fill(std::numeric_limits<float>::infinity());
    std::array<Vec3f, kClusterPoints> n_W;
    const std::size_t first = cluster * kClusterPoints;
    for (const PaperPart& part : objects_[k]) {
      if (!part.reaches(c_O, radius)) continue;
      for (std::size_t i = 0; i < kClusterPoints; ++i) {
        const Vec3f p_W(hand.x[first + i], hand.y[first + i], hand.z[first + i]);
        const collision::MapHit hit = part.map.search(part.R_QW * p_W + part.p_QW, how_).hit;
        if (!hit.hit || hit.depth_m >= depth_m[i]) continue;
        depth_m[i] = hit.depth_m;
        n_W[i] = part.R_QW.transpose() * hit.n_Q;
      }
    }
    for (std::size_t i = 0; i < kClusterPoints; ++i)
      if (std::isfinite(depth_m[i])) out.add(first + i, k, depth_m[i], n_W[i]);
  }

  const Scene& scene_;
  std::string name_;
  PaperSearch how_;
  double build_s_ = 0;
  std::vector<std::vector<PaperPart>> objects_;
};

}  // namespace

MethodPtr make_paper(const Scene& scene, const std::string& name, const OurObjects& built) {
  const bool published = name == "paper";
  return std::make_unique<Paper>(scene, name, built, published ? PaperDepth::distance : PaperDepth::along_normal);
}

std::vector<std::vector<double>> paper_picture(const Scene& scene) {
  const geometry::Mesh& spheres_O = scene.objects[1].mesh_O;
  const auto fit = geometry::fit_superquadric(spheres_O);
  MECHANE_ASSERT(fit.has_value());
  geometry::Superquadric ellipsoid;
  ellipsoid.a = fit->shape.a;
  double largest = 0;
  for (const Vec3& v : spheres_O.vertices)
    largest = std::max(largest, geometry::radial_form(ellipsoid, fit->X_OQ.inverse() * v));
  ellipsoid.a *= largest;
  const geometry::MeshQuery query(spheres_O);
  const PaperGrid grid{50, 100};
  const PaperMap map = cast_paper_map({query}, ellipsoid, fit->X_OQ, grid);
  std::vector<std::vector<double>> rows_mm;
  for (int eta = grid.eta - 1; eta >= 0; --eta) {
    auto& row = rows_mm.emplace_back();
    for (int omega = 0; omega < grid.omega; ++omega) {
      const auto distance_m = map.distance_m(eta, omega);
      row.push_back(distance_m ? std::round(1e5 * static_cast<double>(*distance_m)) / 100
                               : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return rows_mm;
}

}  // namespace mechane::benchmark
