// JournalChannel: one world's queue from its loop to its journal and snapshot file. For this room only; others use WorldRecorder.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "server/realtime/byte_ring.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/record/file.hpp"
#include "server/record/journal.hpp"
#include "server/record/journal_writer.hpp"
#include "server/record/tick_codec.hpp"

namespace mechane::record {

/// One thread may call the loop side, one other thread the disk side.
class JournalChannel {
 public:
  struct Snapshot {
    std::uint64_t tick = 0;
    std::vector<std::byte> bytes;
  };

  /// `replaced`: snapshots that are removed when the first one of this world is on the disk.
  JournalChannel(const JournalHeader& header, std::filesystem::path journal, std::filesystem::path snapshot,
                 std::size_t ring_bytes, std::size_t snapshot_capacity, Duration retry_after,
                 std::vector<std::filesystem::path> replaced = {});

  // The loop side.
  void push(const TickRecord& record) noexcept;
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::vector<std::byte>& snapshot_buffer() noexcept { return snapshots_.writable().bytes; }
  void commit_snapshot(std::uint64_t tick) noexcept;
  /// The tick after the last one that push() saw.
  [[nodiscard]] std::uint64_t through_tick() const noexcept { return through_tick_.load(std::memory_order_acquire); }
  [[nodiscard]] const std::filesystem::path& journal_path() const noexcept { return journal_path_; }

  // The disk side.
  /// Writes what is in the ring to the journal, and the newest snapshot. After the disk has refused, the ring is emptied without writing
  /// until the time to try again has come.
  void drain(TimePoint now);
  void sync();
  /// Drains, ends the journal and closes it.
  void finish(TimePoint now, std::optional<std::uint64_t> hash, bool remove_snapshot);
  [[nodiscard]] bool ok() const { return problem().empty(); }
  /// What is wrong now: with the journal, else with the snapshot; empty while all is well.
  [[nodiscard]] const std::string& problem() const;
  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }
  /// Ticks that the journal says are missing, and those that it will say so of when the disk can be written again.
  [[nodiscard]] std::uint64_t ticks_lost() const;
  [[nodiscard]] std::uint64_t snapshots_written() const { return snapshots_written_; }

 private:
  void gather();
  void discard();
  void store(TimePoint now);
  [[nodiscard]] Expected<void> append(std::span<const std::byte> bytes);
  void write_snapshot();
  void remove_replaced();

  realtime::ByteRing ring_;
  realtime::Mailbox<Snapshot> snapshots_;
  std::array<std::byte, 8 + kMaxEncodedTick> encoded_;  // the loop's
  std::atomic<std::uint64_t> through_tick_;
  std::atomic<std::uint64_t> refused_{0};

  // The disk side's own.
  std::uint64_t taken_through_;  // the first tick that may still be in the ring
  JournalHeader header_;         // its snapshot moves into the file's first bytes
  std::filesystem::path journal_path_;
  std::filesystem::path snapshot_path_;
  std::vector<std::filesystem::path> replaced_;  // until the first snapshot is on the disk
  Duration retry_after_;
  JournalWriter writer_;
  JournalWriter::Position stored_;    // what the file holds
  std::vector<std::byte> beginning_;  // of the file, until it is stored
  AppendFile file_;
  bool given_up_ = false;  // the file ends in half a frame that could not be cut off: nothing more is written
  std::optional<TimePoint> rest_until_;
  std::string journal_problem_;
  std::string sync_problem_;
  std::string snapshot_problem_;
  std::uint64_t bytes_written_ = 0;
  std::uint64_t snapshots_written_ = 0;
};

}  // namespace mechane::record
