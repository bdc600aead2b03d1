#include "client-sdk/display/news.hpp"

#include <utility>

#include <fmt/format.h>

#include "server/log/log.hpp"

namespace mechane::display {
namespace {

/// An object that moves but is not in the manifest is reported after this time.
constexpr Duration kManifestComes = std::chrono::seconds(5);

}  // namespace

bool News::finished() const {
  const client::WorldStatus* status = world_.status();
  if (status == nullptr || !status->done) return false;
  return status->activities.empty() || status->activities.back() == status->activity;
}

scene::ShownWorld::News News::take(TimePoint now) {
  if (source_.recorded != nullptr) source_.recorded->advance(now);
  const scene::ShownWorld::News news = world_.hear(client_);
  if (news.another_world) frame_.reset();
  record(now);
  tell_refusal();
  client::Frame newer;
  if (client_.state() == client::LinkState::joined && client_.interpolated_frame(now, kInterpolationDelay, newer))
    frame_ = std::move(newer);
  take_head(now);
  const std::vector<client::DeviceReport> devices = client_.devices();
  devices_.hear(devices, now);
  calibration_.hear(devices, now);
  return news;
}

void News::take_head(TimePoint now) {
  const bool before = head_.tracked();
  head_.advance(client_.viewer_head(), now);
  if (before || !head_.tracked() || knows_screen_ || std::exchange(told_head_, true)) return;
  log::warning(
      "a tracker sends the position of the visitor's head, but the size of the screen is not known, so it has no "
      "effect: give --screen-width and --viewer-distance");
}

void News::record(TimePoint now) {
  if (source_.recorder && client_.state() == client::LinkState::joined) source_.recorder->hear(now, client_);
}

std::vector<client::WorldEvent> News::take_events(TimePoint now) {
  std::vector<client::WorldEvent> events = client_.take_events();
  if (source_.recorder) source_.recorder->hear(now, events);
  return events;
}

/// Visitors see a calm picture; the log tells technicians the reason.
void News::tell_refusal() {
  std::string refusal = client_.state() == client::LinkState::refused ? client_.refusal() : std::string();
  if (refusal == told_refusal_) return;
  told_refusal_ = std::move(refusal);
  if (!told_refusal_.empty()) log::warning("there is no exhibit to show yet: " + told_refusal_);
}

void News::tell_what_is_not_drawn(TimePoint now) {
  if (const std::string stray = world_.stray(); !stray.empty() && stray != told_stray_) {
    told_stray_ = stray;
    log::warning(told_stray_ + " is kilometres away and is not drawn: its simulation has failed; restart the activity");
  }
  const auto unknown = world_.unknown();
  if (!unknown) return unknown_since_.reset();
  if (!unknown_since_) unknown_since_ = now;
  // Until then, the manifest may still be arriving.
  if (now - *unknown_since_ < kManifestComes || std::exchange(told_unknown_, unknown) == unknown) return;
  log::warning(
      fmt::format("object {} moves, but the server's list of objects does not contain it, so it is not drawn: check "
                  "that server and display are of the same version",
                  *unknown));
}

}  // namespace mechane::display
