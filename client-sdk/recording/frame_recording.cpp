#include "client-sdk/recording/frame_recording.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <xxhash.h>

#include "client-sdk/recording/recording_codec.hpp"
#include "server/base/byte_order.hpp"
#include "server/base/whole_file.hpp"
#include "server/base/worker.hpp"
#include "server/log/log.hpp"

namespace mechane::recording {
namespace {

constexpr char kMagic[8] = {'M', 'E', 'C', 'H', 'S', 'E', 'E', 'N'};
constexpr std::size_t kPreamble = sizeof kMagic + 4;
constexpr std::size_t kRecordHead = 1 + 4 + 8;
constexpr std::uint64_t kMaxMicroseconds = std::uint64_t{30} * 24 * 3600 * 1'000'000;
/// When ticks and times of receipt differ by more than this, a new anchor is taken: the world was restarted or stood
/// still.
constexpr Duration kParting = std::chrono::milliseconds(250);

std::vector<std::byte> checked_part(RecordKind kind, std::span<const std::byte> payload) {
  std::vector<std::byte> out;
  VectorSink sink(out);
  put(sink, static_cast<std::uint8_t>(kind));
  put(sink, static_cast<std::uint32_t>(payload.size()));
  sink.append(payload.data(), payload.size());
  return out;
}

std::uint64_t checksum_of(std::span<const std::byte> checked, std::uint64_t number) {
  return XXH3_64bits_withSeed(checked.data(), checked.size(), number);
}

}  // namespace

RecordingWriter::RecordingWriter() {
  VectorSink sink(bytes_);
  sink.append(reinterpret_cast<const std::byte*>(kMagic), sizeof kMagic);
  put(sink, kRecordingVersion);
}

void RecordingWriter::add(RecordKind kind, Duration time, std::span<const std::byte> payload) {
  last_ = std::max(last_, time);
  std::vector<std::byte> timed;
  VectorSink content(timed);
  put_varint(content, static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(last_).count()));
  content.append(payload.data(), payload.size());
  const std::vector<std::byte> checked = checked_part(kind, timed);
  VectorSink sink(bytes_);
  sink.append(checked.data(), 5);
  put(sink, checksum_of(checked, records_++));
  sink.append(timed.data(), timed.size());
}

/// The file, and the thread that writes it.
class FrameRecorder::Disk {
 public:
  Disk(std::filesystem::path path, std::ofstream file) : path_(std::move(path)), file_(std::move(file)) {}

  /// Queues bytes. False: nothing more is written, and the log says why.
  [[nodiscard]] bool write(std::vector<std::byte> bytes) {
    if (failed_) return false;
    if (waiting_.fetch_add(bytes.size()) > kMostWaitingBytes) {
      tell("ends here: the disk is too slow");
      return false;
    }
    worker_.give([this, bytes = std::move(bytes)] { write_now(bytes); });
    return true;
  }
  void tell(const std::string& what) const { log::warning(fmt::format("the recording {} {}", path_.string(), what)); }

 private:
  /// Flushed at once, so that the recording survives when the display is killed.
  void write_now(const std::vector<std::byte>& bytes) {
    waiting_ -= bytes.size();
    if (failed_) return;
    file_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file_.flush();
    failed_ = !file_;
    if (failed_) tell("ends here: the file cannot be written: " + std::generic_category().message(errno));
  }

  std::filesystem::path path_;
  std::ofstream file_;  // used by the worker only
  std::atomic<std::uint64_t> waiting_{0};
  std::atomic<bool> failed_{false};
  Worker worker_{"recording"};  // last: its jobs use what is above
};

Expected<FrameRecorder> FrameRecorder::create(const std::filesystem::path& path, const RecorderSettings& settings) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file) {
    return fail(ErrorCode::io_failure, "the recording cannot be written: " + std::generic_category().message(errno),
                path.string(), "choose another file for it");
  }
  return FrameRecorder(std::make_unique<Disk>(path, std::move(file)), settings);
}

FrameRecorder::FrameRecorder(std::unique_ptr<Disk> disk, const RecorderSettings& settings)
    : disk_(std::move(disk)), settings_(settings) {
  settings_.limit_bytes = std::min(settings_.limit_bytes, kMaxRecordingBytes);
}

FrameRecorder::FrameRecorder(FrameRecorder&&) noexcept = default;

FrameRecorder::~FrameRecorder() {
  if (disk_ && goes_on_) write_end();
}

void FrameRecorder::hear(TimePoint now, const client::WorldStatus& status,
                         const client::WorldPresentation* presentation,
                         const std::vector<client::SceneObject>& manifest, const client::Frame* newest) {
  if (!goes_on_) return;
  if (status_.empty() || status.world != world_) begin_world(status.world);
  // Not later than the frame that comes with it: times never fall, and a late frame would be visible.
  const Duration at = newest != nullptr ? std::min(time_of(*newest), time_of(now)) : time_of(now);
  if (std::vector<std::byte> bytes = encode(status); bytes != status_) {
    add(RecordKind::status, at, bytes);
    status_ = std::move(bytes);
  }
  if (presentation != nullptr && !std::exchange(presented_, true))
    add(RecordKind::presentation, at, encode(*presentation));
  if (manifest.size() != objects_) {
    objects_ = manifest.size();
    add(RecordKind::manifest, at, encode(manifest));
  }
  if (newest != nullptr && objects_ > 0 && newest->sequence > sequence_) add_frame(*newest, at);
  write();
}

void FrameRecorder::hear(TimePoint now, client::Client& client) {
  const auto status = client.world_status();
  if (!status) return;
  client::Frame newest;
  const bool any = client.newest_frame(newest);
  hear(now, *status, client.presentation().get(), client.objects(), any ? &newest : nullptr);
}

void FrameRecorder::begin_world(const std::string& world) {
  world_ = world;
  status_.clear();
  presented_ = false;
  objects_ = 0;
  sequence_ = 0;
  anchor_.reset();
}

void FrameRecorder::add_frame(const client::Frame& frame, Duration at) {
  sequence_ = frame.sequence;
  if (at < due_) return;
  due_ = std::max(due_ + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(1 / settings_.fps)), at);
  ++frames_;
  add(RecordKind::frame, at, encode(frame));
}

void FrameRecorder::hear(TimePoint now, std::span<const client::WorldEvent> events) {
  if (!goes_on_ || status_.empty()) return;
  for (const client::WorldEvent& event : events)
    add(RecordKind::event, time_of(now), encode(event));
}

void FrameRecorder::add(RecordKind kind, Duration time, std::span<const std::byte> payload) {
  writer_.add(kind, time, payload);
}

Duration FrameRecorder::time_of(TimePoint now) {
  if (!began_) began_ = now;
  return std::max(now - *began_, Duration{0});
}

Duration FrameRecorder::time_of(const client::Frame& frame) {
  const Duration received = time_of(frame.received);
  if (anchor_ && frame.tick >= anchor_->tick) {
    const auto ticks = static_cast<std::int64_t>(std::min(frame.tick - anchor_->tick, kMaxMicroseconds / 1000));
    const Duration by_tick = anchor_->time + ticks * kTickPeriod;
    if (std::chrono::abs(by_tick - received) < kParting) return by_tick;
  }
  anchor_ = Anchor{frame.tick, received};
  return received;
}

void FrameRecorder::write() {
  std::vector<std::byte> bytes = writer_.take_bytes();
  if (bytes.empty()) return;
  written_ += bytes.size();
  goes_on_ = disk_->write(std::move(bytes));
  if (!goes_on_ || written_ < settings_.limit_bytes) return;
  write_end();
  disk_->tell("ends here: it has reached its size limit");
}

void FrameRecorder::write_end() {
  goes_on_ = false;
  writer_.add(RecordKind::end, Duration{0}, {});
  (void)disk_->write(writer_.take_bytes());
}

Expected<FrameRecording> FrameRecording::open_file(const std::filesystem::path& path) {
  Expected<std::vector<std::byte>> bytes = read_whole(path, kMaxRecordingBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  auto recording = open_bytes(std::move(*bytes), path.string());
  if (recording && recording->cut_off())
    log::warning("the recording " + path.string() + " is incomplete; the part that it has is shown");
  return recording;
}

Expected<FrameRecording> FrameRecording::open_bytes(std::vector<std::byte> bytes, const std::string& name) {
  FrameRecording recording;
  recording.bytes_ = std::move(bytes);
  if (auto ok = recording.read(name); !ok) return tl::unexpected(ok.error());
  return recording;
}

Expected<void> FrameRecording::read(const std::string& name) {
  const std::span<const std::byte> all(bytes_);
  if (all.size() < kPreamble || std::memcmp(all.data(), kMagic, sizeof kMagic) != 0)
    return fail(ErrorCode::damaged, "this is not a recording of frames", name,
                "give a file that 'mechane display --record' wrote");
  if (const auto version = ByteSource(all.subspan(sizeof kMagic)).get<std::uint32_t>();
      version == 0 || version > kRecordingVersion) {
    return fail(ErrorCode::wrong_version,
                fmt::format("this recording has version {}, and this program reads versions up to {}", version,
                            kRecordingVersion),
                name, "use the release that wrote it, or record again");
  }
  std::size_t at = kPreamble;
  for (std::uint64_t number = 0; at < all.size() && cut_off_; ++number) {
    ByteSource head(all.subspan(at));
    const auto kind = static_cast<RecordKind>(head.get<std::uint8_t>());
    const auto length = head.get<std::uint32_t>();
    const auto checksum = head.get<std::uint64_t>();
    if (!head.ok() || length > head.remaining()) break;  // the file ends within this record
    const auto payload = all.subspan(at + kRecordHead, length);
    if (checksum_of(checked_part(kind, payload), number) != checksum || !take(kind, payload)) {
      return fail(ErrorCode::damaged, fmt::format("the recording is damaged at byte {}", at), name,
                  "copy the file again, or record again");
    }
    at += kRecordHead + length;
  }
  if (!cut_off_ && at != all.size())
    return fail(ErrorCode::damaged, fmt::format("the file has more bytes after the recording's end, from byte {}", at),
                name, "copy the file again");
  if (std::ranges::find(records_, RecordKind::frame, &Record::kind) == records_.end())
    return fail(ErrorCode::missing, "the recording has no picture to show", name,
                "record while the display shows a world");
  return {};
}

/// Decodes the record once, so that playing it cannot fail later.
bool FrameRecording::take(RecordKind kind, std::span<const std::byte> payload) {
  ByteSource head(payload);
  const std::uint64_t microseconds = head.get_varint();
  if (!head.ok() || microseconds > kMaxMicroseconds) return false;
  const Record record{kind, std::chrono::microseconds(microseconds), payload.last(head.remaining())};
  if (!records_.empty() && record.time < records_.back().time) return false;
  switch (kind) {
    case RecordKind::status:
      if (client::WorldStatus status; !decode(record.content, status)) return false;
      break;
    case RecordKind::presentation:
      if (client::WorldPresentation presentation; !decode(record.content, presentation)) return false;
      break;
    case RecordKind::manifest:
      if (std::vector<client::SceneObject> manifest; !decode(record.content, manifest)) return false;
      break;
    case RecordKind::frame:
      if (client::Frame frame; !decode(record.content, frame)) return false;
      duration_ = record.time;
      break;
    case RecordKind::event:
      if (client::WorldEvent event; !decode(record.content, event)) return false;
      break;
    case RecordKind::end:
      cut_off_ = false;
      return record.content.empty();
    default:
      return false;
  }
  if (records_.empty() && kind != RecordKind::status) return false;  // no status has named the world yet
  records_.push_back(record);
  return true;
}

/// When the step takes place in the first world; an empty step: the whole world.
std::optional<FrameRecording::Span> FrameRecording::time_of(const std::string& step) const {
  std::optional<Span> out;
  std::string world;
  bool inside = false;
  for (const Record& record : records_) {
    if (client::WorldStatus status; record.kind == RecordKind::status && decode(record.content, status)) {
      if (world.empty()) world = status.world;
      const bool was_inside = inside;
      inside = status.world == world && (step.empty() || (status.step == step && !status.done));
      if (was_inside && !inside && out) return out;
    } else if (record.kind == RecordKind::frame && inside) {
      if (!out) out = Span{record.time, record.time};
      out->to = record.time;
    }
  }
  return out;
}

Expected<Duration> FrameRecording::moment(const std::string& text) const {
  const char* const remedy = "write seconds, as in 12.5, or a step and a share of it, as in turn@0.4";
  const auto number = [](const std::string& digits) -> std::optional<double> {
    double value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool good = read.ec == std::errc() && read.ptr == digits.data() + digits.size() && value >= 0;
    return good ? std::optional(value) : std::nullopt;
  };
  if (const auto seconds = number(text)) {
    if (*seconds > to_seconds(duration_))
      return fail(ErrorCode::invalid_value, fmt::format("the recording is only {:.1f} s long", to_seconds(duration_)),
                  text, remedy);
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*seconds));
  }
  const auto at = text.find('@');
  const std::optional<double> share = at == std::string::npos ? 0.0 : number(text.substr(at + 1));
  if (!share || *share > 1) return fail(ErrorCode::invalid_value, "this is not a moment of a recording", text, remedy);
  const std::optional<Span> span = time_of(text.substr(0, at));
  if (!span) return fail(ErrorCode::unknown_name, "the recording has no such step", text, remedy);
  return span->from + std::chrono::duration_cast<Duration>((span->to - span->from) * *share);
}

}  // namespace mechane::recording
