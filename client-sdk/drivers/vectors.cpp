#include "client-sdk/drivers/vectors.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::drivers {
namespace {

/// M^T M is the identity and det M is 1, each to 0.01. Comparisons with NaN are false.
bool is_rotation(std::span<const double, 9> m) noexcept {
  constexpr double kTolerance = 0.01;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = a; b < 3; ++b) {
      const double product = m[a] * m[b] + m[3 + a] * m[3 + b] + m[6 + a] * m[6 + b];
      if (!(std::abs(product - (a == b ? 1.0 : 0.0)) < kTolerance)) return false;
    }
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]) >
         0;
}

}  // namespace

std::array<double, 3> limited(std::span<const double, 3> v, double most) noexcept {
  if (!std::ranges::all_of(v, [](double part) { return std::isfinite(part); })) return {};
  const double length = std::hypot(v[0], v[1], v[2]);
  const double scale = length > most ? most / length : 1;
  return {v[0] * scale, v[1] * scale, v[2] * scale};
}

bool quaternion_of(std::span<const double, 9> m, std::span<double, 4> wxyz) noexcept {
  if (!is_rotation(m)) return false;
  // Four times the square of each component; dividing by the greatest keeps all digits.
  const std::array<double, 4> squares = {1 + m[0] + m[4] + m[8], 1 + m[0] - m[4] - m[8], 1 - m[0] + m[4] - m[8],
                                         1 - m[0] - m[4] + m[8]};
  const double x = m[7] - m[5], y = m[2] - m[6], z = m[3] - m[1];  // four times w x, w y, w z
  const double xy = m[1] + m[3], xz = m[2] + m[6], yz = m[5] + m[7];
  const auto greatest = std::max_element(squares.begin(), squares.end()) - squares.begin();
  std::array<double, 4> q{};
  switch (greatest) {
    case 0:
      q = {squares[0], x, y, z};
      break;
    case 1:
      q = {x, squares[1], xy, xz};
      break;
    case 2:
      q = {y, xy, squares[2], yz};
      break;
    default:
      q = {z, xz, yz, squares[3]};
  }
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  for (std::size_t i = 0; i < 4; ++i)
    wxyz[i] = q[i] / norm;
  return true;
}

}  // namespace mechane::drivers
