// The devices without hardware by name, "virtual:kind=glove", and the hand that `mechane haptic` gives them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "client-sdk/haptic/simulated_stylus.hpp"
#include "client-sdk/haptic/virtual_device.hpp"
#include "server/base/error.hpp"

namespace mechane::haptic {

inline constexpr std::string_view kVirtualName = "virtual";
inline constexpr std::string_view kVirtualSummary =
    "no hardware: a simulated stylus of the Phantom's class, a glove, or a hand before a camera";
inline constexpr std::string_view kVirtualOptions =
    "kind=phantom|glove|tracked delay=0..20 hand=on|off|right|left resolution=METRES continuous=NEWTONS";

/// Which device without hardware.
struct VirtualChoice {
  client::HandKind hand = client::HandKind::one_point;
  client::HandSide side = client::HandSide::right;
  bool tracked = false;                      ///< a whole hand is before a camera: a TrackedHand, not a VirtualDevice
  StylusConfig stylus{.hand = ArmConfig{}};  ///< of one point
};

/// "kind=phantom,delay=1". Errors: an option that this kind does not have, a value out of its range.
[[nodiscard]] Expected<VirtualChoice> read_virtual_options(const std::string& options);

/// At rest at `p_WH`.
[[nodiscard]] std::unique_ptr<SimulatedDevice> make_virtual_device(const VirtualChoice& choice, const Vec3& p_WH);

/// A hand that strokes a circle in the x-y plane around `center`, once in four seconds; a whole hand also closes and opens once.
[[nodiscard]] HandIntent stroke(client::HandKind kind, const Vec3& center, double radius_m, double t_s);

/// The hand of a visitor who shows at `p_WH` what a calibration asks for; where it asks for nothing, the hand opens and closes.
[[nodiscard]] HandIntent show(client::CalibrationStep asked, const Vec3& p_WH, double t_s);

}  // namespace mechane::haptic
