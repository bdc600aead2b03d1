#include "server/haptics/smooth_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "server/collision/samples.hpp"

namespace mechane::haptics {
namespace {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

constexpr std::size_t kPadPoints = 48;
constexpr double kSpread_m = 0.007;  // standard deviation: facets of up to twice this breadth are smoothed
constexpr double kWithin = 0.95;     // of the distribution; the rest would lie far out
// How far the pad is pushed in: only a point inside a body is lifted to its surface, and on a round body the pad's rim lies higher than
// its middle. A thin wall is tried with the second depth.
constexpr std::array<double, 2> kDeep_m{4e-3, 1.5e-3};
// In a wall that is thinner still, the pad is pushed in by steps, and of each step those points count that are just below the surface. So
// a round wall is found under the whole pad, from either side; the weights of a point in all steps add up to 1.
constexpr double kStep_m = 0.9e-3;
constexpr std::array<double, 5> kSteps_m{-1.2e-3, -0.3e-3, 0.6e-3, 1.5e-3, 2.4e-3};
constexpr double kOnset_m = 0.3e-3;
constexpr double kEnough = 0.5 * kPadPoints;

/// Which curvatures of a surface count, as a square form of trace 1 over its plane: those along the velocity `v`, and where it is slow,
/// those of all directions alike.
Mat2 way_along(const Vec2& v) {
  constexpr double kSlow_m_per_s = 0.05;  // the steps of its encoders make a stylus at rest seem as fast as this
  const Mat2 way = v * v.transpose() + 0.5 * kSlow_m_per_s * kSlow_m_per_s * Mat2::Identity();
  return way / way.trace();
}

/// A plane through weighted points and how they bend away from it, by least squares of the distances along z.
class SurfaceFit {
 public:
  explicit SurfaceFit(const Mat2& way) : way_(way) {}

  void add(const Vec3& p, double weight) {
    const Vec4 terms(p.x(), p.y(), p.z(), p.head<2>().dot(way_ * p.head<2>()));
    weight_ += weight;
    sum_ += weight * terms;
    squares_ += weight * terms * terms.transpose();
  }
  [[nodiscard]] double weight() const { return weight_; }
  /// How many points lay nearer to the other side of a wall.
  [[nodiscard]] std::size_t behind() const { return behind_; }
  void note_behind() { ++behind_; }

  struct Found {
    Vec3 normal;
    double curvature_per_m;  // over the way; > 0: the middle is highest
  };
  /// None where the points lie on a line.
  [[nodiscard]] std::optional<Found> found() const {
    constexpr double kLine = 1e-3;
    constexpr double kLeastSpread_m4 =
        0.1 * kSpread_m * kSpread_m * kSpread_m * kSpread_m;  // of points that can show a bend
    const Vec4 middle = sum_ / weight_;
    const Mat4 C = squares_ / weight_ - middle * middle.transpose();
    const double det = C(0, 0) * C(1, 1) - C(0, 1) * C(0, 1);
    const double trace = C(0, 0) + C(1, 1);
    if (!(det > kLine * trace * trace)) return std::nullopt;
    const auto slope = [&](int term) {
      return Vec2((C(1, 1) * C(0, term) - C(0, 1) * C(1, term)) / det,
                  (C(0, 0) * C(1, term) - C(0, 1) * C(0, term)) / det);
    };
    const Vec2 plane = slope(kZ), of_way = slope(kWay);
    const double bend = C(kWay, kZ) - of_way.dot(C.block<2, 1>(0, kZ));
    const double spread = C(kWay, kWay) - of_way.dot(C.block<2, 1>(0, kWay));
    // Of an even spread of points, the squares along two directions do not depend on each other: so those across the way cancel.
    const double curvature_per_m = -2 * way_.squaredNorm() * bend / std::max(spread, kLeastSpread_m4);
    return Found{Vec3(-plane.x(), -plane.y(), 1).normalized(), curvature_per_m};
  }

 private:
  static constexpr int kZ = 2, kWay = 3;

  Mat2 way_;
  double weight_ = 0;
  std::size_t behind_ = 0;
  Vec4 sum_ = Vec4::Zero();  // of x, y, z, and the square form of x and y
  Mat4 squares_ = Mat4::Zero();
};

/// Rises evenly from 0 to 1 between two values.
double ramp(double value, double from, double to) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

/// Adds the places of the body where the pad's points come to lie, seen from `p_BF`. Weights fall to zero before a point drops out, so
/// that the normal is continuous. `step_m`: points that are deeper do not count.
void add_below(const collision::Object& pad, const collision::Object& body, const Pose& X_BP, const Vec3& p_BF,
               double step_m, SurfaceFit& fit) {
  std::array<collision::SurfaceHit, kPadPoints> hits;
  const std::size_t count = collision::find_surface(pad, X_BP, body, hits);
  const Mat3 R_PB = X_BP.R.conjugate().toRotationMatrix();
  for (const collision::SurfaceHit& hit : std::span(hits).first(count)) {
    const double cosine = R_PB.row(2).dot(hit.n_T.cast<double>());
    const auto depth_m = static_cast<double>(hit.depth_m);
    if (cosine < 0) fit.note_behind();
    double weight = ramp(cosine, 0.7, 0.9) * ramp(depth_m, 0, kOnset_m);
    if (depth_m > step_m) weight *= 1 - ramp(depth_m, step_m, step_m + kOnset_m);
    if (weight > 0) fit.add(R_PB * (hit.p_T.cast<double>() - p_BF), weight);
  }
}

}  // namespace

collision::Object make_pad() {
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < kPadPoints / 2; ++i) {
    const double share = kWithin * (static_cast<double>(i) + 0.5) / (kPadPoints / 2.0);
    const double radius = kSpread_m * std::sqrt(-2 * std::log1p(-share));
    const double angle = golden_angle * static_cast<double>(i);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    points.push_back(-points.back());
  }
  collision::Object pad;
  pad.parts.emplace_back();
  pad.parts[0].bound_O = collision::bounding_sphere(points);
  collision::append_samples(pad, 0, std::move(points));
  collision::close_clusters(pad);
  return pad;
}

SmoothSurface smooth_surface(const collision::Object& pad, const collision::Object& body, const Touch& touch) noexcept {
  SmoothSurface smooth{.n_B = touch.n_B};
  for (int round = 0; round < touch.rounds; ++round) {
    Pose X_BP;
    X_BP.R = Quat::FromTwoVectors(Vec3::UnitZ(), smooth.n_B);
    const auto push_in = [&](double deep_m) { X_BP.p = touch.p_B - (touch.surface_m + deep_m) * smooth.n_B; };
    const Mat2 way = way_along((X_BP.R.conjugate() * touch.v_B).head<2>());
    SurfaceFit best(way);
    std::size_t behind = 0;
    for (const double deep_m : kDeep_m) {
      push_in(deep_m);
      SurfaceFit fit(way);
      add_below(pad, body, X_BP, X_BP.p, std::numeric_limits<double>::infinity(), fit);
      behind = fit.behind();
      if (fit.weight() > best.weight()) best = fit;
      if (best.weight() > kEnough) break;
    }
    if (touch.thin_walls && best.weight() <= kEnough && behind >= kPadPoints / 4) {
      SurfaceFit fit(way);
      for (const double deep_m : kSteps_m) {
        push_in(deep_m);
        add_below(pad, body, X_BP, touch.p_B, kStep_m, fit);
      }
      if (fit.weight() > best.weight()) best = fit;
    }
    const double trust = ramp(best.weight() / kPadPoints, 0.25, 0.5);
    const auto found = trust > 0 ? best.found() : std::nullopt;
    if (!found) return {.n_B = touch.n_B};
    smooth.n_B = (touch.n_B + trust * (X_BP.rotate(found->normal) - touch.n_B)).normalized();
    smooth.curvature_per_m = trust * found->curvature_per_m;
  }
  return smooth;
}

}  // namespace mechane::haptics
