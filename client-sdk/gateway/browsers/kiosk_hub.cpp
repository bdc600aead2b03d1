#include "client-sdk/gateway/browsers/kiosk_hub.hpp"

#include <algorithm>
#include <array>

#include "client-sdk/gateway/browsers/browser_text.hpp"
#include "server/log/log.hpp"

namespace mechane::gateway {
namespace {

using std::chrono::milliseconds;

constexpr Duration kNewsEvery = milliseconds(50);
constexpr Duration kFollowEvery = milliseconds(33);
constexpr Duration kRefreshEvery = milliseconds(100);
constexpr Duration kHubReportEvery = milliseconds(1000);
constexpr std::size_t kRefusalsKept = 100;
constexpr std::array<const char*, 4> kOnJoining{"link", "world", "scene", "presentation"};

/// Whether it is time; if so, says when the next time is.
bool is_due(TimePoint& next, Duration every, TimePoint now) {
  if (now < next) return false;
  next = now + every;
  return true;
}

}  // namespace

KioskHub::KioskHub(std::string kiosk, const Backstage& backstage) : kiosk_(std::move(kiosk)), backstage_(backstage) {
  publish("link", link_text(client::LinkState::searching, ""));
}

KioskHub::~KioskHub() {
  backstage_.end_slowly(std::move(client_));
}

void KioskHub::open() {
  client::ClientConfig config;
  config.kiosk = kiosk_;
  config.program = "mechane-gateway";
  config.domain = backstage_.domain;
  config.display = "gateway";  // for the news of haptic devices; it never reports itself
  backstage_.slow.give([config, hub = weak_from_this(), backstage = backstage_] {
    auto client = client::Client::connect(config);
    if (!client) return log::error(client.error());
    backstage.post([hub, backstage, made = std::make_shared<std::unique_ptr<client::Client>>(std::move(*client))] {
      if (const auto alive = hub.lock()) return void(alive->client_ = std::move(*made));
      backstage.end_slowly(std::move(*made));
    });
  });
}

void KioskHub::join(const std::shared_ptr<Browser>& browser) {
  browsers_.push_back(browser);
  for (const char* kind : kOnJoining)
    if (const auto text = texts_.find(kind); text != texts_.end()) browser->tell(kind, text->second);
}

void KioskHub::leave(const Browser& browser) {
  std::erase_if(browsers_, [&](const auto& one) { return one.get() == &browser; });
}

void KioskHub::part(const std::string& reason, const std::string& remedy) {
  for (const auto& browser : browsers_)
    browser->part(reason, remedy);
}

pointer::PointerWorld KioskHub::world() const {
  static const std::vector<std::string> kNone;
  return {frame(), objects_, presentation_.get(), status_ ? status_->enabled_agents : kNone};
}

void KioskHub::publish(const std::string& kind, std::string text) {
  auto& newest = texts_[kind];
  if (newest && *newest == text) return;
  newest = std::make_shared<const std::string>(std::move(text));
  for (const auto& browser : browsers_)
    browser->tell(kind, newest);
}

void KioskHub::tick(TimePoint now) {
  if (!browsers_.empty()) used_ = now;
  if (!client_) return;
  take_frame();
  if (is_due(next_news_, kNewsEvery, now)) take_news(now);
  const std::vector<std::shared_ptr<Browser>> all = browsers_;  // one may part
  if (is_due(next_follow_, kFollowEvery, now))
    for (const auto& browser : all)
      browser->follow(now);
  if (is_due(next_refresh_, kRefreshEvery, now))
    for (const auto& browser : all)
      browser->refresh(now);
  if (!is_due(next_report_, kHubReportEvery, now)) return;
  frames_per_s_ = static_cast<double>(frames_ - std::exchange(frames_before_, frames_));
  for (const auto& browser : all)
    browser->report(now);
}

void KioskHub::take_frame() {
  if (client_->state() != client::LinkState::joined || !client_->newest_frame(newest_)) return;
  if (frame_ && frame_->sequence == newest_.sequence) return;
  std::swap(newest_, frame_ ? *frame_ : frame_.emplace());
  ++frames_;
  if (browsers_.empty()) return;
  const auto body = std::make_shared<const FrameBody>(encode_frame(*frame_));
  for (const auto& browser : browsers_)
    browser->show(body);
}

void KioskHub::take_news(TimePoint now) {
  const client::LinkState state = client_->state();
  publish("link", link_text(state, state == client::LinkState::refused ? client_->refusal() : ""));
  take_world();
  device_reports_ = client_->devices();
  devices_.hear(device_reports_, now);
  calibration_.hear(device_reports_, now);
  for (const client::WorldEvent& event : client_->take_events()) {
    if (event.kind == "command_refused" && refused_.size() < kRefusalsKept)
      refused_.insert(static_cast<std::uint64_t>(event.value));
    const auto text = std::make_shared<const std::string>(event_text(event));
    for (const auto& browser : browsers_)
      browser->tell("", text);
  }
}

void KioskHub::take_world() {
  auto status = client_->world_status();
  if (!status) return;
  if (!status_ || status_->world != status->world || status_->scenario_hash != status->scenario_hash) {
    objects_.clear();
    presentation_.reset();
    frame_.reset();
    texts_.erase("scene");
    texts_.erase("presentation");
    for (const auto& browser : browsers_)
      browser->forget_world();
  }
  status_ = std::move(status);
  publish("world", world_text(*status_));
  if (std::vector<client::SceneObject> objects = client_->objects(); objects.size() != objects_.size()) {
    objects_ = std::move(objects);
    backstage_.content.hear(*status_, objects_);
    publish("scene", scene_text(objects_));
  }
  if (auto presentation = client_->presentation(); presentation && presentation != presentation_) {
    presentation_ = std::move(presentation);
    publish("presentation", presentation_text(*presentation_));
  }
}

nlohmann::json KioskHub::devices_json(TimePoint now) const {
  return client_ ? asked_devices_.look(*client_, device_reports_, now) : nlohmann::json::array();
}

}  // namespace mechane::gateway
