// DeviceWatch: what the programs of a kiosk's hands tell of their devices.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <mechane/client/types.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// Any thread.
class DeviceWatch {
 public:
  static constexpr std::size_t kSessions = 16;  ///< with a device, at one kiosk; further ones are not heard

  [[nodiscard]] static Expected<std::unique_ptr<DeviceWatch>> create(const proto::Participant& participant,
                                                                     const std::string& kiosk);
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  /// By the session that told it.
  [[nodiscard]] std::map<std::uint64_t, DeviceReport> devices();

 private:
  explicit DeviceWatch(std::string kiosk) : kiosk_(std::move(kiosk)) {}
  void take(proto::ReaderView<proto::KioskStatus> view);

  std::string kiosk_;
  std::mutex mutex_;  // for what follows
  std::map<std::uint64_t, DeviceReport> devices_;
  proto::Reader<proto::KioskStatus> reader_;  // last, so that its listener ends before the rest is destroyed
};

}  // namespace mechane::client
