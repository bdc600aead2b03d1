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

/// A plane through weighted points, by least squares of the distances along z.
class PlaneFit {
 public:
  void add(const Vec3& p, double weight) {
    weight_ += weight;
    const Vec3 weighted = weight * p;
    sum_ += weighted;
    xy_xz_yz_ += Vec3(weighted.x() * p.y(), weighted.x() * p.z(), weighted.y() * p.z());
    xx_ += weighted.x() * p.x();
    yy_ += weighted.y() * p.y();
  }
  [[nodiscard]] double weight() const { return weight_; }
  /// How many points lay nearer to the other side of a wall.
  [[nodiscard]] std::size_t behind() const { return behind_; }
  void note_behind() { ++behind_; }
  /// None where the points lie on a line.
  [[nodiscard]] std::optional<Vec3> normal() const {
    constexpr double kLine = 1e-3;
    const Vec3 middle = sum_ / weight_;
    const double xx = xx_ / weight_ - middle.x() * middle.x(), yy = yy_ / weight_ - middle.y() * middle.y();
    const double xy = xy_xz_yz_.x() / weight_ - middle.x() * middle.y();
    const double xz = xy_xz_yz_.y() / weight_ - middle.x() * middle.z();
    const double yz = xy_xz_yz_.z() / weight_ - middle.y() * middle.z();
    const double det = xx * yy - xy * xy;
    const double trace = xx + yy;
    if (!(det > kLine * trace * trace)) return std::nullopt;
    const double slope_x = (yy * xz - xy * yz) / det;
    const double slope_y = (xx * yz - xy * xz) / det;
    return Vec3(-slope_x, -slope_y, 1).normalized();
  }

 private:
  double weight_ = 0;
  std::size_t behind_ = 0;
  Vec3 sum_ = Vec3::Zero();
  double xx_ = 0, yy_ = 0;  // sums of products: those that the normal needs
  Vec3 xy_xz_yz_ = Vec3::Zero();
};

/// Rises evenly from 0 to 1 between two values.
double ramp(double value, double from, double to) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

/// Adds the places of the body where the pad's points come to lie, seen from `p_BF`. Weights fall to zero before a point drops out, so
/// that the normal is continuous. `step_m`: points that are deeper do not count.
void add_below(const collision::Object& pad, const collision::Object& body, const Pose& X_BP, const Vec3& p_BF,
               double step_m, PlaneFit& fit) {
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

Vec3 smooth_normal(const collision::Object& pad, const collision::Object& body, const Touch& touch) noexcept {
  Vec3 smooth_B = touch.n_B;
  for (int round = 0; round < touch.rounds; ++round) {
    Pose X_BP;
    X_BP.R = Quat::FromTwoVectors(Vec3::UnitZ(), smooth_B);
    const auto push_in = [&](double deep_m) { X_BP.p = touch.p_B - (touch.surface_m + deep_m) * smooth_B; };
    PlaneFit best;
    std::size_t behind = 0;
    for (const double deep_m : kDeep_m) {
      push_in(deep_m);
      PlaneFit fit;
      add_below(pad, body, X_BP, X_BP.p, std::numeric_limits<double>::infinity(), fit);
      behind = fit.behind();
      if (fit.weight() > best.weight()) best = fit;
      if (best.weight() > kEnough) break;
    }
    if (touch.thin_walls && best.weight() <= kEnough && behind >= kPadPoints / 4) {
      PlaneFit fit;
      for (const double deep_m : kSteps_m) {
        push_in(deep_m);
        add_below(pad, body, X_BP, touch.p_B, kStep_m, fit);
      }
      if (fit.weight() > best.weight()) best = fit;
    }
    const double trust = ramp(best.weight() / kPadPoints, 0.25, 0.5);
    const std::optional<Vec3> normal_P = trust > 0 ? best.normal() : std::nullopt;
    if (!normal_P) return touch.n_B;
    smooth_B = (touch.n_B + trust * (X_BP.rotate(*normal_P) - touch.n_B)).normalized();
  }
  return smooth_B;
}

}  // namespace mechane::haptics
