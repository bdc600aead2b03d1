// KioskLink: one kiosk's haptic endpoints. Its listener checks each sample and puts it into the hand's channel.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "server/transport/hand_channel.hpp"
#include "server/transport/sent_times.hpp"
#include "server/transport/validate.hpp"
#include <mechane/proto/entity.hpp>

namespace mechane::transport {

/// Made and changed by the main thread. The listener runs on a thread of Cyclone's. write() is for the haptic publisher's thread.
class KioskLink {
 public:
  /// Samples whose round trip took longer are dropped, so that a queue in the network does not replay old motion. A mouse on a slow line
  /// still works.
  static constexpr Duration kTooLate = std::chrono::milliseconds(250);

  /// `rejects` outlives the link. Errors: DDS out of resources.
  [[nodiscard]] static Expected<std::shared_ptr<KioskLink>> create(const proto::Participant& participant,
                                                                   const std::string& kiosk, std::uint64_t epoch,
                                                                   RejectCounters& rejects, int fifo_priority);
  KioskLink(const KioskLink&) = delete;
  KioskLink& operator=(const KioskLink&) = delete;

  // Main thread.
  [[nodiscard]] const std::string& kiosk() const { return kiosk_; }
  /// The session whose samples of this hand are accepted; 0: none.
  void set_owner(std::uint32_t user, std::uint64_t session) { hands_[user].owner.store(session); }
  /// When the owner's last good sample came. TimePoint{}: none has come since the session got the hand.
  [[nodiscard]] TimePoint heard(std::uint32_t user) const {
    return TimePoint(Duration(hands_[user].heard_ns.load(std::memory_order_relaxed)));
  }
  void open(const std::shared_ptr<HandChannel>& channel);
  void close(const std::shared_ptr<HandChannel>& channel);
  /// Ends listening: after this call, no sample is put into a channel.
  void shut();

  /// For the haptic publisher's thread. False when DDS refused.
  bool write(const HandChannel& channel, const OutgoingForce& force) noexcept;

 private:
  struct Hand {
    std::atomic<std::uint64_t> owner{0};
    std::atomic<std::int64_t> heard_ns{0};
    std::shared_ptr<HandChannel> channel;  // under mutex_
    std::uint64_t next_sequence = 1;       // for the publisher; goes on when the hand moves to another world
    SentTimes sent;
  };

  KioskLink(std::string kiosk, std::uint64_t epoch, RejectCounters& rejects, int fifo_priority)
      : kiosk_(std::move(kiosk)), epoch_(epoch), rejects_(rejects), fifo_priority_(fifo_priority) {}
  void take(proto::ReaderView<proto::HapticInput> view) noexcept;
  [[nodiscard]] Reject accept(const proto::HapticInput& wire, TimePoint now) noexcept;
  [[nodiscard]] Reject check_delay(const proto::HapticInput& wire, TimePoint now) const noexcept;

  std::string kiosk_;
  std::uint64_t epoch_;
  RejectCounters& rejects_;
  int fifo_priority_;
  std::mutex mutex_;  // held briefly: by the listener to copy a sample, by the main thread to change a pointer
  std::array<Hand, hand::kMaxUsers> hands_;
  ArrivedSample arriving_;    // for the listener
  proto::HapticOutput wire_;  // for the publisher
  proto::Writer<proto::HapticOutput> writer_;
  proto::Reader<proto::HapticInput> reader_;  // last: its listener ends first
};

}  // namespace mechane::transport
