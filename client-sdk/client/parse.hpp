// From the wire to the client's own structs. What is not fit to be used is refused as a whole: nothing behind checks again.
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
inline constexpr std::size_t kMaxTexts = 64;
inline constexpr std::size_t kMaxRopes = 64;
inline constexpr std::size_t kMaxRopePoints = 1024;
inline constexpr std::size_t kMaxAffordances = 4096;
inline constexpr std::size_t kMaxPresented = 256;  ///< activities, questions of one, answers of one, views, effects
inline constexpr std::size_t kMaxSettings = 64;    ///< of one request or status
inline constexpr std::size_t kMaxListed = 64;      ///< missing files or answers of one status

/// All of these return false, with `out` in no particular state, where the sample is of another protocol version, a number is not
/// finite, a rotation is not a unit quaternion, or a count is beyond its limit. Times of receipt and sequences of
/// one's own are the caller's.
/// This one allocates nothing.
[[nodiscard]] bool parse(const proto::HapticOutput& wire, ForceSample& out) noexcept;
[[nodiscard]] bool parse(const proto::SceneFrame& wire, Frame& out);
[[nodiscard]] bool parse(const proto::SceneObject& wire, SceneObject& out);
[[nodiscard]] bool parse(const proto::WorldStatus& wire, WorldStatus& out);
[[nodiscard]] bool parse(const proto::WorldPresentation& wire, WorldPresentation& out);
[[nodiscard]] bool parse(const proto::Event& wire, WorldEvent& out);
[[nodiscard]] bool parse(const proto::ServerStatus& wire, ServerStatus& out);
/// Of a display with a name at a kiosk with a name; numbers are finite and not negative, shares at most 1.
[[nodiscard]] bool parse(const proto::DisplayStatus& wire, DisplayStatus& out);
/// What is requested is not checked: apply() does.
[[nodiscard]] bool parse(const proto::DisplayRequest& wire, DisplayRequest& out);
/// Of a kiosk with a name. Where the head is, whoever uses it limits.
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

/// Where the server is of another protocol version than this program: who it is, and what to do. Empty where it is of ours.
[[nodiscard]] std::string other_protocol(const proto::ServerStatus& wire);

}  // namespace mechane::client
