// DeviceLink: a haptic program's endpoints beside its hand: tells staff of its device, and receives their requests.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "client-sdk/client/request_queue.hpp"
#include <mechane/client/devices.hpp>
#include <mechane/proto/entity.hpp>

namespace mechane::client {

/// tell() and take_requests() are called by one thread.
class DeviceLink {
 public:
  [[nodiscard]] static Expected<std::unique_ptr<DeviceLink>> create(const proto::Participant& participant,
                                                                    const std::string& kiosk, std::uint32_t user,
                                                                    std::uint64_t session);
  DeviceLink(const DeviceLink&) = delete;
  DeviceLink& operator=(const DeviceLink&) = delete;

  /// False where it could not be sent.
  bool tell(const DeviceDetails& details);
  [[nodiscard]] std::vector<DeviceRequest> take_requests() { return requests_.take(); }

 private:
  DeviceLink(std::string kiosk, std::uint32_t user, std::uint64_t session)
      : kiosk_(std::move(kiosk)), user_(user), session_(session) {}
  void take(proto::ReaderView<proto::DeviceRequest> view);

  const std::string kiosk_;
  const std::uint32_t user_;
  const std::uint64_t session_;
  std::uint64_t sequence_ = 0;
  RequestQueue<DeviceRequest, 8> requests_;
  proto::Writer<proto::DeviceStatus> statuses_;
  proto::Reader<proto::DeviceRequest> reader_;  // last, so that its listener ends before the rest is destroyed
};

}  // namespace mechane::client
