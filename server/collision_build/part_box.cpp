#include "server/collision_build/part_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

namespace mechane::collision_build {
namespace {

constexpr int kTurns = 45;  // of a quarter circle
constexpr int kRounds = 3;
constexpr double kLeastEdge = 1e-6;  // of the diagonal
constexpr int kFaceCells = 8;        // of each face, where the box's own distance is measured

/// Columns are the axes of Q in O; the box is low..high along them.
struct Box {
  Mat3 R_OQ = Mat3::Identity();
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  [[nodiscard]] double volume() const { return (high - low).prod(); }
};

Box box_in(const Mat3& R_OQ, std::span<const Vec3> points_O) {
  Box box{R_OQ, Vec3::Constant(std::numeric_limits<double>::infinity()),
          Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const Vec3& p_O : points_O) {
    const Vec3 p_Q = R_OQ.transpose() * p_O;
    box.low = box.low.cwiseMin(p_Q);
    box.high = box.high.cwiseMax(p_Q);
  }
  return box;
}

Mat3 principal_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points)
    mean += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points)
    spread += (p - mean) * (p - mean).transpose();
  Mat3 axes = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return axes;
}

Box turned_tight(const Mat3& start, std::span<const Vec3> points) {
  Box best = box_in(start, points);
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Mat3 from = best.R_OQ;
      for (int turn = 1; turn < kTurns; ++turn) {
        const double angle_rad = kPi / 2 * turn / kTurns;
        const Box tried =
            box_in(from * Eigen::AngleAxisd(angle_rad, Vec3(Vec3::Unit(axis))).toRotationMatrix(), points);
        if (tried.volume() < best.volume() * (1 - 1e-9)) best = tried;
      }
    }
  }
  return best;
}

/// The distance from a point in Q, whose origin is the box's middle, to the box's surface.
double distance_to_box(const Vec3& p, const Vec3& half) {
  const Vec3 beyond = p.cwiseAbs() - half;
  return beyond.maxCoeff() <= 0 ? -beyond.maxCoeff() : beyond.cwiseMax(0).norm();
}

/// How far the box's faces stray from the points.
double farthest_of_box(const Vec3& half, std::span<const Vec3> points_Q) {
  double farthest = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (int cell = 0; cell < 2 * (kFaceCells + 1) * (kFaceCells + 1); ++cell) {
      const int i = cell / 2;
      Vec3 at;
      at[axis] = cell % 2 == 0 ? -1 : 1;
      const int column = i % (kFaceCells + 1);
      const int row = i / (kFaceCells + 1);
      at[(axis + 1) % 3] = -1 + 2.0 * column / kFaceCells;
      at[(axis + 2) % 3] = -1 + 2.0 * row / kFaceCells;
      const Vec3 p = at.cwiseProduct(half);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& q : points_Q)
        nearest = std::min(nearest, (p - q).squaredNorm());
      farthest = std::max(farthest, nearest);
    }
  }
  return std::sqrt(farthest);
}

geometry::FitReport report_of(const Vec3& half, std::span<const Vec3> surface_points_Q, double diagonal_m) {
  geometry::FitReport report;
  report.start = "box";
  double squares = 0;
  for (const Vec3& p : surface_points_Q) {
    const double pct = 100 * distance_to_box(p, half) / diagonal_m;
    report.mean_pct += pct / static_cast<double>(surface_points_Q.size());
    squares += pct * pct / static_cast<double>(surface_points_Q.size());
    report.max_pct = std::max(report.max_pct, pct);
  }
  report.rms_pct = std::sqrt(squares);
  report.hausdorff_pct = report.max_pct;
  if (!surface_points_Q.empty())
    report.hausdorff_pct = std::max(report.max_pct, 100 * farthest_of_box(half, surface_points_Q) / diagonal_m);
  return report;
}

}  // namespace

Expected<geometry::FitResult> fit_box(std::span<const Vec3> bound_points_O, std::span<const Vec3> surface_points_O) {
  const Box own = box_in(Mat3::Identity(), bound_points_O);
  const Box principal = turned_tight(principal_axes(bound_points_O), bound_points_O);
  const Box straight = turned_tight(Mat3::Identity(), bound_points_O);
  const Box& best = straight.volume() <= principal.volume() ? straight : principal;
  const double diagonal_m = (own.high - own.low).norm();
  const Vec3 half = 0.5 * (best.high - best.low);
  if (!(half.minCoeff() > 0.5 * kLeastEdge * diagonal_m)) {
    return fail(ErrorCode::invalid_value, "its points lie on a plane or a line", "box of a part",
                "give it some thickness, or leave it out");
  }
  geometry::FitResult result;
  result.X_OQ = {best.R_OQ * (0.5 * (best.low + best.high)), Quat(best.R_OQ)};
  result.shape.a = half;
  result.shape.e1 = result.shape.e2 = geometry::kMinExponent;
  const Pose X_QO = result.X_OQ.inverse();
  double scale = 0;
  for (const Vec3& p_O : bound_points_O)
    scale = std::max(scale, geometry::radial_form(result.shape, X_QO * p_O));
  std::vector<Vec3> surface_points_Q;
  for (const Vec3& p_O : surface_points_O)
    surface_points_Q.push_back(X_QO * p_O);
  result.report = report_of(half, surface_points_Q, diagonal_m);
  result.report.bound_scale = scale * (1 + 1e-9);
  result.shape.a *= result.report.bound_scale;
  return result;
}

}  // namespace mechane::collision_build
