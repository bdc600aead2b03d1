#include "client-sdk/display/kiosk_desk.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "server/log/log.hpp"
#include <mechane/proto/identity.hpp>

namespace mechane::display {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

void PictureMeter::drawn(Duration took, TimePoint now) {
  ++total_;
  pictures_.push_back({now, 1e3 * to_seconds(took)});
  while (now - pictures_.front().at > kWindow)
    pictures_.pop_front();
}

PictureMeter::Rate PictureMeter::rate(TimePoint now) const {
  std::vector<double> took;
  for (const Picture& picture : pictures_) {
    if (now - picture.at <= kWindow) took.push_back(picture.ms);
  }
  const double over_s = to_seconds(std::min<Duration>(kWindow, now - began_));
  if (took.empty() || over_s <= 0) return {};
  return {static_cast<double>(took.size()) / over_s, percentile(took, 0.5), percentile(took, 0.99)};
}

TrafficMeter::Rate TrafficMeter::rate(const client::FrameTraffic& now_counted, TimePoint now) {
  counts_.push_back({now, now_counted});
  // One sample older than the window is kept, as the start of the rate.
  while (counts_.size() > 2 && now - counts_[1].at >= kWindow)
    counts_.pop_front();
  const Count& first = counts_.front();
  const double over_s = to_seconds(now - first.at);
  const double came = static_cast<double>(now_counted.received - first.traffic.received);
  const double lost = static_cast<double>(now_counted.lost - first.traffic.lost);
  if (over_s <= 0 || came + lost <= 0) return {};
  return {came / over_s, lost / (came + lost)};
}

KioskDesk::KioskDesk(client::Client& client, DisplayIdentity identity, client::DisplaySettings settings, TimePoint now)
    : client_(client),
      identity_(std::move(identity)),
      settings_(std::move(settings)),
      meter_(now),
      began_(now),
      next_report_(now),
      host_(proto::host_name()) {}

bool KioskDesk::take_requests(const picture::OverlayStyle& style) {
  settings_.large_text = style.text_scale > 1;
  settings_.high_contrast = style.high_contrast;
  const client::DisplaySettings before = settings_;
  for (const client::DisplayRequest& request : client_.take_display_requests())
    answer(request);
  return settings_ != before;
}

void KioskDesk::answer(const client::DisplayRequest& request) {
  if (request.picture && !identity_.has_folder) {
    return say({request.id, "this display has no folder for pictures: start it with --out FOLDER", ""});
  }
  client::DisplaySettings requested = settings_;
  if (auto applied = client::apply(request.settings, requested); !applied)
    return say({request.id, applied.error().to_string(), ""});
  if (requested.attract && !identity_.has_attract && !settings_.attract)
    return say({request.id, "this display has no recorded visit to show: start it with --attract FILE", ""});
  settings_ = requested;
  for (const client::DisplaySetting& setting : request.settings) {
    if (setting.name == "phone-code") ++codes_told_;
    if (setting.name.starts_with("phone-")) continue;  // told every few seconds, and a secret
    log::info(fmt::format("set from another machine: {}={}", setting.name, setting.value));
  }
  if (request.restart) {
    log::info("another machine asked to start this display again");
    restart_ = Restart::asked;
  }
  if (request.picture) {
    picture_for_.push_back(request.id);
  } else {
    say({request.id, "", ""});
  }
}

void KioskDesk::say(client::RequestAnswer answer) {
  if (!answer.refusal.empty()) log::warning("a request from another machine was refused: " + answer.refusal);
  answers_.push_back(std::move(answer));
  if (answers_.size() > kAnswers) answers_.pop_front();
  next_report_ = {};  // report at once: somebody is waiting for the answer
}

void KioskDesk::picture_taken(const std::vector<std::uint64_t>& requests, const std::string& file) {
  for (const std::uint64_t id : requests)
    say({id, "", file});
}

void KioskDesk::picture_failed(const std::vector<std::uint64_t>& requests, const Error& error) {
  for (const std::uint64_t id : requests)
    say({id, error.to_string(), ""});
}

void KioskDesk::report(const DisplayFacts& facts, TimePoint now) {
  next_report_ = now + kReportEvery;
  client::DisplayStatus status;
  status.version = MECHANE_VERSION;
  status.host = host_;
  status.process_id = static_cast<std::uint32_t>(::getpid());
  status.uptime_s = static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::seconds>(now - began_).count());
  status.width = facts.size.width;
  status.height = facts.size.height;
  status.offscreen = identity_.offscreen;
  const PictureMeter::Rate pictures = meter_.rate(now);
  status.pictures = meter_.total();
  status.pictures_per_s = pictures.per_s;
  status.picture_ms_median = pictures.median_ms;
  status.picture_ms_p99 = pictures.p99_ms;
  status.wanted_per_s = identity_.wanted_per_s;
  status.link = static_cast<std::uint32_t>(client_.state());
  if (client_.state() == client::LinkState::refused) status.refusal = client_.refusal();
  if (facts.world != nullptr) {
    status.world = facts.world->world;
    status.scenario = facts.world->scenario;
  }
  const TrafficMeter::Rate frames = traffic_.rate(client_.frame_traffic(), now);
  status.frames_per_s = frames.per_s;
  status.frames_lost = frames.lost;
  if (facts.missing != nullptr) {
    status.missing_total = static_cast<std::uint32_t>(facts.missing->size());
    for (const std::string& file : *facts.missing) {
      if (status.missing.size() < kMissingNamed) status.missing.push_back(file);
    }
  }
  status.renderer = identity_.renderer;
  if (!facts.sound) {
    status.sound_problem = identity_.offscreen ? "without a window there is no sound" : "muted";
  } else {
    status.sound = facts.sound->device;
    status.sound_problem = settings_.silent() ? "muted" : facts.sound->problem;
  }
  status.showing = facts.attracts ? "attract" : "world";
  const log::Trouble trouble = log::trouble();
  status.warnings = trouble.count;
  status.last_warning = trouble.last;
  status.settings = client::settings_of(settings_);
  status.answers.assign(answers_.begin(), answers_.end());
  // After a failure, the next one follows in a second.
  if (client_.report(status) && restart_ == Restart::asked) restart_ = Restart::answered;
}

}  // namespace mechane::display
