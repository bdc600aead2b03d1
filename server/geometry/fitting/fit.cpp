#include "server/geometry/fitting/fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "server/geometry/fitting/fit_noise.hpp"
#include "server/geometry/fitting/fit_search.hpp"
#include "server/geometry/fitting/fit_solver.hpp"
#include "server/geometry/fitting/fit_starts.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr int kHausdorffCells = 16;  // of an edge of the cube around the fit: 1536 places

Expected<void> check_points(std::span<const Vec3> points) {
  const char* where = "points of the part";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite() && points[i].cwiseAbs().maxCoeff() <= 1000) continue;
    return fail(ErrorCode::invalid_value, "point " + std::to_string(i) + " is not finite, or beyond 1000 m", where,
                "check the model's units and modifiers, and export it again");
  }
  if (points.size() < 12) {
    return fail(ErrorCode::missing,
                "a superquadric needs 12 points at least, and there are only " + std::to_string(points.size()), where,
                "give the whole surface of the part");
  }
  const Moments moments = moments_of(points, 0);
  if (!(moments.variance.x() > 1e-8 * moments.variance.z())) {
    return fail(ErrorCode::invalid_value, "the points lie on a plane, on a line or in one spot", where,
                "give the part a thickness");
  }
  return {};
}

/// Scales the semi-axes until F <= 1 at every point. Without deformation one step is exact; with it the taper and the bend see the
/// longer axes, so it is repeated until F <= 1. False when that does not settle.
bool bound(FitResult& fit, std::span<const Vec3> points_O) {
  const Pose X_QO = fit.X_OQ.inverse();
  const Vec3 before = fit.shape.a;
  for (int round = 0; round < 60; ++round) {
    double largest = 0;
    for (const Vec3& p : points_O)
      largest = std::max(largest, radial_form(fit.shape, X_QO * p));
    if (!std::isfinite(largest) || fit.shape.a.maxCoeff() > 4 * before.maxCoeff()) return false;
    if (round > 0 && largest <= 1) break;
    // The first round may shrink as well as grow.
    fit.shape.a *= largest * (1 + 1e-9) + (round > 8 ? 1e-3 : 0.0);
    if (!is_valid(fit.shape)) return false;
    if (round == 59) return false;
  }
  fit.report.bound_scale = fit.shape.a.x() / before.x();
  return true;
}

/// The points to fit, moved and scaled so that their middle is the origin and their diagonal 1. Then tolerances and parameters have the
/// same size for a peg and for a crane.
struct Task {
  std::vector<Vec3> points;
  Vec3 center;
  double diagonal;
  const Mesh* mesh;  // that the points come from; null for bare points
};

/// How far the fitted surface strays from the mesh or, without one, from the points; of the diagonal.
double farthest_of_surface(const FitState& state, const Task& task) {
  if (task.mesh == nullptr) return stray_of(state, task.points, 0).max;
  const MeshQuery query(*task.mesh);
  double farthest_m = 0;
  for (const Vec3& p : own_surface(state, kHausdorffCells).points_O)
    farthest_m = std::max(farthest_m, query.closest(task.center + task.diagonal * p).distance_m);
  return farthest_m / task.diagonal;
}

FitResult make_result(const FoundFit& found, const Task& task, int iterations) {
  FitResult result;
  result.shape = found.state.shape();
  result.shape.a *= task.diagonal;
  result.shape.bend_per_m /= task.diagonal;
  result.X_OQ = found.state.X_OQ;
  result.X_OQ.p = task.diagonal * result.X_OQ.p + task.center;
  const FitErrors errors = fit_errors(distances(found.state, task.points));
  result.report.mean_pct = 100 * errors.mean;
  result.report.rms_pct = 100 * errors.rms;
  result.report.max_pct = 100 * errors.max;
  result.report.hausdorff_pct = 100 * std::max(errors.max, farthest_of_surface(found.state, task));
  result.report.iterations = iterations;
  result.report.start = found.start;
  result.report.deformed = is_deformed(result.shape);
  return result;
}

/// Fits the points; the result bounds them and the mesh's vertices.
Expected<FitResult> fit(std::span<const Vec3> points_O, const Mesh* mesh, const FitConfig& config) {
  if (auto ok = check_points(points_O); !ok) return tl::unexpected(ok.error());
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points_O)
    box.extend(p);
  Task task{{}, box.center(), box.diagonal().norm(), mesh};
  task.points.reserve(points_O.size());
  for (const Vec3& p : points_O)
    task.points.push_back((p - task.center) / task.diagonal);

  const SearchResult found = search_fit(task.points, config);
  std::vector<Vec3> all(points_O.begin(), points_O.end());
  if (mesh != nullptr) all.insert(all.end(), mesh->vertices.begin(), mesh->vertices.end());
  for (const FoundFit& choice : {found.best, found.rigid}) {
    if (!is_valid(choice.state.shape())) continue;
    FitResult result = make_result(choice, task, found.iterations);
    if (!config.bound || bound(result, all)) return result;
  }
  return fail(ErrorCode::not_supported,
              "no superquadric of sensible size " + std::string(config.bound ? "bounds" : "fits") + " the part",
              "points of the part", "split the part where it is concave, or check it for stray vertices");
}

}  // namespace

Expected<FitResult> fit_superquadric(std::span<const Vec3> points_O, const FitConfig& config) {
  return fit(points_O, nullptr, config);
}

Expected<FitResult> fit_superquadric(const Mesh& mesh, const FitConfig& config) {
  if (auto ok = check_mesh(mesh, "mesh"); !ok) return tl::unexpected(ok.error());
  std::vector<Vec3> points;
  for (const SurfaceSample& sample : sample_by_area(mesh, config.samples, config.seed))
    points.push_back(sample.p);
  return fit(points, &mesh, config);
}

}  // namespace mechane::geometry
