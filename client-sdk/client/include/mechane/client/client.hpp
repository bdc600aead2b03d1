// A client of a Mechane server: joins a kiosk, sends the hand, receives force and scene, comes back by itself after a
// loss.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/base/error.hpp"
#include <mechane/client/devices.hpp>
#include <mechane/client/displays.hpp>
#include <mechane/client/head.hpp>
#include <mechane/client/types.hpp>

namespace mechane::client {

/// What a process at a kiosk does. A kiosk has one `hand` session per user, and any number of watchers.
enum class Role { hand, watcher };

struct ClientConfig {
  std::string kiosk = "kiosk-1";  ///< 1 to 31 characters: letters, digits, - and _
  std::uint32_t user = 0;         ///< which hand of the kiosk, 0..3
  Role role = Role::watcher;
  std::string program = "client";  ///< for logs and status: "mechane-display"
  std::string scenario{};    ///< id of the scenario that opens where the kiosk has no world; empty: the server's first
  std::string join_kiosk{};  ///< request: share the world of this kiosk; empty: a world of one's own
  int fifo_priority =
      0;  ///< SCHED_FIFO priority of the thread that receives forces; 0, or not permitted: an ordinary thread
  std::uint32_t domain = 0;  ///< DDS domain; the network is set up by CYCLONEDDS_URI
  /// For a weak network: the server may leave out forces while they differ from the last one by no more than this share,
  /// 0 to 0.5; 0: it sends one each millisecond. A HapticLoop on this client needs the same. See server/hand/deadband.hpp.
  double deadband = 0;
  std::string display{};  ///< for a display: its name among the kiosk's displays; empty: this client is not a display
};

enum class LinkState {
  searching,  ///< no server has answered yet
  joined,     ///< in a world
  refused,    ///< another session owns this hand: see refusal()
  lost,       ///< the server fell silent; joined again by itself when it is back
};

/// "searching", "joined", "refused" or "lost".
[[nodiscard]] std::string_view link_name(LinkState state);

/// Owns the DDS endpoints and one thread that keeps the link. The functions may be called from any thread, by one
/// thread at a time; send(), newest_force() and newest_frame() never block and are meant for a 1 kHz loop (send()
/// writes to the network: about 30 us). Example (compiled by the suite as client-sdk/examples/):
///
///   auto client = mechane::client::Client::connect({.kiosk = "kiosk-1", .role = mechane::client::Role::hand});
///   (*client)->send(hand);
///   if (auto force = (*client)->newest_force()) render(force->force_W.f);
class Client {
 public:
  /// Starts; returns at once, in state `searching`. Errors: a bad name, no network interface, wrong CYCLONEDDS_URI.
  [[nodiscard]] static Expected<std::unique_ptr<Client>> connect(const ClientConfig& config);
  virtual ~Client() = default;

  [[nodiscard]] virtual LinkState state() const = 0;
  /// Waits until the state is `wanted`, at most `timeout`. True when it is.
  [[nodiscard]] virtual bool wait_for(LinkState wanted, Duration timeout) = 0;
  /// Why the server refused this client, and what to do; empty while it is not refused.
  [[nodiscard]] virtual std::string refusal() const = 0;
  [[nodiscard]] virtual std::uint64_t session() const = 0;

  /// Sends one sample of the hand (role `hand`, state `joined`; otherwise nothing is sent and false returned).
  virtual bool send(const HandSample& input) noexcept = 0;
  /// Sequence number of the last sample that was sent.
  [[nodiscard]] virtual std::uint64_t sent_sequence() const noexcept = 0;
  /// The newest force, if one arrived since the last call.
  [[nodiscard]] virtual std::optional<ForceSample> newest_force() noexcept = 0;
  /// Waits for a force newer than the last one taken, at most `timeout`. For round-trip measurements.
  [[nodiscard]] virtual std::optional<ForceSample> wait_force(Duration timeout) = 0;

  /// The newest frame, as it came; false when none has come yet.
  [[nodiscard]] virtual bool newest_frame(Frame& out) = 0;
  /// The scene at `at - delay`, interpolated between the two frames around it (positions linear, rotations by slerp),
  /// extrapolated by at most 50 ms. A display calls it with delay of about two frames. False when no frame has come
  /// yet.
  [[nodiscard]] virtual bool interpolated_frame(TimePoint at, Duration delay, Frame& out) = 0;

  [[nodiscard]] virtual std::vector<SceneObject> objects() const = 0;  ///< the manifest as known so far
  [[nodiscard]] virtual std::optional<WorldStatus> world_status() const = 0;
  /// Of the world that the client is in; null until it has come.
  [[nodiscard]] virtual std::shared_ptr<const WorldPresentation> presentation() const = 0;
  [[nodiscard]] virtual std::optional<ServerStatus> server_status() const = 0;
  /// Events since the last call, oldest first (the last 256 are kept).
  [[nodiscard]] virtual std::vector<WorldEvent> take_events() = 0;

  /// Sends a command to the world; returns its id, which is the value of the command_done or command_refused event that
  /// answers it. 0, and nothing sent, while there is no world.
  virtual std::uint64_t start_activity(const std::string& activity) = 0;
  virtual std::uint64_t restart_activity() = 0;
  virtual std::uint64_t next_step() = 0;
  /// A click on an object of the manifest: a sign that is touched with a mouse.
  virtual std::uint64_t click(const std::string& object) = 0;
  /// Lets the kiosks of this world go on to another scenario; empty: home, the server's first. ServerStatus::scenarios
  /// has the ids. The answer is a new world (see world_status()), or the event command_refused.
  virtual std::uint64_t open_exhibit(const std::string& scenario) = 0;
  /// Stored with the visit, anonymously. command_refused where the world has no such question or answer.
  virtual std::uint64_t answer(const VisitAnswer& answer) = 0;
  /// For a display: says in which language it shows this world from now on, one of WorldPresentation::languages. Stored
  /// with the visit.
  virtual std::uint64_t tell_language(const std::string& language) = 0;

  /// For a haptic program (role `hand`): tells the kiosk's displays of its device, at once when it is another report than
  /// the last. Takes a lock: not for the loop's thread.
  virtual void tell_device(const DeviceReport& /*report*/) {}
  /// For a haptic program: tells staff of its open device; once a second. False where it could not be sent.
  virtual bool tell_details(const DeviceDetails& /*details*/) { return false; }
  /// For a haptic program: requests to this hand since the last call, oldest first. Each is answered in tell_details().
  [[nodiscard]] virtual std::vector<DeviceRequest> take_device_requests() { return {}; }

  // The following functions are for displays only; haptic programs have devices(), too.

  /// The devices of this kiosk's hands, by user. A program that ended or lost the network disappears within 3 s.
  [[nodiscard]] virtual std::vector<DeviceReport> devices() { return {}; }
  /// What the programs of these devices tell staff, by user.
  [[nodiscard]] virtual std::vector<DeviceDetails> device_details() { return {}; }
  /// Asks the program of a hand of this kiosk. Returns the id with which it answers in its details; 0 where the request could not be sent.
  /// Errors: a hand that no kiosk has, a place that check() refuses.
  [[nodiscard]] virtual Expected<std::uint64_t> ask_device(const DeviceRequest& /*request*/) { return 0; }

  /// SceneFrames that were received and that were lost, in this and former worlds.
  [[nodiscard]] virtual FrameTraffic frame_traffic() const { return {}; }
  /// Sends this display's status; once a second, so that watchers know that it is alive. False where the client is not
  /// a display (ClientConfig::display) or the status could not be sent.
  virtual bool report(const DisplayStatus& /*status*/) { return false; }
  /// Requests to this display since the last call, oldest first. Answer each in the next status.
  [[nodiscard]] virtual std::vector<DisplayRequest> take_display_requests() { return {}; }
  /// Where a tracker last saw the visitor's head; empty: no tracker has sent anything yet, or the client is not a
  /// display.
  [[nodiscard]] virtual std::optional<ViewerHead> viewer_head() { return {}; }
};

}  // namespace mechane::client
