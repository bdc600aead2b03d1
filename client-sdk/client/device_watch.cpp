#include "client-sdk/client/device_watch.hpp"

#include <utility>

#include "client-sdk/client/parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {

Expected<std::unique_ptr<DeviceWatch>> DeviceWatch::create(const proto::Participant& participant,
                                                           const std::string& kiosk, std::function<void()> changed) {
  std::unique_ptr<DeviceWatch> made(new DeviceWatch(kiosk, std::move(changed)));
  auto reader =
      proto::Reader<proto::KioskStatus>::create(participant, "", [raw = made.get()](auto view) { raw->take(view); });
  if (!reader) return tl::unexpected(reader.error());
  made->reader_ = std::move(*reader);
  return made;
}

void DeviceWatch::take(proto::ReaderView<proto::KioskStatus> view) {
  view.take_each([this](const proto::KioskStatus& wire, const proto::SampleInfo& info) {
    KioskDevice device{std::string(proto::text_of(wire.kiosk)), {}};
    if (!kiosk_.empty() && device.kiosk != kiosk_) return;
    const std::size_t most = kiosk_.empty() ? kMostSessions : kSessions;
    const std::lock_guard lock(mutex_);
    if (!info.alive) {
      devices_.erase(wire.session);
    } else if (info.valid && parse(wire, device.report) &&
               (devices_.size() < most || devices_.contains(wire.session))) {
      devices_[wire.session] = std::move(device);
    }
  });
  if (changed_) changed_();
}

std::map<std::uint64_t, KioskDevice> DeviceWatch::devices() {
  const std::lock_guard lock(mutex_);
  return devices_;
}

}  // namespace mechane::client
