// HandLink: a client's 1 kHz endpoints: its hand out, its force in.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "server/hand/freshness.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// Lives as long as its client. send() is called by one thread, newest_force() and wait_force() by one thread.
class HandLink {
 public:
  [[nodiscard]] static Expected<std::unique_ptr<HandLink>> create(const proto::Participant& participant,
                                                                  const ClientConfig& config, std::uint64_t session);
  HandLink(const HandLink&) = delete;
  HandLink& operator=(const HandLink&) = delete;

  /// Both endpoints are connected to the server's.
  [[nodiscard]] bool matched() const { return writer_.matched() > 0 && reader_.matched() > 0; }
  /// Only forces of this epoch are taken. Others are out of date: from a server that was replaced, or from a link that
  /// it has since renewed. 0: no forces are taken.
  void accept_epoch(std::uint64_t epoch) { epoch_.store(epoch, std::memory_order_relaxed); }

  bool send(const HandSample& input) noexcept;
  [[nodiscard]] std::uint64_t sent_sequence() const noexcept { return sent_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::optional<ForceSample> newest_force() noexcept;
  [[nodiscard]] std::optional<ForceSample> wait_force(Duration timeout);

 private:
  HandLink(const ClientConfig& config, std::uint64_t session);
  void take_forces(proto::ReaderView<proto::HapticOutput> view) noexcept;

  std::string kiosk_;
  std::uint32_t user_;
  std::uint64_t session_;
  int fifo_priority_;
  std::atomic<std::uint64_t> epoch_{0};
  std::atomic<std::uint64_t> sent_{0};
  // Of the newest force. The epoch is written last and read first, so that a number is not taken for one of another epoch.
  std::atomic<std::uint64_t> heard_epoch_{0};
  std::atomic<std::uint64_t> heard_seq_{0};
  std::atomic<std::uint64_t> heard_at_ns_{0};
  proto::HapticInput sending_{};  // used by the sending thread only
  // Used by the force listener only. The server counts from 1 again in each epoch, but the numbers that are given out
  // must rise with each force.
  ForceSample arriving_;
  hand::SampleAge order_;
  std::uint64_t taken_ = 0;
  realtime::Mailbox<ForceSample> forces_;
  realtime::Wakeup arrived_;
  proto::Writer<proto::HapticInput> writer_;
  proto::Reader<proto::HapticOutput> reader_;  // declared last, so that its listener ends first
};

}  // namespace mechane::client
