// KioskLink: one kiosk's haptic endpoints. Its listener is the door: it checks each sample and gives it to the hand's lane.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "server/transport/lane.hpp"
#include "server/transport/validate.hpp"
#include <mechane/proto/entity.hpp>

namespace mechane::transport {

/// Made and changed by the main thread; the listener runs on a thread of Cyclone's; write() is the haptic publisher's.
class KioskLink {
 public:
  /// `rejects` outlives the link. Errors: DDS out of resources.
  [[nodiscard]] static Expected<std::shared_ptr<KioskLink>> create(const proto::Participant& participant,
                                                                   const std::string& kiosk, std::uint64_t epoch,
                                                                   RejectCounters& rejects, int fifo_priority);
  KioskLink(const KioskLink&) = delete;
  KioskLink& operator=(const KioskLink&) = delete;

  // Main thread.
  [[nodiscard]] const std::string& kiosk() const { return kiosk_; }
  /// Whose samples of this hand count; 0: nobody's.
  void set_owner(std::uint32_t user, std::uint64_t session) { hands_[user].owner.store(session); }
  /// When the owner's last good sample came; none since it got the hand: TimePoint{}.
  [[nodiscard]] TimePoint heard(std::uint32_t user) const {
    return TimePoint(Duration(hands_[user].heard_ns.load(std::memory_order_relaxed)));
  }
  void open(const std::shared_ptr<Lane>& lane);
  void close(const std::shared_ptr<Lane>& lane);
  /// Ends listening: the reader goes, and with it the last call into lanes.
  void shut();

  /// Haptic publisher's thread. False when DDS refused.
  bool write(const Lane& lane, const OutgoingForce& force) noexcept;

 private:
  struct Hand {
    std::atomic<std::uint64_t> owner{0};
    std::atomic<std::int64_t> heard_ns{0};
    std::shared_ptr<Lane> lane;       // under mutex_
    std::uint64_t next_sequence = 1;  // the publisher's: goes on when the hand moves to another world
  };

  KioskLink(std::string kiosk, std::uint64_t epoch, RejectCounters& rejects, int fifo_priority)
      : kiosk_(std::move(kiosk)), epoch_(epoch), rejects_(rejects), fifo_priority_(fifo_priority) {}
  void take(proto::ReaderView<proto::HapticInput> view) noexcept;
  [[nodiscard]] Reject accept(const proto::HapticInput& wire, TimePoint now) noexcept;

  std::string kiosk_;
  std::uint64_t epoch_;
  RejectCounters& rejects_;
  int fifo_priority_;
  std::mutex mutex_;  // held by the listener for a copy, by the main thread for a swap of pointers
  std::array<Hand, hand::kMaxUsers> hands_;
  ArrivedSample arriving_;    // the listener's
  proto::HapticOutput wire_;  // the publisher's
  proto::Writer<proto::HapticOutput> writer_;
  proto::Reader<proto::HapticInput> reader_;  // last: its listener ends first
};

}  // namespace mechane::transport
