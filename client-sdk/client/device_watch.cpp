#include "client-sdk/client/device_watch.hpp"

#include <chrono>
#include <utility>

#include "client-sdk/client/device_parse.hpp"
#include "client-sdk/client/parse.hpp"
#include <mechane/proto/convert.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::client {

Expected<std::unique_ptr<DeviceWatch>> DeviceWatch::create(const proto::Participant& participant,
                                                           const std::string& kiosk, std::function<void()> changed) {
  std::unique_ptr<DeviceWatch> made(new DeviceWatch(kiosk, std::move(changed)));
  DeviceWatch* const raw = made.get();
  auto writer = proto::Writer<proto::DeviceRequest>::create(participant, "");
  if (!writer) return tl::unexpected(writer.error());
  made->requests_ = std::move(*writer);
  auto reader = proto::Reader<proto::KioskStatus>::create(participant, "", [raw](auto view) { raw->take(view); });
  if (!reader) return tl::unexpected(reader.error());
  made->reader_ = std::move(*reader);
  auto details = proto::Reader<proto::DeviceStatus>::create(participant, "", [raw](auto view) { raw->take(view); });
  if (!details) return tl::unexpected(details.error());
  made->details_reader_ = std::move(*details);
  return made;
}

void DeviceWatch::take(proto::ReaderView<proto::KioskStatus> view) {
  view.take_each([this](const proto::KioskStatus& wire, const proto::SampleInfo& info) {
    KioskDevice device{std::string(proto::text_of(wire.kiosk)), {}, {}};
    if (!is_meant(device.kiosk)) return;
    const std::lock_guard lock(mutex_);
    if (!info.alive) {
      devices_.erase(wire.session);
    } else if (info.valid && parse(wire, device.report) && has_room(devices_, wire.session)) {
      devices_[wire.session] = std::move(device);
    }
  });
  if (changed_) changed_();
}

void DeviceWatch::take(proto::ReaderView<proto::DeviceStatus> view) {
  view.take_each([this](const proto::DeviceStatus& wire, const proto::SampleInfo& info) {
    if (!is_meant(proto::text_of(wire.kiosk))) return;
    DeviceDetails details;
    const std::lock_guard lock(mutex_);
    if (!info.alive) {
      details_.erase(wire.session);
    } else if (info.valid && parse(wire, details) && has_room(details_, wire.session)) {
      details_[wire.session] = std::move(details);
    }
  });
  if (changed_) changed_();
}

std::map<std::uint64_t, KioskDevice> DeviceWatch::devices() {
  const std::lock_guard lock(mutex_);
  std::map<std::uint64_t, KioskDevice> all = devices_;
  for (auto& [session, device] : all)
    if (const auto found = details_.find(session); found != details_.end()) device.details = found->second;
  return all;
}

std::uint64_t DeviceWatch::ask(const std::string& kiosk, const DeviceRequest& request) {
  proto::DeviceRequest wire{};
  proto::set_text(wire.kiosk, kiosk);
  wire.protocol = proto::kProtocol;
  wire.sent_ns = to_ns(std::chrono::steady_clock::now());
  wire.id = proto::random_id();
  wire.user = request.user;
  wire.action = static_cast<std::uint32_t>(request.action);
  write(request.place, wire.place);
  const std::lock_guard lock(mutex_);
  wire.seq = ++asked_;
  return requests_.write(wire) ? wire.id : 0;
}

}  // namespace mechane::client
