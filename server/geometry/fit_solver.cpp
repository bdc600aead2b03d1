#include "server/geometry/fit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ceres/jet.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include "server/geometry/superquadric_math.hpp"

namespace mechane::geometry {
namespace {

constexpr double kMaxTaper = 0.95;

double logit(double share) {
  return std::log(share / (1 - share));
}

template <class T>
T exponent(const T& x) {
  using std::exp;
  return T(kMinExponent) + T(kMaxExponent - kMinExponent) / (T(1) + exp(-x));
}

template <class T>
BasicSuperquadric<T> shape_of(const T* x, bool deformed) {
  using std::exp;
  using std::tanh;
  BasicSuperquadric<T> s;
  s.a = {exp(x[0]), exp(x[1]), exp(x[2])};
  s.e1 = exponent(x[3]);
  s.e2 = exponent(x[4]);
  if (!deformed) return s;
  s.taper_x = T(kMaxTaper) * tanh(x[11]);
  s.taper_y = T(kMaxTaper) * tanh(x[12]);
  s.bend_per_m = x[13];
  s.bend_angle_rad = x[14];
  return s;
}

/// R(v)^T p, Rodrigues' formula with the smooth quotients.
template <class T>
math::Vec3T<T> unrotate(const T* v, const math::Vec3T<T>& p) {
  using std::sqrt;
  const math::Vec3T<T> w{-v[0], -v[1], -v[2]};
  const T angle = sqrt(w.squaredNorm() + T(1e-24));
  const math::Vec3T<T> once = w.cross(p);
  return p + math::sinc(angle) * once + math::one_minus_cos_over_square(angle) * w.cross(once);
}

/// Equation 3: sqrt(a1 a2 a3) (F^e1 - 1) for every point.
template <int Parameters>
struct Residuals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Parameters };
  std::span<const Vec3> points;
  Quat base;

  [[nodiscard]] int NumResiduals() const { return static_cast<int>(points.size()); }

  template <class T>
  bool operator()(const T* x, T* residuals) const {
    using std::sqrt;
    constexpr bool kDeformed = Parameters == FitState::kAll;
    const BasicSuperquadric<T> s = shape_of(x, kDeformed);
    const T volume = sqrt(s.a.x() * s.a.y() * s.a.z());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 turned = base.conjugate() * points[i];
      const math::Vec3T<T> shifted{T(turned.x()) - x[8], T(turned.y()) - x[9], T(turned.z()) - x[10]};
      math::Vec3T<T> p = unrotate<T>(x + 5, shifted);
      if constexpr (kDeformed) p = math::undeform<T>(s, p);
      const T f = math::inside_outside_undeformed<T>(s, p);
      using std::pow;
      residuals[i] = f < 1e-300 ? -volume : volume * (pow(f, s.e1) - T(1));
    }
    return true;
  }
};

template <int Parameters>
int solve(FitState& state, std::span<const Vec3> points, int max_iterations) {
  using Functor = Residuals<Parameters>;
  using Function = ceres::TinySolverAutoDiffFunction<Functor, Eigen::Dynamic, Parameters>;
  const Functor functor{points, state.base};
  const Function function(functor);
  ceres::TinySolver<Function> solver;
  solver.options.max_num_iterations = max_iterations;
  solver.options.initial_trust_region_radius = 10;
  solver.options.function_tolerance = 1e-12;
  solver.options.cost_threshold = 1e-16;
  typename ceres::TinySolver<Function>::Parameters x;
  std::copy_n(state.x.begin(), Parameters, x.data());
  const auto summary = solver.Solve(function, &x);
  if (x.allFinite()) std::copy_n(x.data(), Parameters, state.x.begin());
  return std::max(0, summary.iterations);
}

}  // namespace

FitState FitState::start(const Pose& X_OQ, const Vec3& half, double e1, double e2) {
  FitState state;
  state.base = X_OQ.R;
  for (int i = 0; i < 3; ++i)
    state.x[i] = std::log(half[i]);
  state.x[3] = logit((e1 - kMinExponent) / (kMaxExponent - kMinExponent));
  state.x[4] = logit((e2 - kMinExponent) / (kMaxExponent - kMinExponent));
  const Vec3 center = X_OQ.R.conjugate() * X_OQ.p;
  for (int i = 0; i < 3; ++i)
    state.x[8 + i] = center[i];
  return state;
}

void FitState::begin_deformation(double bend_per_m, double angle_rad) {
  x[11] = x[12] = 0;
  x[13] = bend_per_m;
  x[14] = angle_rad;
}

Superquadric FitState::shape() const {
  Superquadric s = shape_of(x.data(), x[13] != 0);
  if (s.bend_per_m < 0) {  // a bend the other way
    s.bend_per_m = -s.bend_per_m;
    s.bend_angle_rad += kPi;
  }
  s.bend_angle_rad = std::remainder(s.bend_angle_rad, 2 * kPi);
  return s;
}

Pose FitState::pose() const {
  const Quat R = (base * quat_from_rotation_vector({x[5], x[6], x[7]})).normalized();
  return {base * Vec3(x[8], x[9], x[10]), R};
}

int improve(FitState& state, std::span<const Vec3> points, int max_iterations, bool deformed) {
  return deformed ? solve<FitState::kAll>(state, points, max_iterations)
                  : solve<FitState::kRigid>(state, points, max_iterations);
}

FitErrors fit_errors(const FitState& state, std::span<const Vec3> points) {
  FitErrors errors;
  const double infinity = std::numeric_limits<double>::infinity();
  const Superquadric s = state.shape();
  if (!is_valid(s) || points.empty()) return {infinity, infinity, infinity};
  const Pose X_QO = state.pose().inverse();
  for (const Vec3& p_O : points) {
    const Vec3 p = X_QO * p_O;
    const double F = inside_outside(s, p);
    const double f = std::pow(F, 0.5 * s.e1);
    double distance = std::abs(1 - 1 / f) * p.norm();
    // grad f = (e1/2) F^(e1/2 - 1) grad F
    const double slope = 0.5 * s.e1 * f / F * gradient(s, p).norm();
    if (slope > 0) distance = std::min(distance, std::abs(f - 1) / slope);
    if (!std::isfinite(distance)) distance = p.norm() + s.a.maxCoeff();
    errors.mean += distance;
    errors.rms += distance * distance;
    errors.max = std::max(errors.max, distance);
  }
  errors.mean /= static_cast<double>(points.size());
  errors.rms = std::sqrt(errors.rms / static_cast<double>(points.size()));
  return errors;
}

}  // namespace mechane::geometry
