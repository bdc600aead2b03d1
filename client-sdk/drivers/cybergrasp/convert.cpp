#include "client-sdk/drivers/cybergrasp/convert.hpp"

#include <algorithm>
#include <cmath>

#include "client-sdk/drivers/cybergrasp/shim.h"

namespace mechane::drivers::cybergrasp {
namespace {

bool all_within(std::span<const double> numbers, double most) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [most](double number) { return std::abs(number) <= most; });
}

}  // namespace

std::array<double, MECHANE_FINGERS> pulls_of(std::span<const double, MECHANE_FINGERS> finger_n,
                                             double full_n) noexcept {
  std::array<double, MECHANE_FINGERS> pulls{};
  for (std::size_t finger = 0; finger < pulls.size(); ++finger)
    if (std::isfinite(finger_n[finger])) pulls[finger] = std::clamp(finger_n[finger] / full_n, 0.0, 1.0);
  return pulls;
}

std::string name_of_mode(int mode) {
  switch (mode) {
    case MECHANE_GRASP_FORCE:
      return "force";
    case MECHANE_GRASP_IMPEDANCE:
      return "impedance";
    case MECHANE_GRASP_REWIND:
      return "rewind";
    case MECHANE_GRASP_EFFECT:
      return "effect";
    default:
      return "mode " + std::to_string(mode);
  }
}

bool are_joints(std::span<const double, MECHANE_HAND_JOINTS> joints_rad) noexcept {
  constexpr double kHalfTurn = 3.15;
  return all_within(joints_rad, kHalfTurn);
}

bool is_pose(std::span<const double, 3> position_m, std::span<const double, 4> wxyz) noexcept {
  constexpr double kFar_m = 10, kTolerance = 0.005;  // Mechane takes squares from 0.99 to 1.01
  if (!all_within(position_m, kFar_m)) return false;
  double square = 0;
  for (const double part : wxyz)
    square += part * part;
  return std::abs(square - 1) < kTolerance;
}

}  // namespace mechane::drivers::cybergrasp
