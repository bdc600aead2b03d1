// What the driver calls of the DHD and DRD libraries of Force Dimension 3, declared anew from their published
// reference: no header of the vendor's is used. Units are SI. The vendor's x points to the user, y to the right, z up.
#pragma once

#include <array>
#include <span>
#include <string>

namespace mechane::drivers::dhd {

/// The library's functions by their names, each with the device's number as the last argument. Results: 0 good, 1
/// called again sooner than the device's shortest period, 2 a motor is at its limit; below 0 failed. 1 and 2 are no
/// errors: what was read or set is good.
struct Api {
  int (*drd_open)(char index) = nullptr;  // the device's number
  int (*drd_close)(char) = nullptr;
  bool (*drd_is_initialized)(char) = nullptr;
  int (*drd_auto_init)(char) = nullptr;  // moves the arm; takes seconds
  int (*drd_stop)(bool keeps_force, char) = nullptr;
  int (*system_type)(char) = nullptr;
  int (*gravity_compensation)(int on, char) = nullptr;
  int (*brakes)(int on, char) = nullptr;
  int (*enable_force)(unsigned char on, char) = nullptr;
  int (*status)(int* of_kStatusRoom, char) = nullptr;
  int (*position)(double*, double*, double*, char) = nullptr;
  int (*orientation)(double (*by_rows)[3], char) = nullptr;
  unsigned int (*buttons)(char) = nullptr;
  int (*set_force)(double, double, double, char) = nullptr;
  int (*set_force_torque_grip)(double, double, double, double, double, double, double, char) = nullptr;
  const char* (*last_error)() = nullptr;
  double (*max_force)(char) = nullptr;  // null: an older library; below 0: it sets no limit
};

/// Loads libdrd, which brings libdhd with it: `file`, or where that is empty the names under which it is installed.
/// Returns a fault for a person; empty: loaded.
[[nodiscard]] std::string load(Api& api, const std::string& file);

/// The library fills 17 numbers; later versions may have more.
inline constexpr std::size_t kStatusRoom = 64;
inline constexpr std::size_t kStatusForce = 5, kStatusError = 9, kStatusForceOffCause = 14;
enum ForceOffCause : int { kButton = 1, kVelocity = 2, kWatchdog = 3, kSoftware = 4, kUnplugged = 5, kDeadMan = 6 };

/// A model's limits as others use them. The source has no continuous force and no torque for most.
struct Model {
  int type;  // of dhdGetSystemType
  const char* name;
  double force_n, torque_nm;
  double stiffness_n_per_m, damping_ns_per_m, radius_m;
  bool wrist;  // it measures its orientation
};
/// One that is not in the table gets the weakest limits, no orientation and no workspace.
[[nodiscard]] const Model& model_of(int type) noexcept;

/// From the vendor's axes to those of D.
[[nodiscard]] constexpr std::array<double, 3> to_d(std::span<const double, 3> v) noexcept {
  return {v[1], v[2], v[0]};
}
/// From D to the vendor's axes.
[[nodiscard]] constexpr std::array<double, 3> from_d(std::span<const double, 3> v) noexcept {
  return {v[2], v[0], v[1]};
}

/// The hand's frame in D from the vendor's rotation matrix: both frames change their axes, so that the identity stays
/// the identity. False, with `wxyz` unchanged, when the matrix is not a rotation.
[[nodiscard]] bool orientation_to_d(const double (&by_rows)[3][3], std::span<double, 4> wxyz) noexcept;

}  // namespace mechane::drivers::dhd
