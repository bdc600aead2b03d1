#include "server/transport/museum_publisher.hpp"

#include <algorithm>
#include <chrono>

#include "server/base/thread_setup.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {
namespace {

constexpr Duration kLookEvery = std::chrono::milliseconds(4);
constexpr Duration kStatusEvery = std::chrono::milliseconds(100);

}  // namespace

MuseumPublisher::MuseumPublisher(proto::Writer<proto::ServerStatus> status_writer,
                                 proto::Writer<proto::WorldAssignment> assignment_writer,
                                 proto::Writer<proto::ExhibitStatus> exhibit_writer, const proto::ServerStatus& status)
    : status_(status),
      status_writer_(std::move(status_writer)),
      assignment_writer_(std::move(assignment_writer)),
      exhibit_writer_(std::move(exhibit_writer)) {
  point_status_at_texts();
  thread_ = std::thread([this] { run(); });
}

MuseumPublisher::~MuseumPublisher() {
  stop_.store(true, std::memory_order_release);
  wakeup_.signal();
  thread_.join();
}

void MuseumPublisher::run() {
  set_up_thread("museum-out");
  while (!stop_.load(std::memory_order_acquire)) {
    wakeup_.wait(kLookEvery);
    const std::lock_guard lock(mutex_);
    write_status(std::chrono::steady_clock::now());
    write_assignments();
    write_exhibits();
    for (const auto& world : worlds_) {
      const std::uint64_t before = world->writes_failed();
      world->write();
      failed_.fetch_add(world->writes_failed() - before, std::memory_order_relaxed);
    }
  }
}

void MuseumPublisher::write_status(TimePoint now) {
  if (now < next_status_) return;
  next_status_ = now + kStatusEvery;
  ++status_.seq;
  status_.sent_ns = to_ns(now);
  if (!status_writer_.write(status_)) failed_.fetch_add(1, std::memory_order_relaxed);
}

void MuseumPublisher::write_assignments() {
  for (const auto& [kiosk, pending] : pending_) {
    proto::WorldAssignment wire{};
    proto::set_text(wire.kiosk, kiosk);
    wire.trouble = proto::look_into(pending.assignment.trouble);
    wire.no_room = proto::look_into(pending.assignment.no_room);
    wire.protocol = proto::kProtocol;
    wire.seq = ++assignment_sequence_;
    wire.sent_ns = to_ns(std::chrono::steady_clock::now());
    std::copy(std::begin(status_.server), std::end(status_.server), wire.server);
    wire.incarnation = status_.incarnation;
    wire.epoch = pending.assignment.epoch;
    proto::set_text(wire.world, pending.assignment.world);
    for (std::size_t i = 0; i < pending.assignment.owners.size(); ++i) {
      wire.owners[i].session = pending.assignment.owners[i].id;
      proto::set_text(wire.owners[i].program, pending.assignment.owners[i].program);
      proto::set_text(wire.owners[i].host, pending.assignment.owners[i].host);
    }
    const bool written = pending.gone ? assignment_writer_.dispose(wire) : assignment_writer_.write(wire);
    if (!written) failed_.fetch_add(1, std::memory_order_relaxed);
  }
  pending_.clear();
}

void MuseumPublisher::add(std::unique_ptr<WorldEndpoints> writer) {
  const std::lock_guard lock(mutex_);
  writer->write_manifest();
  worlds_.push_back(std::move(writer));
}

void MuseumPublisher::remove(const WorldPort& port) {
  const std::lock_guard lock(mutex_);
  std::erase_if(worlds_, [&](const auto& writer) { return &writer->port() == &port; });
}

void MuseumPublisher::assign(const std::string& kiosk, const Assignment& assignment) {
  {
    const std::lock_guard lock(mutex_);
    pending_[kiosk] = {assignment, false};
  }
  wakeup_.signal();
}

void MuseumPublisher::forget(const std::string& kiosk) {
  const std::lock_guard lock(mutex_);
  pending_[kiosk] = {{}, true};
}

void MuseumPublisher::set_status(const proto::ServerStatus& status, const std::string& overload) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t sequence = status_.seq;
  status_ = status;
  status_.seq = sequence;
  overload_ = overload;
  point_status_at_texts();
}

void MuseumPublisher::point_status_at_texts() {
  status_.overload = proto::look_into(overload_);
  proto::look_into(status_.scenarios, scenario_pointers_);
}

void MuseumPublisher::set_scenarios(std::vector<std::string> scenarios) {
  const std::lock_guard lock(mutex_);
  scenarios_ = std::move(scenarios);
  scenario_pointers_ = proto::pointers_to(scenarios_);
  point_status_at_texts();
}

void MuseumPublisher::set_exhibits(const ExhibitStatusData& exhibits) {
  {
    const std::lock_guard lock(mutex_);
    exhibits_ = exhibits;
  }
  wakeup_.signal();
}

void MuseumPublisher::write_exhibits() {
  if (!exhibits_) return;
  WireExhibits exhibits(*exhibits_);
  proto::ExhibitStatus& wire = exhibits.wire();
  std::copy(std::begin(status_.server), std::end(status_.server), wire.server);
  wire.incarnation = status_.incarnation;
  wire.seq = ++exhibit_sequence_;
  wire.sent_ns = to_ns(std::chrono::steady_clock::now());
  if (!exhibit_writer_.write(wire)) {
    failed_.fetch_add(1, std::memory_order_relaxed);
    return;  // again in the next round
  }
  exhibits_.reset();
}

}  // namespace mechane::transport
