// From the wire to the client's own structs. An invalid sample is refused as a whole, so that no later code checks
// again.
#pragma once

#include <optional>

#include <mechane/client/displays.hpp>
#include <mechane/client/head.hpp>
#include <mechane/client/types.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::client {

inline constexpr std::size_t kMaxObjects = 100'000;
inline constexpr std::size_t kMaxQuantities = 10'000;
inline constexpr std::size_t kMaxHands = 16;
inline constexpr std::size_t kMaxRopes = 64;
inline constexpr std::size_t kMaxRopePoints = 1024;
inline constexpr std::size_t kMaxSettings = 64;  ///< of one request or status
inline constexpr std::size_t kMaxListed = 64;    ///< missing files or answers of one status

/// All of these return false, with `out` in an unspecified state, where the sample is of another protocol version, a
/// number is not finite, a rotation is not a unit quaternion, or a count is beyond its limit. The caller sets times of
/// receipt and its own sequence numbers.
/// This one allocates nothing. Also checked: normals of contacts and the axis of a held object's path are of unit
/// length, and a circle's radius is over 0. A path is read only where something is held. Stiffness, damping, friction
/// and limit become 0 where they are negative; contacts and path are valid for a second at most.
[[nodiscard]] bool parse(const proto::HapticOutput& wire, ForceSample& out) noexcept;
[[nodiscard]] bool parse(const proto::SceneFrame& wire, Frame& out);
[[nodiscard]] bool parse(const proto::SceneObject& wire, SceneObject& out);
[[nodiscard]] bool parse(const proto::WorldStatus& wire, WorldStatus& out);
[[nodiscard]] bool parse(const proto::WorldPresentation& wire, WorldPresentation& out);
[[nodiscard]] bool parse(const proto::Event& wire, WorldEvent& out);
[[nodiscard]] bool parse(const proto::ServerStatus& wire, ServerStatus& out);
/// Also checked: display and kiosk have valid names; numbers are not negative, shares at most 1.
[[nodiscard]] bool parse(const proto::DisplayStatus& wire, DisplayStatus& out);
/// Only of a session with the role `hand`. Also checked: the kiosk has a valid name; user, state and kind of hand exist.
[[nodiscard]] bool parse(const proto::KioskStatus& wire, DeviceReport& out);
/// The requested settings are not checked here, but by apply().
[[nodiscard]] bool parse(const proto::DisplayRequest& wire, DisplayRequest& out);
/// Also checked: the kiosk has a valid name. The position is limited where it is used.
[[nodiscard]] bool parse(const proto::ViewerHead& wire, ViewerHead& out);

/// What a WorldAssignment means for one kiosk.
struct Assignment {
  std::string server;
  std::uint64_t incarnation = 0;
  std::uint64_t epoch = 0;
  std::string world;
  std::string trouble;
  std::string no_room;
  struct Owner {
    std::uint64_t session = 0;
    std::string program;
    std::string host;
  };
  std::array<Owner, hand::kMaxUsers> owners;
};
[[nodiscard]] bool parse(const proto::WorldAssignment& wire, Assignment& out);

/// For a server of another protocol version than this program's: which server it is, and what to do. Empty for the same
/// version.
[[nodiscard]] std::string other_protocol(const proto::ServerStatus& wire);

}  // namespace mechane::client
