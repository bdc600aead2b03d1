#include "client-sdk/fit/output_file.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "server/base/whole_file.hpp"

namespace mechane::fit {
namespace {

namespace fs = std::filesystem;

/// A file that is removed unless it is kept; also when the program is interrupted.
class Draft {
 public:
  Draft(fs::path path, Interruption& interruption) : path_(std::move(path)), interruption_(interruption) {
    interruption_.add_draft(path_);  // before it exists, so that it can never be left behind
    fd_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    if (fd_ >= 0) ::close(fd_);
    if (!kept_) unlink(path_.c_str());
    interruption_.remove_draft(path_);
  }

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

  /// False with errno set.
  [[nodiscard]] bool write(std::span<const std::byte> bytes) const {
    errno = write_all(fd_, bytes);
    return errno == 0 && fsync(fd_) == 0;
  }

  [[nodiscard]] bool keep_as(const fs::path& file) {
    kept_ = rename(path_.c_str(), file.c_str()) == 0;
    return kept_;
  }

 private:
  fs::path path_;
  Interruption& interruption_;
  int fd_ = -1;
  bool kept_ = false;
};

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

tl::unexpected<Error> write_failure(int code, const fs::path& file) {
  const char* remedy = "check the permissions of folder and file, or name another folder with -o";
  if (code == ENOSPC || code == EDQUOT || code == EFBIG)
    remedy = "make room on the disk, or name another folder with -o";
  return fail(ErrorCode::io_failure, fmt::format("cannot be written: {}", std::strerror(code)), file.string(), remedy);
}

}  // namespace

Expected<void> prepare_folder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code)
    return fail(ErrorCode::io_failure, fmt::format("the folder cannot be made: {}", code.message()), folder.string(),
                "name another with -o");
  if (!fs::is_directory(folder, code))
    return fail(ErrorCode::invalid_value, "this is not a folder", folder.string(), "name a folder with -o");
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    return fail(ErrorCode::io_failure, fmt::format("the folder cannot be written: {}", std::strerror(errno)),
                folder.string(), "change its permissions, or name another with -o");
  }
  return {};
}

Expected<void> write_whole(const fs::path& file, std::span<const std::byte> bytes, Interruption& interruption) {
  // Two runs may write the same file: each has its own draft, and the later rename decides.
  Draft draft(folder_of(file) / fmt::format(".{}.{}.draft", file.filename().string(), getpid()), interruption);
  if (!draft.is_open() || !draft.write(bytes) || !draft.keep_as(file)) return write_failure(errno, file);
  return {};
}

}  // namespace mechane::fit
