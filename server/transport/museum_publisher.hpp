// MuseumPublisher: the thread that writes everything but HapticOutput. A reliable write may block it, but does not delay forces.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/realtime/wakeup.hpp"
#include "server/transport/exhibit_status.hpp"
#include "server/transport/world_endpoints.hpp"
#include <mechane/proto/entity.hpp>

namespace mechane::transport {

/// The content of a kiosk's WorldAssignment.
struct Assignment {
  std::uint64_t epoch = 0;  ///< of the kiosk's link
  std::string world;
  std::string trouble;
  std::string no_room;                          ///< why a program that comes now gets no hand; empty: it may get one
  std::array<Session, hand::kMaxUsers> owners;  ///< id 0: nobody
};

/// Owns one thread. All functions are for the main thread.
class MuseumPublisher {
 public:
  /// `status` has the fields that never change. The texts that they point at outlive this object.
  MuseumPublisher(proto::Writer<proto::ServerStatus> status_writer,
                  proto::Writer<proto::WorldAssignment> assignment_writer,
                  proto::Writer<proto::ExhibitStatus> exhibit_writer, const proto::ServerStatus& status);
  ~MuseumPublisher();
  MuseumPublisher(const MuseumPublisher&) = delete;
  MuseumPublisher& operator=(const MuseumPublisher&) = delete;

  /// Publishes the world's manifest, frames, status and events from now on.
  void add(std::unique_ptr<WorldEndpoints> writer);
  /// Ends this. When it returns, the thread does not use the port any more, and the endpoints are gone.
  void remove(const WorldPort& port);
  void assign(const std::string& kiosk, const Assignment& assignment);
  /// To be called when the kiosk is gone.
  void forget(const std::string& kiosk);
  /// The server's status from now on.
  void set_status(const proto::ServerStatus& status, const std::string& overload);
  /// ServerStatus.scenarios from now on.
  void set_scenarios(std::vector<std::string> scenarios);
  /// Publishes this once.
  void set_exhibits(const ExhibitStatusData& exhibits);
  [[nodiscard]] std::uint64_t writes_failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  void run();
  void write_assignments();
  void write_status(TimePoint now);
  void write_exhibits();
  void point_status_at_texts();

  struct Pending {
    Assignment assignment;
    bool gone = false;
  };
  std::mutex mutex_;  // guards the members from here to exhibits_
  std::vector<std::unique_ptr<WorldEndpoints>> worlds_;
  std::map<std::string, Pending> pending_;
  proto::ServerStatus status_;
  std::string overload_;  // status_ points at this and the next two
  std::vector<std::string> scenarios_;
  std::vector<char*> scenario_pointers_;
  std::optional<ExhibitStatusData> exhibits_;  // not written yet

  realtime::Wakeup wakeup_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> failed_{0};
  proto::Writer<proto::ServerStatus> status_writer_;
  proto::Writer<proto::WorldAssignment> assignment_writer_;
  proto::Writer<proto::ExhibitStatus> exhibit_writer_;
  std::uint64_t assignment_sequence_ = 0;
  std::uint64_t exhibit_sequence_ = 0;
  TimePoint next_status_{};
  std::thread thread_;  // last
};

}  // namespace mechane::transport
