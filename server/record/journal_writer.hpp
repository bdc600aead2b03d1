// JournalWriter: turns ticks into the bytes of a journal. It writes no file: the recorder appends what take_bytes() gives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/record/journal.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

/// One thread. Ticks are gathered into a frame until flush() ends it: what is not flushed is not in the bytes.
///
///     JournalWriter writer(header);
///     writer.add(record);
///     writer.close(state_hash(world));
///     append(file, writer.take_bytes());
class JournalWriter {
 public:
  /// The bytes begin with the file's preamble and header frame. The header's snapshot is at most 63 MiB.
  explicit JournalWriter(const JournalHeader& header);

  /// Adds the next tick. Where numbers were left out since the last one, a loss is written first. Ticks never go back.
  void add(const TickRecord& record);
  /// As add(), for a tick that encode_tick wrote before.
  void add_encoded(std::uint64_t tick, std::span<const std::byte> encoded);
  /// Ends the frame of ticks.
  void flush();
  /// Ends the journal. `through_tick` is the first tick that was not run: ticks between the last one added and it are written as a loss.
  void close(std::optional<std::uint64_t> hash, std::optional<std::uint64_t> through_tick = {});

  /// All bytes since the last call.
  [[nodiscard]] std::vector<std::byte> take_bytes();
  /// The tick that is expected next.
  [[nodiscard]] std::uint64_t next_tick() const { return at_.next_tick; }
  [[nodiscard]] std::uint64_t lost_ticks() const { return at_.lost; }

  /// Where the journal is. rewind() goes back to it, for when the bytes since could not be stored: the next add() then writes the ticks
  /// since as a loss. Only right after flush() or construction.
  struct Position {
    std::uint64_t frame = 0;
    std::uint64_t first_tick = 0;
    std::uint64_t next_tick = 0;
    std::uint64_t lost = 0;
  };
  [[nodiscard]] Position position() const { return at_; }
  void rewind(const Position& position);

 private:
  void note_loss_before(std::uint64_t tick);
  void put_frame(journal_format::FrameKind kind, std::span<const std::byte> payload);

  std::vector<std::byte> bytes_;
  std::vector<std::byte> ticks_;        // records of the frame that is being gathered
  std::uint64_t frame_first_tick_ = 0;  // of that frame
  std::uint64_t last_recorded_ = 0;     // tick after the last one that is not idle, in that frame
  Position at_;
};

}  // namespace mechane::record
