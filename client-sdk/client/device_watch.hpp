// DeviceWatch: what the programs of hands tell of their devices, at one kiosk or in the whole museum; requests to them.
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
  /// Returns the id with which the program answers in DeviceDetails; 0: it could not be sent.
  std::uint64_t ask(const std::string& kiosk, const DeviceRequest& request);

 private:
  DeviceWatch(std::string kiosk, std::function<void()> changed)
      : kiosk_(std::move(kiosk)), changed_(std::move(changed)) {}
  void take(proto::ReaderView<proto::KioskStatus> view);
  void take(proto::ReaderView<proto::DeviceStatus> view);
  [[nodiscard]] bool is_meant(std::string_view kiosk) const { return kiosk_.empty() || kiosk == kiosk_; }
  /// Whether one more session is heard. Under mutex_.
  template <class Known>
  [[nodiscard]] bool has_room(const Known& known, std::uint64_t session) const {
    return known.size() < (kiosk_.empty() ? kMostSessions : kSessions) || known.contains(session);
  }

  const std::string kiosk_;
  const std::function<void()> changed_;
  std::mutex mutex_;  // for what follows
  std::map<std::uint64_t, KioskDevice> devices_;
  std::map<std::uint64_t, DeviceDetails> details_;
  std::uint64_t asked_ = 0;
  proto::Writer<proto::DeviceRequest> requests_;
  // Declared last, so that their listeners end before the rest is destroyed.
  proto::Reader<proto::KioskStatus> reader_;
  proto::Reader<proto::DeviceStatus> details_reader_;
};

}  // namespace mechane::client
