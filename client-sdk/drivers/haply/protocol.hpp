// The JSON messages of Haply's local service, formats 3.1 and 3.5: what it says of an Inverse3 and a grip, and what it
// is told.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mechane::drivers {

/// In Haply's axes: x right, y away from the visitor, z up. Metres or newtons.
using HaplyVector = std::array<double, 3>;

/// How a force is keyed: `values` in format 3.1, `vector` in format 3.5. The service ignores the other one without a
/// word.
enum class HaplyKey { values, vector };

/// What one message says of the arm that was asked for, and of the first grip.
struct HaplyFrame {
  std::string device_id;
  HaplyVector cursor_position_m{};
  HaplyVector cursor_force_n{};                 ///< what the service renders now, of all its clients together
  bool calibrated = true;                       ///< this and the next stay as they were where a message has no status
  bool ready = true;                            ///< calibrated, powered and ready
  bool has_grip = false;                        ///< there is a grip, and its data are whole
  std::array<double, 4> grip_wxyz{1, 0, 0, 0};  ///< unit quaternion in Haply's axes; stays as it was without a grip
  std::uint32_t grip_buttons = 0;               ///< bit 0: the first (a, button_0 or button)
  std::string basis = "XYZ";                    ///< of the first message: how the service permutes the axes
};

enum class HaplyMessage { state, no_device, malformed };

struct HaplyParse {
  HaplyMessage kind;
  const char* why;  ///< of a malformed message, for people: "it is not JSON"; otherwise empty
};

/// Reads a message into `frame`, which stays as it was unless the message is a state. `device` is the id of the arm;
/// empty: the first. nlohmann::json allocates a tree here for every message. Any thread; bytes from outside may be
/// anything.
[[nodiscard]] HaplyParse parse_haply(std::string_view text, std::string_view device, HaplyFrame& frame);

/// "049D, 04BA": the arms in a message, for people. "none" where there is none.
[[nodiscard]] std::string haply_devices(std::string_view text);

/// Major and minor version, as in {3, 5}, out of what the service answers to GET /version.
[[nodiscard]] std::optional<std::pair<int, int>> parse_haply_version(std::string_view text);

/// Letters, digits, - and _: what may stand in a command without an escape.
[[nodiscard]] bool is_haply_id(std::string_view text);

/// Writes the command that renders a force (N, finite) for one tick. Allocates nothing once `out` is large enough.
void write_haply_force(std::string& out, std::string_view device, HaplyKey key, const HaplyVector& force_n);

/// Writes the first command of format 3.5, with no force. It registers this client by name and puts the origin in the
/// middle of the workspace, which earlier formats cannot.
void write_haply_greeting(std::string& out, std::string_view device);

/// Between Haply's axes and frame D of mechane/driver.h.
[[nodiscard]] constexpr HaplyVector haply_to_d(const HaplyVector& v) {
  return {v[0], v[2], -v[1]};
}
[[nodiscard]] constexpr HaplyVector d_to_haply(const HaplyVector& v) {
  return {v[0], -v[2], v[1]};
}

}  // namespace mechane::drivers
