// HandLink: a client's 1 kHz endpoints: its hand out, its force in.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "server/hand/freshness.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/types.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// Lives as long as its client. send() is one thread's, newest_force() and wait_force() are one thread's.
class HandLink {
 public:
  [[nodiscard]] static Expected<std::unique_ptr<HandLink>> create(const proto::Participant& participant,
                                                                  const std::string& kiosk, std::uint32_t user,
                                                                  std::uint64_t session, int fifo_priority);
  HandLink(const HandLink&) = delete;
  HandLink& operator=(const HandLink&) = delete;

  /// Both endpoints have found the server's.
  [[nodiscard]] bool matched() const { return writer_.matched() > 0 && reader_.matched() > 0; }
  /// Forces of another epoch are out of date: of a server that was replaced, or of a link that it has made anew. 0: none is taken.
  void accept_epoch(std::uint64_t epoch) { epoch_.store(epoch, std::memory_order_relaxed); }

  bool send(const HandSample& input) noexcept;
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept { return sent_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::optional<ForceSample> newest_force() noexcept;
  [[nodiscard]] std::optional<ForceSample> wait_force(Duration timeout);

 private:
  HandLink(std::string kiosk, std::uint32_t user, std::uint64_t session, int fifo_priority);
  void take_forces(proto::ReaderView<proto::HapticOutput> view) noexcept;

  std::string kiosk_;
  std::uint32_t user_;
  std::uint64_t session_;
  int fifo_priority_;
  std::atomic<std::uint64_t> epoch_{0};
  std::atomic<std::uint64_t> sent_{0};
  proto::HapticInput sending_{};  // the sender's
  // The force listener's. In a new epoch the server counts from 1 again; the numbers given out rise with each force, whatever its own is.
  ForceSample arriving_;
  hand::SampleAge order_;
  std::uint64_t taken_ = 0;
  realtime::Mailbox<ForceSample> forces_;
  realtime::Wakeup arrived_;
  proto::Writer<proto::HapticInput> writer_;
  proto::Reader<proto::HapticOutput> reader_;  // last: its listener ends first
};

}  // namespace mechane::client
