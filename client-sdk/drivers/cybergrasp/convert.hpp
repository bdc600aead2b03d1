// What the CyberGrasp is told and tells, and what Mechane does.
#pragma once

#include <array>
#include <span>
#include <string>

#include <mechane/driver.h>

namespace mechane::drivers::cybergrasp {

/// Newtons as parts of the glove's full pull, 0 .. 1; none for what is not a number. `full_n` is over 0.
[[nodiscard]] std::array<double, MECHANE_FINGERS> pulls_of(std::span<const double, MECHANE_FINGERS> finger_n,
                                                           double full_n) noexcept;

/// For people.
[[nodiscard]] std::string name_of_mode(int mode);

/// Whether a hand can have these angles, rad: every one is a number, and within half a turn.
[[nodiscard]] bool are_joints(std::span<const double, MECHANE_HAND_JOINTS> joints_rad) noexcept;

/// Whether it is a place within 10 m, m, and a unit quaternion.
[[nodiscard]] bool is_pose(std::span<const double, 3> position_m, std::span<const double, 4> wxyz) noexcept;

}  // namespace mechane::drivers::cybergrasp
