#include <algorithm>
#include <map>
#include <tuple>

#include "client-sdk/client/device_watch.hpp"
#include "client-sdk/client/parse.hpp"
#include "server/realtime/wakeup.hpp"
#include <mechane/client/displays.hpp>
#include <mechane/proto/convert.hpp>
#include <mechane/proto/entity.hpp>
#include <mechane/proto/identity.hpp>

namespace mechane::client {
namespace {

class DisplayWatchImpl final : public DisplayWatch {
 public:
  explicit DisplayWatchImpl(proto::Participant participant) : participant_(std::move(participant)) {}

  [[nodiscard]] Expected<void> open() {
    auto writer = proto::Writer<proto::DisplayRequest>::create(participant_, "");
    if (!writer) return tl::unexpected(writer.error());
    requests_ = std::move(*writer);
    auto reader = proto::Reader<proto::DisplayStatus>::create(participant_, "", [this](auto) { news_.signal(); });
    if (!reader) return tl::unexpected(reader.error());
    reader_ = std::move(*reader);
    auto devices = DeviceWatch::create(participant_, "", [this] { news_.signal(); });
    if (!devices) return tl::unexpected(devices.error());
    devices_ = std::move(*devices);
    return {};
  }

  void wait(Duration timeout) override { news_.wait(timeout); }

  [[nodiscard]] std::vector<DisplayStatus> displays() override {
    reader_.view().take_each([this](const proto::DisplayStatus& wire, const proto::SampleInfo& info) {
      const Key key{proto::text_of(wire.kiosk), proto::text_of(wire.display), wire.session};
      DisplayStatus status;
      if (!info.alive) {
        known_.erase(key);
      } else if (info.valid && parse(wire, status) && (known_.size() < kMostDisplays || known_.contains(key))) {
        known_[key] = std::move(status);
      }
    });
    std::vector<DisplayStatus> all;
    for (const auto& [key, status] : known_)
      all.push_back(status);
    return all;
  }

  [[nodiscard]] std::vector<KioskDevice> devices() override {
    std::vector<KioskDevice> all;
    for (auto& [session, device] : devices_->devices())
      if (device.report.state != DeviceState::none) all.push_back(std::move(device));
    std::ranges::stable_sort(all, {}, [](const KioskDevice& one) { return std::tie(one.kiosk, one.report.user); });
    return all;
  }

  [[nodiscard]] Expected<std::uint64_t> request(const std::string& kiosk, const std::string& display,
                                                const DisplayRequest& request) override {
    if (auto ok = proto::check_name(kiosk, "kiosk"); !ok) return tl::unexpected(ok.error());
    if (!display.empty()) {
      if (auto ok = proto::check_name(display, "display"); !ok) return tl::unexpected(ok.error());
    }
    DisplaySettings tried;
    if (auto ok = apply(request.settings, tried); !ok) return tl::unexpected(ok.error());
    std::vector<proto::WireSetting> wire_settings(request.settings.size());
    for (std::size_t i = 0; i < request.settings.size(); ++i) {
      proto::set_text(wire_settings[i].name, request.settings[i].name);
      proto::set_text(wire_settings[i].value, request.settings[i].value);
    }
    proto::DisplayRequest wire{};
    proto::set_text(wire.kiosk, kiosk);
    proto::set_text(wire.display, display);
    wire.protocol = proto::kProtocol;
    wire.seq = ++sequence_;
    wire.sent_ns = to_ns(std::chrono::steady_clock::now());
    wire.session = session_;
    wire.id = proto::random_id();
    wire.picture = request.picture;
    wire.restart = request.restart;
    proto::look_into(wire.settings, wire_settings);
    return requests_.write(wire) ? wire.id : 0;
  }

 private:
  using Key = std::tuple<std::string, std::string, std::uint64_t>;
  proto::Participant participant_;
  const std::uint64_t session_ = proto::random_id();
  std::uint64_t sequence_ = 0;
  std::map<Key, DisplayStatus> known_;
  realtime::Wakeup news_;
  proto::Writer<proto::DisplayRequest> requests_;
  proto::Reader<proto::DisplayStatus> reader_;  // last, with the next: their listeners end first
  std::unique_ptr<DeviceWatch> devices_;
};

}  // namespace

Expected<std::unique_ptr<DisplayWatch>> DisplayWatch::open(std::uint32_t domain) {
  auto participant = proto::Participant::create(domain);
  if (!participant) return tl::unexpected(participant.error());
  auto watch = std::make_unique<DisplayWatchImpl>(std::move(*participant));
  if (auto opened = watch->open(); !opened) return tl::unexpected(opened.error());
  return watch;
}

}  // namespace mechane::client
