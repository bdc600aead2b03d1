#include "server/geometry/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "server/geometry/fit_solver.hpp"
#include "server/geometry/fit_starts.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr std::size_t kScreenPoints = 100;
constexpr std::size_t kMiddlePoints = 400;
constexpr std::size_t kRunnersUp = 4;  // that go on from the short runs
constexpr std::size_t kFinalists = 2;
constexpr double kTrimmed = 0.2;      // of the points, when robust, for the moments that give the starts
constexpr double kFarthest = 0.1;     // of the diagonal: a point farther off says no more than that it is far
constexpr double kLeastScale = 3e-4;  // of the loss, of the diagonal
constexpr double kGoodEnough = 0.002;  // mean error, of the diagonal: then taper and bend are not tried

struct Attempt {
  FitStart start;
  double score = 0;  // mean distance of the points to the surface
};

/// The spread of distances if most are Gaussian, from their median.
double spread_of(std::vector<double> distances) {
  for (double& d : distances)
    d = std::abs(d);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::max(kLeastScale, 1.4826 * *middle);
}

double score_of(const FitState& state, std::span<const Vec3> points) {
  if (!is_valid(state.shape())) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const double d : distances(state, points))
    sum += std::min(kFarthest, std::abs(d));
  return sum / static_cast<double>(points.size());
}

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

std::vector<Vec3> every_nth(std::span<const Vec3> points, std::size_t wanted) {
  std::vector<Vec3> chosen;
  const std::size_t step = std::max<std::size_t>(1, points.size() / wanted);
  for (std::size_t i = 0; i < points.size(); i += step)
    chosen.push_back(points[i]);
  return chosen;
}

/// Improves in rounds; each takes the spread of the distances anew.
int improve_in_rounds(Attempt& attempt, std::span<const Vec3> points, Loss loss, int rounds, int iterations) {
  int took = 0;
  for (int round = 0; round < rounds; ++round) {
    ImproveConfig config{iterations, attempt.start.deformed, loss, 1};
    if (loss != Loss::square) config.scale = spread_of(distances(attempt.start.state, points));
    took += improve(attempt.start.state, points, config);
  }
  attempt.score = score_of(attempt.start.state, points);
  return took;
}

void keep_best(std::vector<Attempt>& attempts, std::size_t count) {
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& l, const Attempt& r) { return l.score < r.score; });
  if (attempts.size() > count) attempts.resize(count);
}

/// Short runs from every start on few points; the best few go on with more.
Attempt best_of(std::span<const Vec3> points, bool deformed, const FitConfig& config, int& iterations) {
  const std::vector<Vec3> few = every_nth(points, kScreenPoints);
  const std::vector<Vec3> middle = every_nth(points, kMiddlePoints);
  std::vector<Attempt> attempts;
  for (FitStart& start : fit_starts(points, deformed, config.robust ? kTrimmed : 0)) {
    Attempt attempt{std::move(start)};
    iterations += improve_in_rounds(attempt, few, Loss::huber, 2, 5);
    attempts.push_back(std::move(attempt));
  }
  keep_best(attempts, kRunnersUp);
  for (Attempt& attempt : attempts)
    iterations += improve_in_rounds(attempt, middle, Loss::huber, 2, 6);
  keep_best(attempts, kFinalists);
  for (Attempt& attempt : attempts)
    iterations += improve_in_rounds(attempt, points, config.robust ? Loss::tukey : Loss::square, 2, 6);
  keep_best(attempts, 1);
  return attempts.front();
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

FitResult make_result(const Attempt& attempt, std::span<const Vec3> points, const Vec3& shift, double scale,
                      int iterations) {
  FitResult result;
  const FitState& state = attempt.start.state;
  result.shape = state.shape();
  result.shape.a *= scale;
  result.shape.bend_per_m /= scale;
  result.X_OQ = state.X_OQ;
  result.X_OQ.p = scale * result.X_OQ.p + shift;
  const FitErrors errors = fit_errors(distances(state, points));  // the points' diagonal is 1
  result.report.mean_pct = 100 * errors.mean;
  result.report.rms_pct = 100 * errors.rms;
  result.report.max_pct = 100 * errors.max;
  result.report.iterations = iterations;
  result.report.start = attempt.start.name;
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

  int iterations = 0;
  const Attempt rigid = best_of(points, false, config, iterations);
  std::optional<Attempt> deformed;
  if (config.deformations && rigid.score > kGoodEnough) deformed = best_of(points, true, config, iterations);

  std::vector<Vec3> all(points_O.begin(), points_O.end());
  all.insert(all.end(), also_bound_O.begin(), also_bound_O.end());
  if (deformed && deformed->score < (1 - config.deformation_gain) * rigid.score && deformed->score > 0) {
    FitResult result = make_result(*deformed, points, center, diagonal, iterations);
    if (!config.bound || bound(result, all)) return result;
  }
  FitResult result = make_result(rigid, points, center, diagonal, iterations);
  if (config.bound && !bound(result, all)) {
    return fail("no superquadric of sensible size bounds the part", "points of the part",
                "split the part where it is concave, or check it for stray vertices");
  }
  return result;
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
