#include "server/record/retention.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "server/record/file.hpp"

namespace mechane::record {
namespace {

struct Journal {
  std::filesystem::path path;
  std::filesystem::file_time_type written;
  std::uint64_t bytes = 0;
};

std::vector<Journal> oldest_first(const std::filesystem::path& folder) {
  std::vector<Journal> journals;
  for (const std::filesystem::path& path : files_of(folder)) {
    if (path.extension() != kJournalExtension) continue;
    std::error_code error;
    Journal journal{path, std::filesystem::last_write_time(path, error), 0};
    if (!error) journal.bytes = std::filesystem::file_size(path, error);
    if (!error) journals.push_back(std::move(journal));
  }
  std::sort(journals.begin(), journals.end(), [](const Journal& a, const Journal& b) {
    return std::tie(a.written, a.path) < std::tie(b.written, b.path);
  });
  return journals;
}

}  // namespace

Expected<RetentionResult> keep_within(const std::filesystem::path& folder, std::uint64_t max_bytes) {
  const std::vector<Journal> journals = oldest_first(folder);
  RetentionResult result;
  for (const Journal& journal : journals)
    result.bytes += journal.bytes;
  std::string refused;
  for (const Journal& journal : journals) {
    if (result.bytes <= max_bytes) break;
    if (!AppendFile::is_free(journal.path)) continue;
    std::error_code error;
    if (!std::filesystem::remove(journal.path, error) || error) {
      refused = journal.path.string();
      continue;
    }
    result.bytes -= journal.bytes;
    ++result.deleted;
  }
  if (!refused.empty()) {
    return fail(ErrorCode::io_failure, "an old journal cannot be deleted", refused, "check the folder's rights");
  }
  return result;
}

}  // namespace mechane::record
