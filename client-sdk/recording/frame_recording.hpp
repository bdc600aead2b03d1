// Recordings of what a display receives of its worlds, so that a visit can be shown again without a server: for films,
// for tests, for a kiosk that waits for its next visitor. Unlike a journal, which runs a visit again, a recording only
// shows it.
//
// A file is the magic "MECHSEEN" and a version (u32), then records to the end. A record is
//
//     kind u8 | length u32 | checksum u64 | payload of `length` bytes
//
// with the checksum XXH3-64 of kind, length and payload, seeded with the record's number in the file. Numbers are
// little-endian. Every payload begins with the time since the recording began (LEB128, microseconds), which never
// decreases; recording_codec.hpp defines the rest.
//     status        of another world than before: all that was known so far is forgotten
//     presentation  of the world of the last status
//     manifest      all its objects
//     frame         of that world, once its manifest is known
//     event
//     end           nothing follows; a file without it was cut off: its writer was killed, or the disk was full
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/base/error.hpp"
#include <mechane/client/client.hpp>

namespace mechane::recording {

/// The version that is written. Versions 1 (without titles of objects), 2 (without goals) and 3 (without labels and ranges of quantities)
/// can be read too.
inline constexpr std::uint32_t kRecordingVersion = 4;
inline constexpr std::uint64_t kMaxRecordingBytes = std::uint64_t{1} << 30U;

enum class RecordKind : std::uint8_t { status = 1, presentation, manifest, frame, event, end };

/// Makes a recording as bytes, without a file or a clock. A time before the last one is replaced by the last one.
class RecordingWriter {
 public:
  RecordingWriter();

  void add(RecordKind kind, Duration time, std::span<const std::byte> payload);
  /// The bytes that were added since the last call.
  [[nodiscard]] std::vector<std::byte> take_bytes() { return std::exchange(bytes_, {}); }

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t records_ = 0;
  Duration last_{0};
};

struct RecorderSettings {
  double fps = 30;  ///< frames a second, at most
  std::uint64_t limit_bytes = std::uint64_t{256} << 20U;
};

/// Writes a recording. Called on its owner's thread, which never waits for the disk: the recorder has a thread of its
/// own for that. A full or slow disk, or the size limit, ends the recording with a line in the log. The file is complete
/// once the recorder is destroyed; before, all but the last moment is on the disk.
class FrameRecorder {
 public:
  /// How much may wait for the disk: a minute of most worlds.
  static constexpr std::uint64_t kMostWaitingBytes = std::uint64_t{16} << 20U;

  /// Overwrites a file of that name. Errors: it cannot be written.
  [[nodiscard]] static Expected<FrameRecorder> create(const std::filesystem::path& path,
                                                      const RecorderSettings& settings);
  FrameRecorder(FrameRecorder&&) noexcept;
  FrameRecorder& operator=(FrameRecorder&&) = delete;
  ~FrameRecorder();

  /// Writes what is new since the last call. Call it once a picture, or more often. `presentation` and `newest` are
  /// null while they are not known.
  void hear(TimePoint now, const client::WorldStatus& status, const client::WorldPresentation* presentation,
            const std::vector<client::SceneObject>& manifest, const client::Frame* newest);
  /// The same from a client that is joined; nothing before its world's status is known.
  void hear(TimePoint now, client::Client& client);
  void hear(TimePoint now, std::span<const client::WorldEvent> events);

  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// False once the recording has ended early.
  [[nodiscard]] bool goes_on() const { return goes_on_; }

 private:
  class Disk;
  FrameRecorder(std::unique_ptr<Disk> disk, const RecorderSettings& settings);
  void begin_world(const std::string& world);
  void add_frame(const client::Frame& frame, Duration at);
  void add(RecordKind kind, Duration time, std::span<const std::byte> payload);
  [[nodiscard]] Duration time_of(TimePoint now);
  [[nodiscard]] Duration time_of(const client::Frame& frame);
  void write();
  void write_end();

  std::unique_ptr<Disk> disk_;  ///< null where this was moved from
  bool goes_on_ = true;
  RecorderSettings settings_;
  RecordingWriter writer_;
  std::optional<TimePoint> began_;
  std::uint64_t written_ = 0;
  std::uint64_t frames_ = 0;
  // Of the present world.
  std::string world_;
  std::vector<std::byte> status_;  ///< as it was written last
  bool presented_ = false;
  std::size_t objects_ = 0;
  std::uint64_t sequence_ = 0;  ///< of the last frame that was seen
  Duration due_{0};             ///< when the next frame is recorded
  /// A frame's time follows from its tick, not from the moment at which a busy machine received it.
  struct Anchor {
    std::uint64_t tick = 0;
    Duration time{0};
  };
  std::optional<Anchor> anchor_;
};

/// A recording that was read and checked completely: all its content can be drawn. Immutable.
class FrameRecording {
 public:
  struct Record {
    RecordKind kind = RecordKind::end;
    Duration time{0};
    std::span<const std::byte> content;  ///< encoded by recording_codec; points into this recording
  };

  /// Errors: no such file, not a recording, another version, damaged (with the place), too large, nothing in it that
  /// could be drawn. Warns of one that was cut off.
  [[nodiscard]] static Expected<FrameRecording> open_file(const std::filesystem::path& path);
  /// The same from memory. `name` names it in errors.
  [[nodiscard]] static Expected<FrameRecording> open_bytes(std::vector<std::byte> bytes, const std::string& name);
  FrameRecording(FrameRecording&&) noexcept = default;
  FrameRecording& operator=(FrameRecording&&) noexcept = default;

  /// In chronological order.
  [[nodiscard]] std::span<const Record> records() const { return records_; }
  /// From the first record to the last frame.
  [[nodiscard]] Duration duration() const { return duration_; }
  /// A moment in a person's words. "12.5": seconds from the beginning; "turn": where that step first begins;
  /// "turn@0.4": a share (0 to 1) of that step; "@0.4": a share of the first world. Errors: no such step, or the
  /// recording is shorter.
  [[nodiscard]] Expected<Duration> moment(const std::string& text) const;
  /// The end is missing; all before it is intact.
  [[nodiscard]] bool cut_off() const { return cut_off_; }

 private:
  FrameRecording() = default;
  [[nodiscard]] Expected<void> read(const std::string& name);
  [[nodiscard]] bool take(RecordKind kind, std::span<const std::byte> payload);
  struct Span {
    Duration from{0};
    Duration to{0};
  };
  [[nodiscard]] std::optional<Span> time_of(const std::string& step) const;

  std::vector<std::byte> bytes_;
  std::vector<Record> records_;
  Duration duration_{0};
  bool cut_off_ = true;
};

}  // namespace mechane::recording
