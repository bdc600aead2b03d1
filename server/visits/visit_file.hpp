// VisitFile: the sheets of a museum's visits in one SQLite file, which the server writes and `mechane visits` reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/visits/visit_sheet.hpp"

namespace mechane::visits {

inline constexpr const char* kVisitFileName = "visits.db";

/// Which sheets; what is left out does not choose.
struct VisitChoice {
  std::optional<std::int64_t> since{};   ///< minute: began then or later
  std::optional<std::int64_t> before{};  ///< minute: began before it
  std::string scenario{};
  std::string kiosk{};
  std::string number{};  ///< or its first letters, with or without dashes
};

/// One open file. Not thread-safe, and never for a loop thread: it reads the disk. Several programs may have it open; a writer waits up
/// to five seconds for another one. It is in SQLite's write-ahead mode: what was put is there after a kill, and after a power cut.
class VisitFile {
 public:
  /// read: an observer's desk. write: the server, and an observer who remarks or forgets; write_new also makes the file.
  enum class Access : std::uint8_t { read, write, write_new };

  /// Why a file cannot be used, for who has to decide what to do about it.
  enum class Trouble : std::uint8_t {
    none,
    missing,
    foreign,  ///< another program's, or a newer Mechane's: nothing to be touched
    damaged,
    other,  ///< rights, disk, another writer: may pass
  };

  /// Errors: no such file, not ours, one of a newer Mechane, a damaged one, no right to read or write. `trouble`: which of them.
  [[nodiscard]] static Expected<VisitFile> open(const std::filesystem::path& file, Access access,
                                                Trouble* trouble = nullptr);
  VisitFile(VisitFile&&) noexcept;
  VisitFile& operator=(VisitFile&&) noexcept;
  ~VisitFile();

  /// Writes a sheet as it is now, without its remarks, which are an observer's. `is_new`: it is not in the file yet; else, where it is
  /// not there any more, somebody wanted it forgotten, and it stays so: false.
  [[nodiscard]] Expected<bool> put(const VisitSheet& sheet, bool is_new, Trouble* trouble = nullptr);

  /// By when they began, then by number. Errors: damaged.
  [[nodiscard]] Expected<std::vector<VisitSheet>> sheets(const VisitChoice& choice) const;
  /// How many sheets there are in all.
  [[nodiscard]] Expected<std::size_t> count() const;

  /// Errors: no sheet of that number, or several begin so; an empty or too long text; control characters.
  [[nodiscard]] Expected<std::string> remark(const std::string& number, const SheetRemark& remark);
  /// Deletes, and writes over where they stood. Returns how many there were. A choice of nothing is an error: all would go.
  [[nodiscard]] Expected<std::size_t> forget(const VisitChoice& choice);

  /// Calls what still runs 'cut', for nobody writes at it any more, and returns those that began at or after `since`.
  [[nodiscard]] Expected<std::vector<VisitSheet>> cut_running(std::int64_t since, Trouble* trouble = nullptr);
  /// Deletes what began before a minute, and then the oldest until the file has `max_bytes` at most. Returns how many.
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
