// What a driver's process and the haptic loop share: the newest state of the hand one way, the newest force the other.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include <semaphore.h>

#include "client-sdk/haptic/device.hpp"
#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/realtime/mailbox.hpp"
#include <mechane/driver.h>

namespace mechane::haptic {

/// A force on its way to the device, or a state on its way from it. Both processes read the same clock.
template <class T>
struct Timed {
  T value{};
  TimePoint at;
};

/// Lies in memory that two processes map. Each mailbox has one producer and one consumer; a semaphore is posted with each value, so that
/// the other side can wait for it.
struct DriverLink {
  /// The driver's process renders no force that is older: the loop has died, hangs, or was stopped.
  static constexpr Duration kSilent = std::chrono::milliseconds(20);

  std::uint64_t size = sizeof(DriverLink);  ///< tells two builds apart
  sem_t state_came;
  sem_t force_came;
  realtime::Mailbox<Timed<mechane_device_state>> states;
  realtime::Mailbox<Timed<mechane_device_force>> forces;
  std::atomic<Duration> longest_read{Duration{0}};  ///< what one call of the driver's read() took
};

/// What the driver's process tells beside the link, over a socket whose end tells it to let the device go.
struct HostNews {
  enum class Kind : std::uint32_t {
    opened,   ///< `info` says what the device is
    refused,  ///< the device did not open, `text` says why; the process ends
    lost,     ///< the device failed, `text` says why; it is tried again each second
    back,     ///< it has opened again
  };
  Kind kind = Kind::refused;
  mechane_device_info info{};
  std::array<char, 512> text{};
};
/// The files that a driver's process finds open.
inline constexpr int kLinkFile = 3;
inline constexpr int kNewsFile = 4;

/// What a driver says of its device. Where it says several things, the one that lasts longest.
[[nodiscard]] inline DeviceCondition condition_of(const mechane_device_state& state) noexcept {
  if ((state.flags & MECHANE_STATE_UNCALIBRATED) != 0) return DeviceCondition::uncalibrated;
  if ((state.flags & MECHANE_STATE_HOT) != 0) return DeviceCondition::hot;
  if ((state.flags & MECHANE_STATE_DEAD_MAN) != 0) return DeviceCondition::let_go;
  return (state.flags & MECHANE_STATE_READY) != 0 ? DeviceCondition::ready : DeviceCondition::not_ready;
}

/// The size of a hand, as its driver tells it. What the driver does not measure follows from `hand_scale`.
[[nodiscard]] hand::HandBuild build_of(hand::HandSide side, const mechane_device_state& state,
                                       double hand_scale) noexcept;

/// Whether a device in this state may be given a force.
[[nodiscard]] inline bool may_render(const mechane_device_state& state) noexcept {
  return condition_of(state) == DeviceCondition::ready;
}

/// What may be rendered at `now` of the newest force.
[[nodiscard]] inline mechane_device_force due(const Timed<mechane_device_force>& newest, TimePoint now) noexcept {
  return now - newest.at <= DriverLink::kSilent ? newest.value : mechane_device_force{};
}

/// Until `until`: true as soon as it was posted. Posts that nobody waited for are taken together. No allocation.
[[nodiscard]] bool wait_for(sem_t& semaphore, TimePoint until) noexcept;

/// A mapping of a DriverLink. The memory lives as long as one process maps it.
class SharedLink {
 public:
  /// A new link, for this process and one that gets its file(). Error: no memory.
  [[nodiscard]] static Expected<SharedLink> make();
  /// The link of another process, from the file that it gave to this one. Errors: no such file, another build's link.
  [[nodiscard]] static Expected<SharedLink> attach(int file);
  ~SharedLink();
  SharedLink(SharedLink&& other) noexcept;
  SharedLink& operator=(SharedLink&&) = delete;

  [[nodiscard]] DriverLink& operator*() const noexcept { return *link_; }
  [[nodiscard]] DriverLink* operator->() const noexcept { return link_; }
  [[nodiscard]] int file() const noexcept { return file_; }

 private:
  SharedLink(int file, DriverLink* link) : file_(file), link_(link) {}
  int file_;
  DriverLink* link_;
};

}  // namespace mechane::haptic
