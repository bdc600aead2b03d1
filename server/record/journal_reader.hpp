// JournalReader: a journal's ticks, one after another, up to the first damage.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <span>
#include <vector>

#include "server/base/error.hpp"
#include "server/record/journal.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

/// Reads frame by frame: a journal of any length needs little memory. One thread.
///
///     auto journal = JournalReader::open_file(path);
///     JournalTick tick;
///     while (journal->next(tick)) world.step(tick.inputs);
///     if (journal->end().kind != JournalEnd::Kind::closed) std::cerr << journal->end().message;
class JournalReader {
 public:
  /// Errors: not_found, damaged (not a journal, or its header), wrong_version. Later damage is not an error here: see end().
  [[nodiscard]] static Expected<JournalReader> open_file(const std::filesystem::path& path);
  /// The same from memory. `name` is the place in errors.
  [[nodiscard]] static Expected<JournalReader> open_bytes(std::span<const std::byte> bytes, const std::string& name);

  JournalReader(JournalReader&&) noexcept;
  JournalReader& operator=(JournalReader&&) noexcept;
  ~JournalReader();

  [[nodiscard]] const JournalHeader& header() const { return header_; }
  /// The next tick, idle or not. False at the end, whatever its reason; then end() is complete. Every tick before it is as it was written.
  [[nodiscard]] bool next(JournalTick& out);
  [[nodiscard]] const JournalEnd& end() const { return end_; }

 private:
  struct Frame;
  explicit JournalReader(std::unique_ptr<std::istream> in);
  [[nodiscard]] Expected<void> read_header(const std::string& name);
  [[nodiscard]] bool read_frame(Frame& frame);
  [[nodiscard]] bool next_frame();
  bool take_ticks(std::vector<std::byte> payload);
  bool find_recorded(std::uint64_t from);
  bool take_recorded();
  bool take_loss(std::span<const std::byte> payload);
  bool take_close(std::span<const std::byte> payload);
  [[nodiscard]] bool stop(JournalEnd::Kind kind, std::string message);
  [[nodiscard]] bool stop_at_nonsense();

  std::unique_ptr<std::istream> in_;
  JournalHeader header_;
  JournalEnd end_;
  bool ended_ = false;
  std::uint64_t frames_ = 0;       // read so far
  std::uint64_t good_offset_ = 0;  // after the last good frame
  std::uint64_t frame_size_ = 0;   // of the frame at hand
  std::vector<std::byte> ticks_;   // the payload of the frame at hand
  std::size_t ticks_at_ = 0;       // where its next recorded tick lies
  std::uint64_t recorded_ = 0;     // the number of that tick; frame_end_ when there is none
  JournalTick current_;            // the last recorded tick: carries the samples
  std::uint64_t next_tick_ = 0;    // to give out
  std::uint64_t frame_end_ = 0;    // tick after the last one of the frame at hand
  bool after_loss_ = false;
};

}  // namespace mechane::record
