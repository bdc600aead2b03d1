// The state of a fit: the 15 parameters of one superquadric; and how far a point lies from it, with derivatives written by hand.
#pragma once

#include <array>

#include "server/base/math.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::geometry {

/// One superquadric in some frame, for points whose diagonal is about 1. The bend is a vector (k cos alpha, k sin alpha), so that
/// a state without bend is like any other; a step turns the pose by a rotation vector and shifts it, both in the superquadric's own frame.
struct FitState {
  /// The order of a step's parts: log of the axes (3), exponents (2), rotation (3), centre (3), taper (2), bend (2).
  enum Parameter { kAxes = 0, kExponents = 3, kTurn = 5, kShift = 8, kTaper = 11, kBend = 13 };
  static constexpr int kRigid = 11;
  static constexpr int kAll = 15;
  using Step = Eigen::Matrix<double, kAll, 1>;

  Vec3 a = Vec3::Ones();
  std::array<double, 2> e{1, 1};
  Pose X_OQ;
  std::array<double, 2> taper{0, 0};
  std::array<double, 2> bend{0, 0};

  [[nodiscard]] Superquadric shape() const;
  [[nodiscard]] FitState moved(const Step& step) const;
};

/// f = F^(e1/2), which grows in proportion to the distance from the centre, at points of one state. Where taper and bend cannot
/// be undone it goes on with bounded slopes.
class FitForm {
 public:
  struct Value {
    double f = 0;
    Vec3 slope_Q = Vec3::Zero();  ///< df/dp
    FitState::Step by_step;       ///< df by a step of the state
  };
  explicit FitForm(const FitState& state);

  [[nodiscard]] Value at(const Vec3& p_O) const;
  [[nodiscard]] Vec3 in_own_frame(const Vec3& p_O) const { return R_QO_ * p_O + p_QO_; }

 private:
  /// The unbent point, and what the derivatives need. With k the bend's length, over = 1 - k R, root = 1 - k r and
  /// k (R - r) = root - over: the formulas of superquadric_math.hpp's unbend, without a division by k.
  struct Bend {
    Vec3 p = Vec3::Zero();
    double over = 1;
    double root = 1;
    double rise = 0;     // (R - r) / k
    double z_slope = 0;  // dz/dk / k, at the same `over`
  };
  /// At an undeformed point.
  struct Plain {
    double f = 0;
    Vec3 slope = Vec3::Zero();
    Vec3 shares = Vec3::Zero();  // df by the log of each axis, negated
    double by_e1 = 0;
    double by_e2 = 0;
  };
  [[nodiscard]] Bend unbend(const Vec3& p_Q) const;
  [[nodiscard]] Plain plain(const Vec3& p) const;

  Mat3 R_QO_;
  Vec3 p_QO_;
  Vec3 inverse_a_;
  double e1_, e2_;
  double taper_x_, taper_y_;
  double bend_x_, bend_y_, square_;  // of the bend vector
};

}  // namespace mechane::geometry
