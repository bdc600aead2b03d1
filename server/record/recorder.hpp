// Recorder: the thread that writes the journals and snapshots of all worlds. The loops never wait for the disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/record/journal.hpp"
#include "server/record/tick_record.hpp"

namespace mechane::record {

class JournalChannel;
class Recorder;

struct RecorderConfig {
  std::filesystem::path folder;                   ///< made when it is missing
  std::uint64_t max_journal_bytes = 20ull << 30;  ///< of all journals together; the oldest closed ones go first
  std::size_t ring_bytes = 4u << 20;  ///< a world's buffer, a power of two; 4 MiB hold some 20 s of one hand
  Duration drain_period = std::chrono::milliseconds(20);  ///< how often the rings are emptied: what a kill -9 loses
  Duration sync_period =
      std::chrono::seconds(1);  ///< how often journals are flushed to the disk: what a power cut loses
  Duration retry_after = std::chrono::seconds(5);  ///< how long a journal rests after the disk refused it
};

/// For ServerStatus and the log.
struct RecorderStatus {
  bool records_ok = true;           ///< false while any file cannot be written
  std::string problem;              ///< the newest one, for people; empty while all is well
  std::uint64_t bytes_written = 0;  ///< to journals
  std::uint64_t ticks_lost = 0;     ///< in no journal; the journals say that they are missing
  std::uint64_t snapshots_written = 0;
  std::uint64_t journals_deleted = 0;  ///< to keep within max_journal_bytes
  std::uint64_t open_journals = 0;
};

/// One world's connection to the recorder. Only the thread that runs the world may call push() and the functions for snapshots; close() may
/// be called by any one thread, after the last of those calls. Must not outlive its Recorder.
class WorldRecorder {
 public:
  WorldRecorder(WorldRecorder&& other) noexcept;
  WorldRecorder& operator=(WorldRecorder&& other) noexcept;
  ~WorldRecorder();  ///< closes the journal without a hash

  /// Called in the loop: no allocation, lock, or wait. A tick that finds no room is lost, counted, and marked in the journal.
  void push(const TickRecord& record) noexcept;
  /// Ticks that push() found no room for.
  [[nodiscard]] std::uint64_t refused() const noexcept;

  /// The loop fills this buffer with state::write_snapshot, once a second or so, and hands it over with commit_snapshot().
  /// Its capacity was given to open(): a snapshot of at most that size allocates nothing.
  [[nodiscard]] std::vector<std::byte>& snapshot_buffer() noexcept;
  void commit_snapshot(std::uint64_t tick) noexcept;

  /// What happens to the snapshot of a world that ends: `keep` it for a restart, or `remove` it because the visit is over.
  enum class Snapshot { keep, remove };
  /// Waits until everything pushed is in the file, with the final hash, and the file is closed. Never from the loop.
  void close(std::optional<std::uint64_t> final_hash = {}, Snapshot snapshot = Snapshot::keep);

  /// The journal's path. The file may not exist yet.
  [[nodiscard]] const std::filesystem::path& journal_path() const noexcept;

 private:
  friend class Recorder;
  WorldRecorder(Recorder& recorder, JournalChannel& channel) : recorder_(&recorder), channel_(&channel) {}
  Recorder* recorder_;
  JournalChannel* channel_;  // null after close() and after a move
};

/// Owns one thread of ordinary priority. When the disk is full or gone, records are lost, but ticks are never delayed: the recorder says so
/// once in the log and in status(), drops what it cannot write, tries again, and marks the gap in the journal.
class Recorder {
 public:
  /// Errors: invalid_value (a setting), io_failure (the folder), failed_process (the thread).
  [[nodiscard]] static Expected<std::unique_ptr<Recorder>> create(const RecorderConfig& config);
  /// Writes what is left, closes all journals, and joins the thread.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Begins a journal "<folder>/<world>-<start time>.journal". `snapshot_capacity`: bytes of a snapshot of this world, with room to
  /// spare. A start_wall_ns of 0 becomes now. A file that cannot be made now is tried again later. Any thread but the loops.
  /// `replaced`: snapshots of earlier worlds. They are removed when the first one of this world is on the disk, so that there always is
  /// one.
  [[nodiscard]] WorldRecorder open(JournalHeader header, std::size_t snapshot_capacity,
                                   std::vector<std::filesystem::path> replaced = {});

  /// Any thread but the loops.
  [[nodiscard]] RecorderStatus status() const;

 private:
  friend class WorldRecorder;
  struct Entry;
  struct Work;
  explicit Recorder(const RecorderConfig& config);
  void run();
  std::vector<Work> wait_for_work(bool& stopping);
  void do_work(const std::vector<Work>& work, TimePoint time);
  void finish_work(const std::vector<Work>& work);
  void close_channel(const JournalChannel& channel, std::optional<std::uint64_t> final_hash, bool remove_snapshot);

  RecorderConfig config_;
  mutable std::mutex mutex_;  // guards what follows, up to thread_; no loop ever takes it
  std::condition_variable wake_;
  std::condition_variable closed_;
  bool stop_ = false;
  std::vector<std::unique_ptr<Entry>> entries_;
  RecorderStatus status_;
  RecorderStatus of_closed_;  // the counts of channels that are gone
  // The thread's own.
  TimePoint next_sync_;
  TimePoint next_retention_;
  std::uint64_t journals_deleted_ = 0;
  std::string retention_problem_;
  std::thread thread_;
};

}  // namespace mechane::record
