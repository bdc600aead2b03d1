#include "server/geometry/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "server/geometry/fit_solver.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::geometry {
namespace {

constexpr std::size_t kScreenPoints = 120;
constexpr int kScreenIterations = 10;
constexpr int kFullIterations = 60;
constexpr std::size_t kFinalists = 3;
constexpr double kGoodEnough = 0.002;  // mean error, of the diagonal: then taper and bend are not tried
constexpr double kSlightBend = 0.2;    // per diagonal
constexpr double kStrongBend = 1.0;
// Exponents to start from: round, cylinder, box, and a section with corners under a round profile.
constexpr std::array<std::array<double, 2>, 4> kExponentStarts = {{{1, 1}, {0.3, 1}, {0.3, 0.3}, {1, 0.3}}};

/// A frame to start from, and the points' half extents in it.
struct StartFrame {
  Mat3 R_OQ;
  Vec3 p_OQ;
  Vec3 half;
};

struct Attempt {
  FitState state;
  double score = 0;  // mean distance of the points to the surface
  std::string name;
};

StartFrame start_frame(std::span<const Vec3> points, const Mat3& axes, int z_axis) {
  StartFrame frame;
  // The chosen axis becomes z, in cyclic order, so that the frame stays right-handed.
  for (int i = 0; i < 3; ++i)
    frame.R_OQ.col(i) = axes.col((z_axis + 1 + i) % 3);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points)
    box.extend(Vec3(frame.R_OQ.transpose() * p));
  frame.p_OQ = frame.R_OQ * box.center();
  frame.half = 0.5 * box.sizes();
  return frame;
}

/// The principal axes of the points; right-handed.
Mat3 principal_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points)
    mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points)
    covariance += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  Mat3 axes = solver.eigenvectors();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
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
  const StartFrame frame = start_frame(points, principal_axes(points), 2);
  if (frame.half.minCoeff() < 1e-4 * frame.half.maxCoeff()) {
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

std::string start_name(const char* frame, int z_axis, const std::array<double, 2>& e) {
  const auto one_digit = [](double v) { return std::to_string(v).substr(0, 3); };
  return std::string(frame) + " frame, axis " + std::to_string(z_axis) + " as z, e1 " + one_digit(e[0]) + ", e2 " +
         one_digit(e[1]);
}

void keep_best(std::vector<Attempt>& attempts) {
  std::stable_sort(attempts.begin(), attempts.end(),
                   [](const Attempt& l, const Attempt& r) { return l.score < r.score; });
  if (attempts.size() > kFinalists) attempts.erase(attempts.begin() + kFinalists, attempts.end());
}

/// Short runs from every start on few points; the best few go on.
std::vector<Attempt> screen(std::span<const Vec3> points, int& iterations) {
  const std::vector<Vec3> few = every_nth(points, kScreenPoints);
  const std::array<std::pair<const char*, Mat3>, 2> frames = {
      {{"inertia", principal_axes(points)}, {"given", Mat3::Identity()}}};
  std::vector<Attempt> attempts;
  for (const auto& [name, axes] : frames) {
    for (int z_axis = 0; z_axis < 3; ++z_axis) {
      for (const auto& e : kExponentStarts) {
        const StartFrame start = start_frame(points, axes, z_axis);
        Attempt attempt;
        attempt.state = FitState::start({start.p_OQ, Quat(start.R_OQ)}, start.half, e[0], e[1]);
        iterations += improve(attempt.state, few, kScreenIterations, false);
        attempt.score = fit_errors(attempt.state, few).mean;
        attempt.name = start_name(name, z_axis, e);
        attempts.push_back(std::move(attempt));
      }
    }
  }
  keep_best(attempts);
  return attempts;
}

Attempt best_rigid(std::span<const Vec3> points, int& iterations) {
  std::vector<Attempt> finalists = screen(points, iterations);
  for (Attempt& attempt : finalists) {
    iterations += improve(attempt.state, points, kFullIterations, false);
    attempt.score = fit_errors(attempt.state, points).mean;
  }
  return *std::min_element(finalists.begin(), finalists.end(),
                           [](const Attempt& l, const Attempt& r) { return l.score < r.score; });
}

/// Taper and bend run along z, and the rigid fit's z need not be that axis: short runs from each axis and direction of bending, and from
/// the rigid fit itself; the best few go on. At exactly k = 0 a bend's direction has no derivative, so each starts with one.
std::optional<Attempt> best_deformed(const Attempt& rigid, std::span<const Vec3> points, int& iterations) {
  const std::vector<Vec3> few = every_nth(points, kScreenPoints);
  const Mat3 axes = principal_axes(points);
  std::vector<Attempt> attempts;
  const auto try_from = [&](const Attempt& attempt, double bend) {
    for (int direction = 0; direction < 4; ++direction) {
      Attempt bent = attempt;
      bent.state.begin_deformation(bend, 0.5 * kPi * direction);
      iterations += improve(bent.state, few, kScreenIterations, true);
      bent.score = fit_errors(bent.state, few).mean;
      if (std::isfinite(bent.score)) attempts.push_back(std::move(bent));
    }
  };
  try_from(rigid, kSlightBend);
  for (int z_axis = 0; z_axis < 3; ++z_axis) {
    const StartFrame start = start_frame(points, axes, z_axis);
    Attempt attempt;
    attempt.state = FitState::start({start.p_OQ, Quat(start.R_OQ)}, start.half, 0.4, 0.5);
    attempt.name = start_name("inertia", z_axis, {0.4, 0.5});
    try_from(attempt, kStrongBend);
  }
  keep_best(attempts);
  std::optional<Attempt> best;
  for (Attempt& attempt : attempts) {
    iterations += improve(attempt.state, points, kFullIterations, true);
    attempt.score = fit_errors(attempt.state, points).mean;
    if (std::isfinite(attempt.score) && (!best || attempt.score < best->score)) best = std::move(attempt);
  }
  return best;
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
  result.shape = attempt.state.shape();
  result.shape.a *= scale;
  result.shape.bend_per_m /= scale;
  result.X_OQ = attempt.state.pose();
  result.X_OQ.p = scale * result.X_OQ.p + shift;
  const FitErrors errors = fit_errors(attempt.state, points);  // the points' diagonal is 1
  result.report.mean_pct = 100 * errors.mean;
  result.report.rms_pct = 100 * errors.rms;
  result.report.max_pct = 100 * errors.max;
  result.report.iterations = iterations;
  result.report.start = attempt.name;
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
  const Attempt rigid = best_rigid(points, iterations);
  std::optional<Attempt> deformed;
  if (config.deformations && rigid.score > kGoodEnough) deformed = best_deformed(rigid, points, iterations);

  std::vector<Vec3> all(points_O.begin(), points_O.end());
  all.insert(all.end(), also_bound_O.begin(), also_bound_O.end());
  if (deformed && deformed->score < (1 - config.deformation_gain) * rigid.score && deformed->score > 0) {
    FitResult result = make_result(*deformed, points, center, diagonal, iterations);
    if (bound(result, all)) return result;
  }
  FitResult result = make_result(rigid, points, center, diagonal, iterations);
  if (!bound(result, all)) {
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
