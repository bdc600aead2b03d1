#include "server/geometry/fitting/fit_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mechane::geometry {
namespace {

constexpr double kHalfPerSpread = 1.5;  // an ellipsoid's shell has 1.73, a box's 1.34
constexpr double kLeastVariance = 1e-6;
constexpr double kMostBendOfLength = 1.2;
constexpr double kMostTaperAtStart = 0.7;
constexpr double kMostFold = 0.8;  // of the bend at which the section reaches its axis
// Exponents to start from: round, cylinder, box, a section with corners under a round profile, spindles.
constexpr std::array<std::array<double, 2>, 5> kExponentStarts = {{{1, 1}, {0.3, 1}, {0.3, 0.3}, {1, 0.3}, {1.5, 1.5}}};

/// The points nearest to the middle, as the covariance measures it.
std::vector<Vec3> nearest(std::span<const Vec3> points, const Moments& moments, double share) {
  std::vector<std::pair<double, std::size_t>> order(points.size());
  const Vec3 inverse = moments.variance.cwiseMax(1e-12).cwiseInverse();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 q = moments.axes.transpose() * (points[i] - moments.mean);
    order[i] = {q.cwiseProduct(q).dot(inverse), i};
  }
  const auto count = static_cast<std::size_t>(share * static_cast<double>(points.size()));
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  std::vector<Vec3> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    kept.push_back(points[order[i].second]);
  return kept;
}

Moments plain_moments(std::span<const Vec3> points) {
  Moments m;
  for (const Vec3& p : points)
    m.mean += p;
  m.mean /= static_cast<double>(points.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points)
    covariance += (p - m.mean) * (p - m.mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance / static_cast<double>(points.size()));
  m.axes = solver.eigenvectors();
  m.axes.col(2) = m.axes.col(0).cross(m.axes.col(1));
  m.variance = solver.eigenvalues();
  return m;
}

/// Taper and bend along z, as regressions show them: |x| grows with z, x grows with z^2 / 2.
void read_deformation(FitState& state, std::span<const Vec3> points_O) {
  const Pose X_QO = state.X_OQ.inverse();
  const auto n = static_cast<double>(points_O.size());
  std::vector<Vec3> points;
  points.reserve(points_O.size());
  double z2_mean = 0;
  for (const Vec3& p : points_O) {
    points.push_back(X_QO * p);
    z2_mean += points.back().z() * points.back().z() / n;
  }
  double z2_variance = 1e-12;
  std::array<double, 2> with_z2{};
  for (const Vec3& p : points) {
    const double off = p.z() * p.z() - z2_mean;
    z2_variance += off * off / n;
    for (int i = 0; i < 2; ++i)
      with_z2[i] += off * p[i] / n;
  }
  for (int i = 0; i < 2; ++i)
    state.bend[i] = 2 * with_z2[i] / z2_variance;
  const double bend = std::hypot(state.bend[0], state.bend[1]);
  const double widest = std::hypot(state.a.x(), state.a.y());
  const double most = std::min(kMostBendOfLength / state.a.z(), kMostFold / widest);
  if (bend > most)
    for (double& b : state.bend)
      b *= most / bend;
  for (int i = 0; i < 2; ++i) {
    double middle = 1e-12;
    double slope = 0;
    for (const Vec3& p : points) {
      const double off = std::abs(p[i] - 0.5 * state.bend[i] * (p.z() * p.z() - z2_mean));
      middle += off / n;
      slope += off * p.z() / (n * std::max(1e-12, z2_mean));
    }
    state.taper[i] = std::clamp(slope / middle * state.a.z(), -kMostTaperAtStart, kMostTaperAtStart);
  }
  // The middle of a bent rod lies off its centre.
  state.X_OQ.p -= state.X_OQ.R * Vec3(state.bend[0], state.bend[1], 0) * (0.5 * z2_mean);
  const double wide =
      std::hypot(state.a.x() * (1 + std::abs(state.taper[0])), state.a.y() * (1 + std::abs(state.taper[1])));
  const double fold = std::hypot(state.bend[0], state.bend[1]) * wide;
  if (fold > kMostFold)
    for (double& b : state.bend)
      b *= kMostFold / fold;
}

std::string start_name(const char* frame, int z_axis, const std::array<double, 2>& e) {
  const auto one_digit = [](double v) { return std::to_string(v).substr(0, 3); };
  return std::string(frame) + " frame, axis " + std::to_string(z_axis) + " as z, e1 " + one_digit(e[0]) + ", e2 " +
         one_digit(e[1]);
}

}  // namespace

Moments moments_of(std::span<const Vec3> points, double trimmed) {
  Moments m = plain_moments(points);
  if (trimmed <= 0) return m;
  for (int round = 0; round < 3; ++round)
    m = plain_moments(nearest(points, m, 1 - trimmed));
  return m;
}

std::vector<FitStart> fit_starts(std::span<const Vec3> points, bool deformed, double trimmed, bool given) {
  const Moments inertia = moments_of(points, trimmed);
  const std::vector<Vec3> kept = nearest(points, inertia, 1 - trimmed);
  std::vector<FitStart> starts;
  const auto add = [&](const char* name, const Mat3& axes, const Vec3& variance) {
    for (int z_axis = 0; z_axis < 3; ++z_axis) {
      FitState state;
      Mat3 R;
      // The chosen axis becomes z, in cyclic order, so that the frame stays right-handed.
      for (int i = 0; i < 3; ++i) {
        const int axis = (z_axis + 1 + i) % 3;
        R.col(i) = axes.col(axis);
        state.a[i] = kHalfPerSpread * std::sqrt(std::max(kLeastVariance, variance[axis]));
      }
      state.X_OQ = {inertia.mean, Quat(R)};
      if (deformed) read_deformation(state, kept);
      for (const auto& e : kExponentStarts) {
        starts.push_back({state, deformed, z_axis, start_name(name, z_axis, e)});
        starts.back().state.e = e;
      }
    }
  };
  add("inertia", inertia.axes, inertia.variance);
  const Mat3 covariance = inertia.axes * inertia.variance.asDiagonal() * inertia.axes.transpose();
  if (given) add("given", Mat3::Identity(), covariance.diagonal());
  return starts;
}

}  // namespace mechane::geometry
