// The Falcon's three legs: a delta that moves its grip and does not turn it. The frame is the one of the source, with
// its origin in the middle of the base, x to the visitor's right, y up, z out of the base towards the visitor, and is
// turned as D is. Geometry: R. E. Stamper, A three degree of freedom parallel manipulator with only translational
// degrees of freedom, thesis, Maryland 1997. Measures and angles of the legs: libnifalcon, FalconGeometry.h. The zero
// of the encoders is not certain: 35 degrees there, 40 and 50 elsewhere.
#pragma once

#include <array>

namespace mechane::drivers::falcon {

using Triple = std::array<double, 3>;  // of x y z, or of the legs: top, right, left

inline constexpr double kThigh_m = 0.060;
/// Where other programs have the middle of the workspace.
inline constexpr Triple kMiddle_m = {0, 0, 0.125};

/// A thigh's angle from its encoder, rad: 0 when it points outwards in the base's plane; it grows towards the visitor.
[[nodiscard]] constexpr double thigh_angle(int counts) noexcept {
  constexpr double kPi = 3.14159265358979323846;
  constexpr double kShaft_m = 0.01425, kDrum_m = 0.110;  // diameters; a cable joins them
  constexpr int kCountsPerTurn = 4 * 320;                // of the shaft
  return counts * (kShaft_m / kCountsPerTurn) * 2 * kPi / kDrum_m + 35 * kPi / 180;
}

/// The thighs' angles that bring the grip to `position_m`, rad. False where the legs do not reach.
[[nodiscard]] bool thigh_angles(const Triple& position_m, Triple& angles_rad) noexcept;

/// Where the grip is, by Newton's method from the middle of the workspace. False for angles that the legs cannot have.
[[nodiscard]] bool grip_position(const Triple& angles_rad, Triple& position_m) noexcept;

/// The torques about the thighs' axles that give `force_n` at the grip: J^T F, where J is the change of the position
/// with the angles. N m, positive as the angles are. False where the legs are stretched and so have no such torques.
[[nodiscard]] bool thigh_torques(const Triple& angles_rad, const Triple& position_m, const Triple& force_n,
                                 Triple& torques_nm) noexcept;

}  // namespace mechane::drivers::falcon
