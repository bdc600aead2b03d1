#include "server/geometry/fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "server/geometry/fit_search.hpp"
#include "server/geometry/fit_solver.hpp"
#include "server/geometry/fit_starts.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

Expected<void> check_points(std::span<const Vec3> points) {
  const char* where = "points of the part";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite() && points[i].cwiseAbs().maxCoeff() <= 1000) continue;
    return fail("point " + std::to_string(i) + " is not a finite point within 1000 m", where,
                "check the model's units and modifiers, and export it again");
  }
  if (points.size() < 12) {
    return fail("a superquadric has 11 parameters and there are only " + std::to_string(points.size()) + " points",
                where, "give the whole surface of the part");
  }
  const Moments moments = moments_of(points, 0);
  if (!(moments.variance.x() > 1e-8 * moments.variance.z())) {
    return fail("the points lie on a plane, a line or one spot", where, "give the part a thickness");
  }
  return {};
}

/// Scales the semi-axes until F <= 1 at every point. Without deformation one step is exact; with it the taper and the bend see the
/// longer axes, so it goes on until it holds. False when it does not settle.
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

FitResult make_result(const FoundFit& found, std::span<const Vec3> points, const Vec3& shift, double scale,
                      int iterations) {
  FitResult result;
  result.shape = found.state.shape();
  result.shape.a *= scale;
  result.shape.bend_per_m /= scale;
  result.X_OQ = found.state.X_OQ;
  result.X_OQ.p = scale * result.X_OQ.p + shift;
  const FitErrors errors = fit_errors(distances(found.state, points));  // the points' diagonal is 1
  result.report.mean_pct = 100 * errors.mean;
  result.report.rms_pct = 100 * errors.rms;
  result.report.max_pct = 100 * errors.max;
  result.report.iterations = iterations;
  result.report.start = found.start;
  result.report.deformed = is_deformed(result.shape);
  return result;
}

/// Fits `points`, bounds `points` and `also_bound`.
Expected<FitResult> fit(std::span<const Vec3> points_O, std::span<const Vec3> also_bound_O, const FitConfig& config) {
  if (auto ok = check_points(points_O); !ok) return tl::unexpected(ok.error());
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points_O)
    box.extend(p);
  const double diagonal = box.diagonal().norm();
  const Vec3 center = box.center();
  // Unit diagonal: the solver's tolerances and the parameters are then of one size for a peg and for a crane.
  std::vector<Vec3> points;
  for (const Vec3& p : points_O)
    points.push_back((p - center) / diagonal);

  const SearchResult found = search_fit(points, config);
  std::vector<Vec3> all(points_O.begin(), points_O.end());
  all.insert(all.end(), also_bound_O.begin(), also_bound_O.end());
  for (const FoundFit& choice : {found.best, found.rigid}) {
    FitResult result = make_result(choice, points, center, diagonal, found.iterations);
    if (!config.bound || bound(result, all)) return result;
  }
  return fail("no superquadric of sensible size bounds the part", "points of the part",
              "split the part where it is concave, or check it for stray vertices");
}

}  // namespace

Expected<FitResult> fit_superquadric(std::span<const Vec3> points_O, const FitConfig& config) {
  return fit(points_O, {}, config);
}

Expected<FitResult> fit_superquadric(const Mesh& mesh, const FitConfig& config) {
  if (auto ok = check_mesh(mesh, "mesh"); !ok) return tl::unexpected(ok.error());
  std::vector<Vec3> points;
  for (const SurfaceSample& sample : sample_by_area(mesh, config.samples, config.seed))
    points.push_back(sample.p);
  return fit(points, mesh.vertices, config);
}

}  // namespace mechane::geometry
