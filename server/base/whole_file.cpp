#include "server/base/whole_file.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace mechane {
namespace {

namespace fs = std::filesystem;

/// Opens the draft, and sets `name` to what it is called. Below 0 on an error, which errno tells.
int open_draft(const fs::path& file, WholeFile how, std::string& name) {
  if (how != WholeFile::shared) {
    name = file.string() + ".new";
    return ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, how == WholeFile::durable ? 0640 : 0666);
  }
  name = file.string() + ".XXXXXX";
  return ::mkostemp(name.data(), O_CLOEXEC);
}

/// Writes and closes the draft. Returns 0, or errno.
int fill(int fd, std::span<const std::byte> bytes, WholeFile how) {
  int error = write_all(fd, bytes);
  if (error == 0 && how != WholeFile::shared && ::fsync(fd) != 0) error = errno;
  if (::close(fd) != 0 && error == 0) error = errno;
  return error;
}

/// Writes into a device or a pipe.
Expected<void> write_into(const fs::path& file, std::span<const std::byte> bytes) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  int error = fd < 0 ? errno : write_all(fd, bytes);
  if (fd >= 0 && ::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) return tl::unexpected(file_error("cannot be written", file, error));
  return {};
}

}  // namespace

int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return ENOSPC;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

int flush_to_disk(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return errno;
  const int error = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  return error;
}

Error file_error(const std::string& what, const fs::path& file, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return {ErrorCode::io_failure, what + ": " + std::strerror(error), file.string(),
          full ? "make room on the disk" : "check the disk and the folder's rights"};
}

Expected<void> write_whole(const fs::path& file, std::span<const std::byte> bytes, WholeFile how) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code ignored;  // where the folder cannot be made, the draft cannot be opened
  if (how == WholeFile::shared) fs::create_directories(folder, ignored);
  if (how == WholeFile::document) {
    if (fs::is_other(file, ignored)) return write_into(file, bytes);
    if (fs::is_symlink(file, ignored) && fs::exists(file, ignored)) return write_whole(fs::canonical(file), bytes, how);
  }
  std::string draft;
  const int fd = open_draft(file, how, draft);
  if (fd < 0) return tl::unexpected(file_error("cannot be written", file, errno));
  int error = fill(fd, bytes, how);
  if (error == 0 && ::rename(draft.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(draft.c_str());
    return tl::unexpected(file_error("cannot be written", file, error));
  }
  // A rename is on the disk only when its folder is.
  if (how != WholeFile::shared) error = flush_to_disk(folder);
  if (error != 0) return tl::unexpected(file_error("cannot be flushed to the disk", file, error));
  return {};
}

Expected<std::vector<std::byte>> read_whole(const fs::path& file, std::uintmax_t most_bytes) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error == std::errc::no_such_file_or_directory)
    return fail(ErrorCode::not_found, "does not exist", file.string(), "check its name and folder");
  if (!error && size > most_bytes) {
    return fail(ErrorCode::too_large,
                "has " + std::to_string(size) + " bytes; at most " + std::to_string(most_bytes) + " are allowed",
                file.string(), "check that it is the right file");
  }
  std::vector<std::byte> bytes(error ? 0 : size);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!error && !in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  if (error)
    return fail(ErrorCode::io_failure, "cannot be read: " + error.message(), file.string(),
                "check the file's rights and the disk");
  return bytes;
}

}  // namespace mechane
