#include "client-sdk/recording/recorded_client.hpp"

#include <algorithm>

#include "client-sdk/client/frame_history.hpp"
#include "client-sdk/recording/recording_codec.hpp"
#include "server/base/assert.hpp"

namespace mechane::recording {
namespace {

/// Frames farther apart than this are not interpolated: the first stays until the next.
constexpr Duration kGap = std::chrono::seconds(1);

}  // namespace

RecordedClient::RecordedClient(FrameRecording recording, const PlaySettings& settings)
    : recording_(std::move(recording)), settings_(settings) {
  MECHANE_ASSERT(settings.speed > 0);
}

void RecordedClient::begin(TimePoint now) {
  began_ = now;
  at_ = {};
  next_ = 0;
  over_ = false;
  status_.reset();
  presentation_.reset();
  manifest_.clear();
  frame_.reset();
  events_.clear();
}

void RecordedClient::advance(TimePoint now) {
  if (!began_ || now < *began_) begin(now);
  const auto played = [&] {
    return settings_.from + std::chrono::duration_cast<Duration>((now - *began_) * settings_.speed);
  };
  if (settings_.again && played() > recording_.duration()) begin(now);
  at_ = played();
  const std::span<const FrameRecording::Record> records = recording_.records();
  while (next_ < records.size() && records[next_].time <= at_)
    take(records[next_++]);
  // At the beginning, the first frame may still lie ahead: it is shown at once, so that nobody sees an empty picture.
  while (!frame_ && next_ < records.size())
    take(records[next_++]);
  over_ = at_ >= recording_.duration();
}

void RecordedClient::take(const FrameRecording::Record& record) {
  bool whole = true;
  switch (record.kind) {
    case RecordKind::status: {
      client::WorldStatus status;
      whole = decode(record.content, status);
      if (!status_ || status_->world != status.world) {
        presentation_.reset();
        manifest_.clear();
        frame_.reset();
      }
      status_ = std::move(status);
      break;
    }
    case RecordKind::presentation: {
      auto presentation = std::make_shared<client::WorldPresentation>();
      whole = decode(record.content, *presentation);
      presentation_ = std::move(presentation);
      break;
    }
    case RecordKind::manifest:
      whole = decode(record.content, manifest_);
      break;
    case RecordKind::frame:
      whole = decode(record.content, frame_.emplace());
      frame_time_ = record.time;
      break;
    case RecordKind::event:
      whole = decode(record.content, events_.emplace_back());
      break;
    case RecordKind::end:
      break;
  }
  MECHANE_ASSERT(whole);  // FrameRecording has decoded it before
}

/// Whether this frame is of the same world as the last one.
const FrameRecording::Record* RecordedClient::next_frame() const {
  for (const FrameRecording::Record& record : recording_.records().subspan(next_)) {
    if (record.time - frame_time_ > kGap) return nullptr;
    if (record.kind == RecordKind::frame) return &record;
    if (record.kind != RecordKind::status) continue;
    client::WorldStatus status;
    if (!decode(record.content, status) || !status_ || status.world != status_->world) return nullptr;
  }
  return nullptr;
}

bool RecordedClient::newest_frame(client::Frame& out) {
  if (!frame_) return false;
  out = *frame_;
  if (began_) {
    const auto since = std::chrono::duration_cast<Duration>((frame_time_ - settings_.from) / settings_.speed);
    out.received = *began_ + since;
  }
  return true;
}

bool RecordedClient::interpolated_frame(TimePoint at, Duration /*delay*/, client::Frame& out) {
  if (!frame_ || !began_) return false;
  out = *frame_;
  const FrameRecording::Record* after = next_frame();
  if (after == nullptr || after->time <= frame_time_) return true;
  client::Frame to;
  if (!decode(after->content, to)) return true;
  const Duration played = settings_.from + std::chrono::duration_cast<Duration>((at - *began_) * settings_.speed);
  const double share = std::clamp(to_seconds(played - frame_time_) / to_seconds(after->time - frame_time_), 0.0, 1.0);
  client::Frame between;
  client::interpolate(*frame_, to, share, between);
  // The world's time is interpolated too, or water and smoke would move in jerks in slow motion. Visibility is that of
  // the last frame.
  if (to.tick > frame_->tick)
    between.tick = frame_->tick + static_cast<std::uint64_t>(share * static_cast<double>(to.tick - frame_->tick));
  between.visible = frame_->visible;
  out = std::move(between);
  return true;
}

bool RecordedClient::wait_for(client::LinkState wanted, Duration /*timeout*/) {
  return wanted == client::LinkState::joined;
}

bool RecordedClient::send(const client::HandSample& /*input*/) noexcept {
  return false;
}

std::optional<client::ForceSample> RecordedClient::wait_force(Duration /*timeout*/) {
  return {};
}

std::uint64_t RecordedClient::start_activity(const std::string& /*activity*/) {
  return 0;
}

std::uint64_t RecordedClient::click(const std::string& /*object*/) {
  return 0;
}

std::uint64_t RecordedClient::open_exhibit(const std::string& /*scenario*/) {
  return 0;
}

}  // namespace mechane::recording
