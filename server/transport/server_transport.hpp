// The DDS side of the server: who is at which kiosk, and the ports through which worlds reach the network.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/realtime/histogram.hpp"
#include "server/transport/exhibit_gate.hpp"
#include "server/transport/exhibit_status.hpp"
#include "server/transport/session_table.hpp"
#include "server/transport/validate.hpp"
#include "server/transport/world_port.hpp"

namespace mechane::transport {

struct TransportConfig {
  std::string server = "server-1";       ///< name on the wire: 1 to 31 characters of A-Z a-z 0-9 - _
  std::string version{};                 ///< of the program
  std::vector<std::string> scenarios{};  ///< ids of what a kiosk may ask for, home first; see set_scenarios()
  std::optional<proto::ExhibitKey>
      exhibit_key{};         ///< that requests about exhibits are sealed with; none: none are taken
  std::uint32_t domain = 0;  ///< DDS domain, 0 .. 230; the network is set up by CYCLONEDDS_URI
  int fifo_priority =
      0;  ///< SCHED_FIFO of the threads that receive hands and write forces, 0 .. 98; 0: ordinary threads
  std::optional<int> cpu{};  ///< pins the thread that writes forces to this processor
};

/// Over all loops. Times in microseconds: a tick's own CPU time, and how late the loop woke.
struct LoopFigures {
  std::uint64_t ticks = 0, overruns = 0, late_wakeups = 0, preemptions = 0;
  std::uint64_t skipped = 0;  ///< is not sent
  double tick_us_median = 0, tick_us_p99 = 0, tick_us_p999 = 0, tick_us_max = 0;
  double wake_us_p99 = 0, wake_us_max = 0;
  bool realtime = false;
};

/// The server's status. Fields as in ServerStatus of idl/mechane.idl; the transport adds name, version and its own counts.
struct ServerStatusData {
  std::uint32_t worlds = 0;
  std::uint32_t worlds_limit = 0;
  std::uint32_t users = 0;
  LoopFigures loops{};
  bool records_ok = true;
  double input_gap_ms = 0;  ///< the longest pause of a hand in the last ten seconds
  std::string overload{};   ///< what the server is too slow for, and what to do; empty: nothing
};

/// What happened at the kiosks since the last poll, in order.
enum class NewsKind {
  kiosk_appeared,    ///< its first session came: give it a world, as the session asks
  session_appeared,  ///< any session, after kiosk_appeared for the first; its requests may differ
  hand_granted,      ///< the session owns its kiosk's hand `user` now: bind it
  hand_freed,        ///< the session does not own it any more: unbind it
  session_left,      ///< unregistered, or silent for 3 s
  kiosk_left,        ///< its last session has left; hand_freed came before
};

struct News {
  NewsKind kind;
  Session session;
};

/// Owns the participant, all endpoints and two threads: one writes only HapticOutput, one writes everything else. Listeners check
/// and copy samples on Cyclone's own threads. Every function is for the main thread; the loops use only their WorldPort.
///
///   auto transport = *ServerTransport::start({.server = "server-1"});
///   for (const News& n : transport->poll(clock.now())) ...          // 20 times a second or more
///     kiosk_appeared: port = *transport->open_world("w1", description); transport->assign_kiosk(n.session.kiosk, *port);
///     hand_granted:   port->bind_user(port->free_slot(), n.session.kiosk, n.session.user, n.session.id);
class ServerTransport {
 public:
  /// Errors: invalid_value (the server's name), and those of proto::Participant::create. A refused SCHED_FIFO is not an error: see
  /// fifo_granted().
  [[nodiscard]] static Expected<std::unique_ptr<ServerTransport>> start(const TransportConfig& config);
  /// Worlds must be closed, or their loops stopped.
  ~ServerTransport();
  ServerTransport(const ServerTransport&) = delete;
  ServerTransport& operator=(const ServerTransport&) = delete;

  /// Reads what kiosks sent, decides who owns which hand, and tells the kiosks. Call it 20 times a second or more. Never blocks long.
  [[nodiscard]] std::vector<News> poll(TimePoint now);
  [[nodiscard]] const SessionTable& sessions() const;

  /// Makes a world's endpoints and publishes its manifest. `world` is a name of 1 to 31 characters that no open world has. The port
  /// lives until close_world(). Errors: invalid_value (the name), duplicate, io_failure (DDS out of resources).
  [[nodiscard]] Expected<WorldPort*> open_world(const std::string& world,
                                                std::shared_ptr<const state::WorldDescription> description);
  /// The world's loop must not use the port any more. Kiosks assigned to the world are without one afterwards.
  void close_world(WorldPort& port);

  /// Tells a kiosk which world it is in.
  void assign_kiosk(const std::string& kiosk, const WorldPort& port);
  /// Tells a kiosk that it gets no world. `why` is shown to people.
  void refuse_kiosk(const std::string& kiosk, const std::string& why);

  /// The server's status from now on; it is sent ten times a second.
  void publish_server_status(const ServerStatusData& data);

  /// What kiosks may ask for from now on, home first.
  void set_scenarios(const std::vector<std::string>& scenarios);
  /// Whether set_scenarios() can take this id: there is a limit on how many different ones a server has in its life.
  [[nodiscard]] bool has_room_for(const std::string& scenario) const;
  /// The id of WorldPort::take_request()'s number.
  [[nodiscard]] const std::string& scenario(std::uint32_t number) const;
  /// The requests about exhibits that have come since the last call, each sealed with our key and taken once. Others are logged and
  /// dropped. Answer each in publish_exhibits().
  [[nodiscard]] std::vector<ExhibitOrder> take_exhibit_orders(TimePoint now);
  /// Tells of the exhibits and of answers, where anything has changed.
  void publish_exhibits(ExhibitStatusData data);

  [[nodiscard]] bool fifo_granted() const;
  [[nodiscard]] const RejectCounters& rejected() const;
  /// How long a dds_write of HapticOutput takes.
  [[nodiscard]] const realtime::LatencyHistogram& haptic_write_time() const;
  [[nodiscard]] std::uint64_t haptic_writes_failed() const;
  /// How often a hand that was sending paused for 10 to 100 ms, and the longest of these pauses since the last call.
  [[nodiscard]] std::uint64_t input_gaps() const;
  [[nodiscard]] Duration take_longest_input_gap();

 private:
  class Impl;
  explicit ServerTransport(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::transport
