// Who did what through the gateway: one JSON object a line, only ever appended to, in files of a limited size.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::gateway {

struct AuditEntry {
  std::string time;  ///< "2026-11-22T09:40:12Z"
  std::string user;
  std::string address;
  std::string action;  ///< "sign-in", "open", "settings" ...
  std::string detail;
};

/// On the loop's thread: a line is one short write to a file.
class AuditLog {
 public:
  static constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20U;  ///< of a file; then the next one begins
  static constexpr int kOldFiles = 9;                                     ///< audit.log.1 (the newest) .. audit.log.9

  explicit AuditLog(const std::filesystem::path& folder) : file_(folder / "audit.log") {}
  /// With the present time. Errors: io_failure.
  [[nodiscard]] Expected<void> add(std::string_view user, std::string_view address, std::string_view action,
                                   std::string_view detail);
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

/// The newest entries of a log, newest first; lines that are no entries are left out. Reads the disk. Any thread.
[[nodiscard]] std::vector<AuditEntry> newest_entries(const std::filesystem::path& file, std::size_t most);

}  // namespace mechane::gateway
