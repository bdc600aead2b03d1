#include "client-sdk/client/device_link.hpp"

#include <chrono>

#include "client-sdk/client/device_parse.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {

Expected<std::unique_ptr<DeviceLink>> DeviceLink::create(const proto::Participant& participant,
                                                         const std::string& kiosk, std::uint32_t user,
                                                         std::uint64_t session) {
  std::unique_ptr<DeviceLink> made(new DeviceLink(kiosk, user, session));
  auto writer = proto::Writer<proto::DeviceStatus>::create(participant, "");
  if (!writer) return tl::unexpected(writer.error());
  made->statuses_ = std::move(*writer);
  auto reader =
      proto::Reader<proto::DeviceRequest>::create(participant, "", [raw = made.get()](auto view) { raw->take(view); });
  if (!reader) return tl::unexpected(reader.error());
  made->reader_ = std::move(*reader);
  return made;
}

bool DeviceLink::tell(const DeviceDetails& details) {
  proto::DeviceStatus wire{};
  write(details, wire);
  proto::set_text(wire.kiosk, kiosk_);
  wire.user = user_;
  wire.session = session_;
  wire.protocol = proto::kProtocol;
  wire.seq = ++sequence_;
  wire.sent_ns = to_ns(std::chrono::steady_clock::now());
  return statuses_.write(wire);
}

void DeviceLink::take(proto::ReaderView<proto::DeviceRequest> view) {
  view.take_each([this](const proto::DeviceRequest& wire, const proto::SampleInfo& info) {
    DeviceRequest request;
    if (!info.valid || proto::text_of(wire.kiosk) != kiosk_ || wire.user != user_ || !parse(wire, request)) return;
    requests_.push(request);
  });
}

}  // namespace mechane::client
