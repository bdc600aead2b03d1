#include "client-sdk/client/device_watch.hpp"

#include <utility>

#include "client-sdk/client/parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {

Expected<std::unique_ptr<DeviceWatch>> DeviceWatch::create(const proto::Participant& participant,
                                                           const std::string& kiosk) {
  std::unique_ptr<DeviceWatch> made(new DeviceWatch(kiosk));
  auto reader =
      proto::Reader<proto::KioskStatus>::create(participant, "", [raw = made.get()](auto view) { raw->take(view); });
  if (!reader) return tl::unexpected(reader.error());
  made->reader_ = std::move(*reader);
  return made;
}

void DeviceWatch::take(proto::ReaderView<proto::KioskStatus> view) {
  view.take_each([this](const proto::KioskStatus& wire, const proto::SampleInfo& info) {
    if (proto::text_of(wire.kiosk) != kiosk_) return;
    DeviceReport report;
    const std::lock_guard lock(mutex_);
    if (!info.alive) {
      devices_.erase(wire.session);
    } else if (info.valid && parse(wire, report) && (devices_.size() < kSessions || devices_.contains(wire.session))) {
      devices_[wire.session] = std::move(report);
    }
  });
}

std::map<std::uint64_t, DeviceReport> DeviceWatch::devices() {
  const std::lock_guard lock(mutex_);
  return devices_;
}

}  // namespace mechane::client
