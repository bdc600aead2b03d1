#include "client-sdk/drivers/falcon/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::drivers::falcon {
namespace {

// m; in brackets Stamper's letters. "Out" is away from the middle, "along" is along the axle of a leg's thigh.
constexpr double kShin_m = 0.1025;                              // [b]
constexpr double kLinks_m = 2 * 0.01125;                        // [d + e], at the ends of the shin
constexpr double kGripOut_m = 0.01443, kGripAlong_m = -0.025;   // [c, f] from the shin's end to the grip's middle
constexpr double kAxleOut_m = 0.0400, kAxleAlong_m = -0.02309;  // [r, s] from the base's middle to the axle

/// A leg stands at 90, -30 or -150 degrees about z, and 15 more.
struct LegTurn {
  double cosine, sine;
};
constexpr double kCosine15 = 0.96592582628906829, kSine15 = 0.25881904510252076, kHalfRoot = 0.70710678118654752;
constexpr std::array kLegTurns = {LegTurn{-kSine15, kCosine15}, LegTurn{kCosine15, -kSine15},
                                  LegTurn{-kHalfRoot, -kHalfRoot}};

/// The grip as one leg sees it: out and up from the axle to where the shin's links end; the length of shin and links as
/// seen along the axle, and its change as the grip moves along the axle.
struct LegView {
  double out, up, reach, reach_along;
};
bool leg_view(const LegTurn& turn, const Triple& p, LegView& view) noexcept {
  const double along = -p[0] * turn.sine + p[1] * turn.cosine - kAxleAlong_m;
  const double slant = (along + kGripAlong_m) / kShin_m;  // the cosine of the shin's angle to the axle
  if (!(std::abs(slant) < 1)) return false;
  const double upright = std::sqrt(1 - slant * slant);
  view = {p[0] * turn.cosine + p[1] * turn.sine - kAxleOut_m + kGripOut_m, p[2], kLinks_m + kShin_m * upright,
          -slant / upright};
  return true;
}

/// g = 0 says that a leg closes: its shin reaches from the knee to the grip. m^2; gradients m, m^2/rad.
struct Closure {
  double g;
  Triple by_position;
  double by_angle;
};
bool closure(std::size_t leg, const Triple& p, double angle, Closure& result) noexcept {
  const LegTurn& turn = kLegTurns[leg];
  LegView view{};
  if (!leg_view(turn, p, view)) return false;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const double out = view.out - kThigh_m * cosine, up = view.up - kThigh_m * sine;
  const double along = -view.reach * view.reach_along;
  result.g = out * out + up * up - view.reach * view.reach;
  result.by_position = {2 * (out * turn.cosine - along * turn.sine), 2 * (out * turn.sine + along * turn.cosine),
                        2 * up};
  result.by_angle = 2 * kThigh_m * (out * sine - up * cosine);
  return true;
}

Triple cross(const Triple& u, const Triple& v) noexcept {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
double dot(const Triple& u, const Triple& v) noexcept {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/// The closures of all legs at once. `inverse` has the columns of the inverse of the matrix whose rows are by_position.
struct Closures {
  std::array<Closure, 3> legs;
  std::array<Triple, 3> inverse;
};
bool closures(const Triple& p, const Triple& angles, Closures& all) noexcept {
  for (std::size_t leg = 0; leg < 3; ++leg)
    if (!closure(leg, p, angles[leg], all.legs[leg])) return false;
  const auto& legs = all.legs;
  for (std::size_t leg = 0; leg < 3; ++leg)
    all.inverse[leg] = cross(legs[(leg + 1) % 3].by_position, legs[(leg + 2) % 3].by_position);
  const double determinant = dot(legs[0].by_position, all.inverse[0]);
  constexpr double kLocked_m3 =
      1e-4;  // a hundredth of what it is in the middle: forces would be a hundred times as large
  if (!(std::abs(determinant) > kLocked_m3)) return false;
  for (Triple& column : all.inverse)
    for (double& part : column)
      part /= determinant;
  return true;
}

}  // namespace

bool thigh_angles(const Triple& position_m, Triple& angles_rad) noexcept {
  Triple angles{};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    LegView view{};
    if (!leg_view(kLegTurns[leg], position_m, view)) return false;
    const double distance = std::hypot(view.out, view.up);
    const double cosine =
        (kThigh_m * kThigh_m + distance * distance - view.reach * view.reach) / (2 * kThigh_m * distance);
    if (!(std::abs(cosine) <= 1)) return false;
    angles[leg] = std::atan2(view.up, view.out) - std::acos(cosine);  // of the two, the knee that points outwards
  }
  angles_rad = angles;
  return true;
}

bool grip_position(const Triple& angles_rad, Triple& position_m) noexcept {
  constexpr int kSteps = 20;  // five do nearly everywhere
  constexpr double kLongest_m = 0.02, kClose_m = 1e-10;
  constexpr double kWidest_rad = 2;
  if (!std::all_of(angles_rad.begin(), angles_rad.end(), [](double angle) { return std::abs(angle) < kWidest_rad; }))
    return false;
  Triple p = kMiddle_m;
  for (int step = 0; step < kSteps; ++step) {
    Closures all{};
    if (!closures(p, angles_rad, all)) return false;
    Triple move{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t leg = 0; leg < 3; ++leg)
        move[i] -= all.inverse[leg][i] * all.legs[leg].g;
    const double length = std::sqrt(dot(move, move));
    const double share = length > kLongest_m ? kLongest_m / length : 1;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] += share * move[i];
    if (!(length < kClose_m)) continue;
    // Legs also close with a knee bent inwards, which the real ones cannot.
    if (!std::all_of(all.legs.begin(), all.legs.end(), [](const Closure& leg) { return leg.by_angle < 0; }))
      return false;
    position_m = p;
    return true;
  }
  return false;
}

bool thigh_torques(const Triple& angles_rad, const Triple& position_m, const Triple& force_n,
                   Triple& torques_nm) noexcept {
  Closures all{};
  if (!closures(position_m, angles_rad, all)) return false;
  for (std::size_t leg = 0; leg < 3; ++leg)
    torques_nm[leg] = -all.legs[leg].by_angle * dot(all.inverse[leg], force_n);
  return true;
}

}  // namespace mechane::drivers::falcon
