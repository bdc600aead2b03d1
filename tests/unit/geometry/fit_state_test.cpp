#include "server/geometry/fitting/fit_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/superquadric_draw.hpp"

namespace mechane::geometry {
namespace {

using test::between;

/// A state like those that the fit passes through, about one in size.
FitState random_state(Random& random) {
  FitState state;
  for (double& a : state.a)
    a = between(random, 0.1, 0.5);
  for (double& e : state.e)
    e = between(random, 0.2, 1.8);
  state.X_OQ.R = quat_from_rotation_vector(test::gaussian_vector(random));
  state.X_OQ.p = 0.1 * test::gaussian_vector(random);
  if (random.unit() < 0.7) state.taper = {between(random, -0.6, 0.6), between(random, -0.6, 0.6)};
  // From none over one that the series serves to a strong one.
  const double most = random.unit() < 0.3 ? 0 : random.unit() < 0.5 ? 1e-2 : 0.7;
  state.bend = {between(random, -most, most), between(random, -most, most)};
  return state;
}

/// Near the surface, off the planes x, y, z = 0, where a power's slope has no sensible difference quotient.
Vec3 random_point(const FitState& state, Random& random) {
  const double eta = (random.unit() < 0.5 ? -1 : 1) * between(random, 0.2, 1.3);
  const double omega = 0.5 * kPi * static_cast<double>(random.below(4)) + between(random, 0.2, 1.3);
  return state.X_OQ * (between(random, 0.7, 1.3) * surface_point(state.shape(), {eta, omega}));
}

/// Whether a difference quotient of f at 0 is this slope. With one step alone, a point in some ten thousand lies so near to a plane where a
/// power has its corner that the step crosses it.
template <class Function>
bool has_slope(const Function& f, double slope, double tolerance) {
  constexpr std::array kSteps{1e-5, 1e-6, 1e-7};
  return std::any_of(kSteps.begin(), kSteps.end(),
                     [&](double step) { return std::abs((f(step) - f(-step)) / (2 * step) - slope) < tolerance; });
}

RC_GTEST_PROP(FitForm, IsTheRadialFormWithItsSlopes, (std::uint64_t seed)) {
  Random random(seed);
  const FitState state = random_state(random);
  RC_PRE(is_valid(state.shape()));
  const Vec3 p_O = random_point(state, random);
  const auto f_at = [&](const FitState& s, const Vec3& p) { return radial_form(s.shape(), s.X_OQ.inverse() * p); };
  const FitForm::Value value = FitForm(state).at(p_O);
  RC_ASSERT(std::abs(value.f - f_at(state, p_O)) < 1e-9 * value.f);

  const double tolerance = 1e-5 * (1 + value.by_step.cwiseAbs().maxCoeff());
  for (int i = 0; i < FitState::kAll; ++i) {
    const auto moved = [&](double s) { return f_at(state.moved(s * FitState::Step::Unit(i)), p_O); };
    RC_ASSERT(has_slope(moved, value.by_step[i], tolerance));
  }
  for (int i = 0; i < 3; ++i) {
    const auto along = [&](double s) { return f_at(state, p_O + state.X_OQ.rotate(s * Vec3::Unit(i))); };
    RC_ASSERT(has_slope(along, value.slope_Q[i], tolerance));
  }
}

RC_GTEST_PROP(FitForm, IsFiniteWhereverItIsAsked, (std::uint64_t seed)) {
  Random random(seed);
  const FitState state = random_state(random);
  const FitForm form(state);
  for (const Vec3& p : {Vec3(state.X_OQ.p), Vec3(state.X_OQ * Vec3(0, 0, 5)), Vec3(state.X_OQ * Vec3(-50, 0, 0)),
                        Vec3(10 * test::gaussian_vector(random))}) {
    const FitForm::Value value = form.at(p);
    RC_ASSERT(std::isfinite(value.f) && value.f >= 0);
    RC_ASSERT(value.slope_Q.allFinite() && value.by_step.allFinite());
  }
}

}  // namespace
}  // namespace mechane::geometry
