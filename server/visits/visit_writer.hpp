// VisitWriter: the thread that writes the records of visits. Nobody else waits for the disk.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/visits/visit_file.hpp"

namespace mechane::visits {

struct VisitWriterConfig {
  std::filesystem::path file;             ///< its folder is made when it is missing
  std::uint32_t keep_days = 730;          ///< older visits are deleted; 0: age does not count
  std::uint64_t max_bytes = 200'000'000;  ///< the oldest visits go when the file is larger; one takes some 2 KB
  Duration retry_after = std::chrono::seconds(5);  ///< after a failed write, it tries again this much later
  std::size_t queue = 256;  ///< records that wait for the disk; when there are more, the oldest is lost
};

/// For ServerStatus and the log.
struct VisitWriterStatus {
  bool ok = true;       ///< false while records cannot be written
  std::string problem;  ///< the newest one, for people; empty while all is well
  std::uint64_t written = 0;
  std::uint64_t lost = 0;     ///< records, or newer states of records, for which the queue had no room
  std::uint64_t deleted = 0;  ///< because of their age or the file's size
};

/// One thread may call put() and take_unfinished(). They do not wait for the disk, but allocate: it must not be a loop's thread.
class VisitWriter {
 public:
  /// Opens the file and reads which visits the last server left unfinished: this waits for the disk. A file that cannot be used is
  /// logged, and not an error: a damaged one is set aside and a new one begun; another program's is left alone, and no records are written;
  /// where the disk is full, it tries again later. Errors: failed_process (the thread).
  [[nodiscard]] static Expected<std::unique_ptr<VisitWriter>> create(const VisitWriterConfig& config);
  /// Writes what is still in the queue, without a second try.
  ~VisitWriter();
  VisitWriter(const VisitWriter&) = delete;
  VisitWriter& operator=(const VisitWriter&) = delete;

  /// Puts a record as it is now into the queue. It replaces an older state of it that is still there.
  void put(VisitRecord record);
  /// Takes the newest visit that was cut off at this kiosk, in this scenario, when a server stopped.
  [[nodiscard]] std::optional<VisitRecord> take_unfinished(const std::string& kiosk, const std::string& scenario_hash);
  [[nodiscard]] VisitWriterStatus status() const;

 private:
  explicit VisitWriter(const VisitWriterConfig& config);

  void run();
  void write(std::deque<VisitRecord> records);
  [[nodiscard]] Expected<void> write_one(const VisitRecord& record);
  [[nodiscard]] Expected<void> open();
  [[nodiscard]] Expected<VisitFile> open_or_begin_anew();
  [[nodiscard]] Expected<void> begin_anew(const Error& why);
  void know(const std::string& number);
  [[nodiscard]] bool is_replaced() const;
  void retain(TimePoint time);
  void put_back(std::deque<VisitRecord> records);
  void set_problem(const std::string& problem);

  const VisitWriterConfig config_;

  // For the thread; before it runs, for create().
  std::optional<VisitFile> file_;
  std::uint64_t inode_ = 0;
  std::set<std::string>
      known_;  // numbers of records that were written: one that is not in the file any more was forgotten
  std::deque<std::string> known_in_order_;
  bool opened_before_ = false;
  TimePoint next_try_{};
  TimePoint next_retention_{};

  std::vector<VisitRecord> unfinished_;  // once the thread runs, for the thread that calls take_unfinished()

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::deque<VisitRecord> waiting_;
  VisitWriterStatus status_;

  std::thread thread_;  // last: it ends before the members that it uses
};

}  // namespace mechane::visits
