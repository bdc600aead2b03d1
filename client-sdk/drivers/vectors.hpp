// Vectors, forces and rotations, as vendors' libraries have them and as driver.h wants them.
#pragma once

#include <array>
#include <span>

namespace mechane::drivers {

[[nodiscard]] inline double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// `v`, shortened to a length of at most `most`; zero when it is not finite.
[[nodiscard]] std::array<double, 3> limited(std::span<const double, 3> v, double most) noexcept;

/// The unit quaternion w x y z of a rotation matrix given by rows. False, with `wxyz` untouched, when the matrix is not a
/// rotation: not finite, or its columns are not orthonormal to 0.01 and right-handed.
[[nodiscard]] bool quaternion_of(std::span<const double, 9> by_rows, std::span<double, 4> wxyz) noexcept;

}  // namespace mechane::drivers
