// HandRecorder: writes a device's hand to a file that the driver `playback` plays.
#pragma once

#include <atomic>
#include <fstream>
#include <memory>
#include <string>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/realtime/ring.hpp"
#include <mechane/client/types.hpp>

namespace mechane::haptic {

/// note(): the loop's thread. All else: the main thread.
class HandRecorder {
 public:
  /// Overwrites the file. Error: it cannot be made.
  [[nodiscard]] static Expected<std::unique_ptr<HandRecorder>> open(const std::string& file);

  /// Never waits or allocates: a hand for which there is no room is lost, and counted.
  void note(const client::HandSample& hand, TimePoint now) noexcept;
  /// Writes what was noted; several times a second. Error: the disk is full, or gone; what was noted is lost.
  [[nodiscard]] Expected<void> write();
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  struct Noted {
    client::HandSample hand;
    TimePoint at;
  };
  HandRecorder(std::string name, std::ofstream file) : name_(std::move(name)), file_(std::move(file)) {}

  std::string name_;
  std::ofstream file_;
  realtime::Ring<Noted> noted_{4096};  // a second at the highest rate, and four at the usual one
  std::atomic<std::uint64_t> lost_{0};
  TimePoint first_;  // of the recording
};

}  // namespace mechane::haptic
