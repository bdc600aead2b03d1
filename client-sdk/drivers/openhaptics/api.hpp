// What the driver calls of the HD library of OpenHaptics 3, declared anew from its published reference: no header of
// the vendor's is used. Lengths are in mm, forces in N, torques in mN m; x to the right, y up, z towards the user, as
// in D.
#pragma once

#include <string>

namespace mechane::drivers::hd {

using Handle = unsigned int;
inline constexpr Handle kBadHandle = 0xFFFFFFFF;

/// One entry of the library's error stack; returned by value.
struct ErrorInfo {
  unsigned int code;  // 0: the stack is empty
  int internal;       // the vendor's own
  Handle device;
};

/// Called by the vendor's thread, once a tick.
using Callback = unsigned int (*)(void*);
inline constexpr unsigned int kDone = 0;
inline constexpr unsigned int kContinue = 1;
inline constexpr unsigned short kTopPriority = 65535;

enum Parameter : unsigned int {
  kCurrentButtons = 0x2000,
  kCurrentInkwellSwitch = 0x2002,  // 1: the stylus is out of the inkwell
  kCurrentPosition = 0x2050,       // 3
  kCurrentTransform = 0x2052,      // 16, by columns
  kModelType = 0x2501,
  kVendor = 0x2503,
  kUsableWorkspace = 0x2551,  // 6: least x y z, greatest x y z
  kInputDof = 0x2553,
  kOutputDof = 0x2554,
  kCalibrationStyle = 0x2555,
  kNominalMaxStiffness = 0x2602,  // in use N/mm, though documented as 0 to 1
  kNominalMaxForce = 0x2603,
  kNominalMaxContinuousForce = 0x2604,
  kMotorTemperature = 0x2605,   // 3 or 6, each 0 cold to 1 hot
  kNominalMaxDamping = 0x2609,  // in use N s/mm
  kNominalMaxTorque = 0x2622,   // mN m
  kCurrentForce = 0x2700,       // 3
  kCurrentTorque = 0x2701,  // 3, about the axes of D; deprecated since 3.0, where the motors' own torques are preferred
  kForceOutput = 0x4000,
  kMaxForceClamping = 0x4001,
  kForceRamping = 0x4002,
};

enum Calibration : unsigned int { kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kNeedsManualInput = 0x5002 };
enum Style : int { kEncoderReset = 1, kAuto = 2, kInkwell = 4 };

enum Error : unsigned int {
  kInvalidValue = 0x101,
  kWarmMotors = 0x200,
  kExceededMaxForce = 0x201,
  kExceededMaxForceImpulse = 0x202,
  kExceededMaxVelocity = 0x203,
};

/// The library's functions by their names without "hd".
struct Api {
  Handle (*init_device)(const char*) = nullptr;
  void (*disable_device)(Handle) = nullptr;
  void (*begin_frame)(Handle) = nullptr;
  void (*end_frame)(Handle) = nullptr;
  void (*get_boolean)(unsigned int, unsigned char*) = nullptr;
  void (*get_integer)(unsigned int, int*) = nullptr;
  void (*get_double)(unsigned int, double*) = nullptr;
  void (*set_double)(unsigned int, const double*) = nullptr;
  const char* (*get_string)(unsigned int) = nullptr;
  void (*enable)(unsigned int) = nullptr;
  ErrorInfo (*get_error)() = nullptr;
  const char* (*get_error_string)(unsigned int) = nullptr;
  unsigned int (*check_calibration)() = nullptr;
  void (*update_calibration)(unsigned int) = nullptr;
  void (*start_scheduler)() = nullptr;
  void (*stop_scheduler)() = nullptr;
  void (*set_scheduler_rate)(unsigned long) = nullptr;
  unsigned long (*schedule_asynchronous)(Callback, void*, unsigned short) = nullptr;
  void (*unschedule)(unsigned long) = nullptr;
};

/// Loads libHD: `file`, or where that is empty the names under which it is installed. Returns a fault for a person;
/// empty: loaded.
[[nodiscard]] std::string load(Api& api, const std::string& file);

/// What the error stack held.
struct Errors {
  bool warm = false;    // the motors are too warm
  ErrorInfo serious{};  // of those that end a session the one that came first; code 0: none
};

/// Empties the error stack of the calling thread's device. Errors after which the device goes on by itself are dropped.
/// Does not allocate.
[[nodiscard]] Errors pop_errors(const Api& api) noexcept;

/// An error with its numbers, as in "'...' (error 0x302, internal -28)".
[[nodiscard]] std::string in_words(const Api& api, const ErrorInfo& error);

}  // namespace mechane::drivers::hd
