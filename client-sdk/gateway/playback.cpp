#include "client-sdk/gateway/playback.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "client-sdk/gateway/browsers/browser_text.hpp"
#include "server/base/byte_order.hpp"
#include "server/base/program_folder.hpp"
#include "server/base/whole_file.hpp"
#include "server/log/log.hpp"

namespace mechane::gateway {
namespace {

using std::chrono::seconds;

constexpr std::string_view kPlaybackSpeed = "6";  // frames come 62.5 times a second, and are looked for 200 times
constexpr auto kLongestPlayback = std::chrono::minutes(15);  // with what the world did before the visit
constexpr std::uint64_t kMostOfChild = std::uint64_t{64} * 1024;
constexpr Duration kStaysUnasked = seconds(10);
constexpr Duration kTapeStays = std::chrono::minutes(10);

std::string child_words(const content::ChildResult& child) {
  std::string words(as_text(child.output));
  const std::size_t end = words.find_last_not_of('\n');
  words.resize(std::min<std::size_t>(end == std::string::npos ? 0 : end + 1, 500));
  return words;
}

}  // namespace

void TapeWriter::add(std::uint32_t kind, std::string_view payload) {
  if (full_ || bytes_.size() + payload.size() + 12 > kMostBytes) {
    full_ = true;
    return;
  }
  StringSink sink(bytes_);
  put(sink, kind);
  put(sink, static_cast<std::uint32_t>(payload.size()));
  bytes_ += payload;
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
}

void TapeWriter::add_frame(const FrameBody& frame) {
  const auto head = frame_header(frame, 0, frame.received);
  std::string payload(as_text(head));
  add(2, payload += as_text(frame.bytes));
  if (full_) return;
  if (frames_++ == 0) first_ = frame.tick;
  newest_ = frame.tick;
}

Playback::Playback(const visits::VisitRecord& visit, const GatewayOptions& options, std::uint32_t domain,
                   const Backstage& backstage)
    : visit_(visit),
      kiosk_("play-" + visit.number),
      domain_(domain),
      scenario_(options.scenarios / visit.scenario / (visit.scenario + ".x3d")),
      backstage_(backstage),
      arguments_{
          options.records.string(), "--visit",   visit.number, "--scenario", scenario_.string(),         "--show-in",
          std::to_string(domain),   "--show-to", kiosk_,       "--speed",    std::string(kPlaybackSpeed)} {}

Playback::~Playback() {
  stop_.request_stop();
  backstage_.end_slowly(std::move(client_));
  backstage_.end_slowly(std::move(thread_));
}

void Playback::open() {
  thread_ = std::make_unique<Worker>("gateway-play");
  thread_->give([arguments = arguments_, stop = stop_.get_token(), weak = weak_from_this(), post = backstage_.post] {
    const auto child = std::make_shared<const Expected<content::ChildResult>>(
        content::run_child(program_folder() / "mechane-replay", arguments, kLongestPlayback, kMostOfChild, stop));
    post([weak, child] {
      if (const auto alive = weak.lock()) alive->end(*child);
    });
  });
  client::ClientConfig config;
  config.kiosk = kiosk_;
  config.program = "mechane-gateway";
  config.domain = domain_;
  backstage_.slow.give([config, weak = weak_from_this(), backstage = backstage_] {
    auto client = client::Client::connect(config);
    if (!client) return log::error(client.error());
    backstage.post([weak, backstage, made = std::make_shared<std::unique_ptr<client::Client>>(std::move(*client))] {
      if (const auto alive = weak.lock()) return void(alive->client_ = std::move(*made));
      backstage.end_slowly(std::move(*made));
    });
  });
}

void Playback::tick() {
  if (state_ != State::preparing) return;
  if (client_ && client_->state() == client::LinkState::joined) {
    take_texts();
    take_frame();
  }
  if (!writer_.goes_on()) stop_.request_stop();
}

/// Each text is of the moment of the next frame.
void Playback::take_texts() {
  const auto status = client_->world_status();
  const std::vector<client::SceneObject> objects = client_->objects();
  const auto presentation = client_->presentation();
  if (!status || objects.empty() || !presentation) return;
  const auto tell = [this](const std::string& kind, std::string text) {
    if (told_[kind] == text) return false;
    writer_.add_text(text);
    told_[kind] = std::move(text);
    return true;
  };
  tell("world", world_text(*status));
  if (tell("scene", scene_text(objects))) backstage_.content.hear(*status, objects);
  tell("presentation", presentation_text(*presentation));
}

void Playback::take_frame() {
  if (!told_.contains("scene") || !client_->newest_frame(frame_) || frame_.sequence == sequence_) return;
  sequence_ = frame_.sequence;
  writer_.add_frame(encode_frame(frame_));
}

double Playback::share() const {
  if (state_ == State::ready) return 1;
  return std::clamp(static_cast<double>(writer_.ticks()) * kTickSeconds / std::max(1.0, visit_.duration_s), 0.0, 1.0);
}

void Playback::end(const Expected<content::ChildResult>& child) {
  const bool well = child && child->end == content::ChildResult::End::exited && child->code == 0;
  state_ = writer_.frames() > 1 && (well || !writer_.goes_on()) ? State::ready : State::failed;
  if (state_ == State::ready) {
    tape_ = std::make_shared<const std::string>(writer_.take());
  } else {
    trouble_ = !child ? child.error().to_string() : child_words(*child);
    if (trouble_.empty()) trouble_ = "the visit could not be shown: see the gateway's log";
    log::warning("playback of visit " + visit_.number + ": " + trouble_);
  }
  backstage_.end_slowly(std::move(client_));
  backstage_.end_slowly(std::move(thread_));
}

std::shared_ptr<Playback> PlaybackShelf::begin(const visits::VisitRecord& visit, const GatewayOptions& options,
                                               const Backstage& backstage, TimePoint now) {
  if (auto known = find(visit.number, now); known && known->state() != Playback::State::failed) return known;
  kept_.erase(visit.number);
  std::set<std::uint32_t> busy;
  for (const auto& [number, kept] : kept_)
    if (kept.playback->state() == Playback::State::preparing) busy.insert(kept.playback->domain());
  if (busy.size() >= kMostAtOnce) return nullptr;
  if (kept_.size() >= kMostKept) {
    const auto oldest = std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; });
    kept_.erase(oldest);
  }
  std::uint32_t domain = options.playback_domain;
  while (busy.contains(domain))
    ++domain;
  const auto made = std::make_shared<Playback>(visit, options, domain, backstage);
  made->open();
  kept_[visit.number] = {made, now};
  return made;
}

std::shared_ptr<Playback> PlaybackShelf::find(const std::string& number, TimePoint now) {
  const auto known = kept_.find(number);
  if (known == kept_.end()) return nullptr;
  known->second.used = now;
  return known->second.playback;
}

void PlaybackShelf::tick(TimePoint now) {
  for (const auto& [number, kept] : kept_)
    kept.playback->tick();
  std::erase_if(kept_, [now](const auto& entry) {
    const bool preparing = entry.second.playback->state() == Playback::State::preparing;
    return now - entry.second.used > (preparing ? kStaysUnasked : kTapeStays);
  });
}

}  // namespace mechane::gateway
