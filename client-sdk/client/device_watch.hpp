// DeviceWatch: what the programs of hands tell of their devices, at one kiosk or in the whole museum.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <mechane/client/displays.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// Any thread.
class DeviceWatch {
 public:
  static constexpr std::size_t kSessions = 16;        ///< with a device, at one kiosk; further ones are not heard
  static constexpr std::size_t kMostSessions = 1000;  ///< the same of all kiosks

  /// `kiosk` empty: all of them. `changed` is called on a thread of the network's; may be empty.
  [[nodiscard]] static Expected<std::unique_ptr<DeviceWatch>> create(const proto::Participant& participant,
                                                                     const std::string& kiosk,
                                                                     std::function<void()> changed = {});
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// By the session that told it.
  [[nodiscard]] std::map<std::uint64_t, KioskDevice> devices();

 private:
  DeviceWatch(std::string kiosk, std::function<void()> changed)
      : kiosk_(std::move(kiosk)), changed_(std::move(changed)) {}
  void take(proto::ReaderView<proto::KioskStatus> view);

  const std::string kiosk_;
  const std::function<void()> changed_;
  std::mutex mutex_;  // for what follows
  std::map<std::uint64_t, KioskDevice> devices_;
  proto::Reader<proto::KioskStatus> reader_;  // last, so that its listener ends before the rest is destroyed
};

}  // namespace mechane::client
