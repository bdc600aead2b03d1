// VisitFile: the records of a museum's visits in one SQLite file, which the server writes and `mechane visits` reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/visits/visit_record.hpp"

namespace mechane::visits {

inline constexpr const char* kVisitFileName = "visits.db";

/// Which visits: those that fit all fields. An empty field fits every visit.
struct VisitChoice {
  std::optional<std::int64_t> since{};   ///< began in this minute or later
  std::optional<std::int64_t> before{};  ///< began before this minute
  std::string scenario{};
  std::string kiosk{};
  std::string number{};    ///< or its first letters, with or without dashes
  std::size_t newest = 0;  ///< at most so many of those, the newest; 0: all
};

/// One open file. Not thread-safe, and never for a loop thread: it reads the disk. Several programs may have it open; a writer waits up
/// to five seconds for another one. It is in SQLite's write-ahead mode: what was put is still there after a kill or a power cut.
class VisitFile {
 public:
  /// read: an observer who looks. write: an observer who remarks or forgets. write_new: the server, which makes the file where it is
  /// missing.
  enum class Access : std::uint8_t { read, write, write_new };

  /// Errors: not_found; invalid_value (not a file, or another program's database); wrong_version (a newer Mechane's); damaged; io_failure,
  /// busy.
  [[nodiscard]] static Expected<VisitFile> open(const std::filesystem::path& file, Access access);
  VisitFile(VisitFile&&) noexcept;
  VisitFile& operator=(VisitFile&&) noexcept;
  ~VisitFile();

  /// Writes a record as it is now, without its remarks: those only an observer writes. `is_new`: it is not in the file yet. False where it
  /// is not new and not in the file any more: somebody has had the visit forgotten, and it is not written again.
  [[nodiscard]] Expected<bool> put(const VisitRecord& record, bool is_new);

  /// Sorted by when they began, then by number. Errors: damaged.
  [[nodiscard]] Expected<std::vector<VisitRecord>> records(const VisitChoice& choice) const;
  /// The numbers of all records.
  [[nodiscard]] Expected<std::set<std::string>> numbers() const;
  /// How many records there are in all.
  [[nodiscard]] Expected<std::size_t> count() const;

  /// Adds a remark; `number` may be the beginning of one. Returns the whole number. Errors: unknown_name (no such visit), conflict (several
  /// begin with it), invalid_value and too_large (the text).
  [[nodiscard]] Expected<std::string> remark(const std::string& number, const RecordedRemark& remark);
  /// Deletes visits, and overwrites their place in the file. Returns how many there were. A choice without any field is an error (missing):
  /// it would delete all.
  [[nodiscard]] Expected<std::size_t> forget(const VisitChoice& choice);

  /// Changes the ending of visits that are still 'running' to 'cut': the server that wrote them has stopped. Returns the visits that ended
  /// so and began at or after `since`.
  [[nodiscard]] Expected<std::vector<VisitRecord>> cut_running(std::int64_t since);
  /// Deletes visits that began before a minute, and then the oldest until the file has at most `max_bytes`. Returns how many.
  [[nodiscard]] Expected<std::size_t> keep_within(std::int64_t before_minute, std::uint64_t max_bytes);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  struct Connection;
  VisitFile(std::filesystem::path file, std::unique_ptr<Connection> connection);
  std::filesystem::path file_;
  std::unique_ptr<Connection> connection_;
};

/// Moves a damaged file, and what SQLite keeps beside it, out of the way: "visits.db.damaged-20261122-0940". Returns its new name.
[[nodiscard]] Expected<std::filesystem::path> set_aside(const std::filesystem::path& file);

}  // namespace mechane::visits
