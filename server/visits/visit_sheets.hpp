// VisitSheets: the one thread that writes visits' sheets, whatever the disk does.
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

struct VisitSheetsConfig {
  std::filesystem::path file;                      ///< its folder is made when it is missing
  std::uint32_t keep_days = 730;                   ///< older sheets are deleted; 0: none for its age
  std::uint64_t max_bytes = 200'000'000;           ///< the oldest go when the file is larger; a sheet takes some 2 KB
  Duration retry_after = std::chrono::seconds(5);  ///< how long the file rests after the disk refused it
  std::size_t queue = 256;                         ///< sheets that wait for the disk at most; then the oldest is lost
};

/// For ServerStatus and the log.
struct VisitSheetsStatus {
  bool ok = true;       ///< false while sheets cannot be written
  std::string problem;  ///< the newest one, for people; empty while all is well
  std::uint64_t written = 0;
  std::uint64_t lost = 0;     ///< sheets, or newer states of sheets, that found no room in the queue
  std::uint64_t deleted = 0;  ///< for their age, or for the file's size
};

/// put() and take_unfinished() are for one thread, which never waits for the disk in them; it is not a loop's, for they allocate.
class VisitSheets {
 public:
  /// Opens the file and looks for what the last server left unfinished: this waits for the disk. A file that cannot be used is no
  /// error: a damaged one is set aside and a new one begun; another program's is left alone and no sheet is written; a full disk is
  /// tried again. Each is logged. Errors: no thread.
  [[nodiscard]] static Expected<std::unique_ptr<VisitSheets>> create(const VisitSheetsConfig& config);
  /// Writes what waits, once.
  ~VisitSheets();
  VisitSheets(const VisitSheets&) = delete;
  VisitSheets& operator=(const VisitSheets&) = delete;

  /// The sheet as it is now; a newer one of the same number takes the place of one that still waits.
  void put(VisitSheet sheet);
  /// The newest sheet that a server's stop has cut off at this kiosk, in this scenario; it is then this server's.
  [[nodiscard]] std::optional<VisitSheet> take_unfinished(const std::string& kiosk, const std::string& scenario_hash);
  [[nodiscard]] VisitSheetsStatus status() const;

 private:
  explicit VisitSheets(const VisitSheetsConfig& config);

  void run();
  void write(std::deque<VisitSheet> sheets);
  [[nodiscard]] Expected<void> write_one(const VisitSheet& sheet);
  [[nodiscard]] Expected<void> open();
  [[nodiscard]] Expected<VisitFile> open_or_begin_anew();
  [[nodiscard]] Expected<void> begin_anew(const Error& why);
  void know(const std::string& number);
  [[nodiscard]] bool is_replaced() const;
  void retain(TimePoint time);
  void put_back(std::deque<VisitSheet> sheets);
  void set_problem(const std::string& problem);

  const VisitSheetsConfig config_;

  // The thread's; before it runs, the maker's.
  std::optional<VisitFile> file_;
  std::uint64_t inode_ = 0;
  std::set<std::string> known_;  // numbers that are in the file: a sheet of these that is not there is forgotten
  std::deque<std::string> known_in_order_;
  bool opened_before_ = false;
  TimePoint next_try_{};
  TimePoint next_retention_{};

  std::vector<VisitSheet> unfinished_;  // the other's, once the thread runs

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::deque<VisitSheet> waiting_;
  VisitSheetsStatus status_;

  std::thread thread_;  // last: it ends before what it uses does
};

}  // namespace mechane::visits
