#include "server/geometry/fitting/fit_state.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::geometry {
namespace {

constexpr double kLeastCoordinate = 1e-9;  // of an axis: a power's slope below it is taken as at this value
constexpr double kLeastTaper = 0.05;       // a section never shrinks below this share
constexpr double kLeastRoot = 1e-6;
constexpr double kLeastForm = 1e-100;

}  // namespace

Superquadric FitState::shape() const {
  Superquadric s;
  s.a = a;
  s.e1 = e[0];
  s.e2 = e[1];
  s.taper_x = taper[0];
  s.taper_y = taper[1];
  s.bend_per_m = std::hypot(bend[0], bend[1]);
  s.bend_angle_rad = s.bend_per_m > 0 ? std::atan2(bend[1], bend[0]) : 0;
  return s;
}

FitState FitState::moved(const Step& step) const {
  FitState to = *this;
  for (int i = 0; i < 3; ++i)
    to.a[i] *= std::exp(step[kAxes + i]);
  for (int i = 0; i < 2; ++i) {
    to.e[i] =
        std::clamp(e[i] + step[kExponents + i], kMinExponent, kMaxExponent);  // a sum can round past the step's bounds
    to.taper[i] += step[kTaper + i];
    to.bend[i] += step[kBend + i];
  }
  to.X_OQ.p += X_OQ.R * step.segment<3>(kShift);
  to.X_OQ.R = (X_OQ.R * quat_from_rotation_vector(step.segment<3>(kTurn))).normalized();
  return to;
}

FitForm::FitForm(const FitState& state)
    : inverse_a_(state.a.cwiseInverse()),
      e1_(state.e[0]),
      e2_(state.e[1]),
      taper_x_(state.taper[0]),
      taper_y_(state.taper[1]),
      bend_x_(state.bend[0]),
      bend_y_(state.bend[1]),
      square_(bend_x_ * bend_x_ + bend_y_ * bend_y_) {
  R_QO_ = state.X_OQ.R.conjugate().toRotationMatrix();
  p_QO_ = -(R_QO_ * state.X_OQ.p);
}

FitForm::Bend FitForm::unbend(const Vec3& p) const {
  Bend b;
  b.over = 1 - bend_x_ * p.x() - bend_y_ * p.y();
  b.root = std::max(kLeastRoot, std::sqrt(b.over * b.over + square_ * p.z() * p.z()));
  b.rise = p.z() * p.z() / std::max(kLeastRoot, b.root + b.over);
  const double straight = p.z() / b.over;
  const double tangent2 = square_ * straight * straight;
  double z = 0;
  if (b.over > 0 && tangent2 < 1e-4) {
    z = straight * (1 - tangent2 * (1.0 / 3 - tangent2 / 5));
    b.z_slope = -straight * straight * straight * (2.0 / 3 - tangent2 * (0.8 - tangent2 * (6.0 / 7)));
  } else {
    const double k = std::sqrt(square_);
    z = std::atan2(k * p.z(), b.over) / k;
    b.z_slope = (b.over * p.z() / (b.root * b.root) - z) / square_;
  }
  b.p = {p.x() - bend_x_ * b.rise, p.y() - bend_y_ * b.rise, z};
  return b;
}

/// F and its slopes, through logarithms: A = (x/a1)^(2/e2), B = (y/a2)^(2/e2), P = (A + B)^(e2/e1), Q = (z/a3)^(2/e1), F = P + Q.
FitForm::Plain FitForm::plain(const Vec3& u) const {
  // Eigen's exp and log, two at a time; unlike the C library's they do not depend on the processor.
  Vec3 ratio = u.cwiseProduct(inverse_a_);
  for (double& r : ratio)
    if (std::abs(r) < kLeastCoordinate) r = std::copysign(kLeastCoordinate, r);
  const Eigen::Array4d log_square =
      2 * Eigen::Array4d(std::abs(ratio.x()), std::abs(ratio.y()), std::abs(ratio.z()), 1).log();
  const Eigen::Array2d AB = (log_square.head<2>() / e2_).exp();
  const double A = AB[0];
  const double B = AB[1];
  const double section = std::max(kLeastForm, A + B);
  const double log_section = std::log(section);
  const double log_P = log_section * e2_ / e1_;
  const double log_Q = log_square[2] / e1_;
  const Eigen::Array2d PQ = Eigen::Array2d(log_P, log_Q).exp();
  const double F = std::max(kLeastForm, PQ.sum());
  const double log_F = std::log(F);
  Plain v;
  v.f = std::exp(0.5 * e1_ * log_F);
  const double across = v.f * std::min(1.0, PQ[0] / F);
  const double along = v.f - across;
  const double wA = A / section;
  const double wB = B / section;
  v.shares = {across * wA, across * wB, along};
  v.slope = v.shares.cwiseQuotient(ratio).cwiseProduct(inverse_a_);
  v.by_e1 = 0.5 * (v.f * log_F - across * log_P - along * log_Q);
  v.by_e2 = 0.5 * across * (log_section - (wA * log_square[0] + wB * log_square[1]) / e2_);
  return v;
}

FitForm::Value FitForm::at(const Vec3& p_O) const {
  const Vec3 p = in_own_frame(p_O);
  const Bend bent = unbend(p);
  const double t = bent.p.z() * inverse_a_.z();
  const double tx = std::max(kLeastTaper, taper_x_ * t + 1);
  const double ty = std::max(kLeastTaper, taper_y_ * t + 1);
  const Vec3 u(bent.p.x() / tx, bent.p.y() / ty, bent.p.z());
  const Plain plain_form = plain(u);
  const Vec3& gu = plain_form.slope;
  Value v;
  v.f = plain_form.f;
  v.by_step.segment<3>(FitState::kAxes) = -plain_form.shares;
  v.by_step[FitState::kExponents] = plain_form.by_e1;
  v.by_step[FitState::kExponents + 1] = plain_form.by_e2;
  // Back through the taper.
  const double sx = tx > kLeastTaper ? gu.x() * u.x() / tx : 0;
  const double sy = ty > kLeastTaper ? gu.y() * u.y() / ty : 0;
  const double taper_slope = sx * taper_x_ + sy * taper_y_;
  v.by_step[FitState::kTaper] = -sx * t;
  v.by_step[FitState::kTaper + 1] = -sy * t;
  v.by_step[FitState::kAxes + 2] += taper_slope * t;
  const Vec3 gb(gu.x() / tx, gu.y() / ty, gu.z() - taper_slope * inverse_a_.z());
  // Back through the bend.
  const double across = bend_x_ * gb.x() + bend_y_ * gb.y();
  const double root2 = bent.root * bent.root;
  const double by_over = across * bent.rise / bent.root - gb.z() * p.z() / root2;
  v.slope_Q = {gb.x() - bend_x_ * by_over, gb.y() - bend_y_ * by_over,
               gb.z() * bent.over / root2 - across * p.z() / bent.root};
  const double sum = std::max(kLeastRoot, bent.root + bent.over);
  const double by_square = across * bent.rise / sum * p.z() * p.z() / bent.root + gb.z() * bent.z_slope;
  v.by_step[FitState::kBend] = -p.x() * by_over - bent.rise * gb.x() + bend_x_ * by_square;
  v.by_step[FitState::kBend + 1] = -p.y() * by_over - bent.rise * gb.y() + bend_y_ * by_square;
  v.by_step.segment<3>(FitState::kTurn) = v.slope_Q.cross(p);
  v.by_step.segment<3>(FitState::kShift) = -v.slope_Q;
  return v;
}

}  // namespace mechane::geometry
