// Haptic devices as staff see them: what each can do and how it fares, and what can be asked of its program.
#pragma once

#include <cstdint>
#include <string>

#include "server/base/error.hpp"
#include <mechane/client/types.hpp>

namespace mechane::client {

/// Where a device's workspace lies in the world, and how large it is there.
struct DevicePlace {
  static constexpr double kMostScale = 100;
  Vec3 p_WD = Vec3::Zero();  ///< the middle of the device's workspace, each number within hand::kFarthestHand_m
  double turn_rad = 0;       ///< of the device about the world's y axis, anticlockwise from above
  double scale = 1;          ///< metres in the world for one of the device's; 1 to kMostScale
  friend bool operator==(const DevicePlace&, const DevicePlace&) = default;
};

/// What a device is. A force of 0: it renders none.
struct DeviceLimits {
  double wanted_hz = 0;  ///< how often it wants to be served
  double peak_force_n = 0;
  double continuous_force_n = 0;
  double peak_torque_nm = 0;
  double peak_finger_force_n = 0;
  double max_stiffness_n_per_m = 0;       ///< 0: not known
  Vec3 workspace_min_D_m = Vec3::Zero();  ///< both 0: not known
  Vec3 workspace_max_D_m = Vec3::Zero();
};

/// What the program of an open device tells staff. In DeviceReport is what visitors have to know.
struct DeviceDetails {
  std::uint32_t user = 0;  ///< filled in by the client
  DeviceLimits limits{};
  DevicePlace place{};
  double rate_hz = 0;  ///< states of the device a second, over the last two
  double late_us = 0;  ///< how much too late one of them came, at most
  Vec3 p_WH = Vec3::Zero();
  double force_n = 0;
  double temperature = -1;  ///< 0 cold to 1 too hot; below 0: not known
  bool testing = false;
  double test_force_n = 0;     ///< the largest of the last test, on hand or finger
  double test_energy_j = 0;    ///< what the device gave the hand in that test, less what it received
  std::uint64_t answered = 0;  ///< id of the last request; 0: none yet
  std::string refusal{};       ///< why that was not done; empty: it was. At most 255 bytes
};

enum class DeviceAction : std::uint8_t {
  place,      ///< put the workspace at DeviceRequest::place, after the force has gone to zero
  calibrate,  ///< fit the glove to the visitor's hand
  test,       ///< a soft floor of at most 1 N under the hand, in the place of the world, for a while
  end_test,
};

struct DeviceRequest {
  std::uint64_t id = 0;  ///< filled in by who sends it
  std::uint32_t user = 0;
  DeviceAction action = DeviceAction::test;
  DevicePlace place{};  ///< of DeviceAction::place
};

/// Errors: invalid_value (a hand that no kiosk has; a place, where one is asked for, that check() below refuses).
[[nodiscard]] Expected<void> check(const DeviceRequest& request);
/// Errors: invalid_value (numbers that are not finite or beyond their limits).
[[nodiscard]] Expected<void> check(const DevicePlace& place);

}  // namespace mechane::client
