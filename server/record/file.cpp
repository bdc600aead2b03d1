#include "server/record/file.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace mechane::record {
namespace {

tl::unexpected<Error> system_failure(const std::string& what, const std::string& where, int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return fail(what + ": " + std::strerror(error), where,
              full ? "make room on the disk" : "check the disk and the folder's rights");
}

// Every byte, or errno.
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

// A rename is on the disk only when its folder is.
int sync_folder(const std::filesystem::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return errno;
  const int error = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  return error;
}

int write_new_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0640);
  if (fd < 0) return errno;
  int error = write_all(fd, bytes);
  if (error == 0 && ::fsync(fd) != 0) error = errno;
  if (::close(fd) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::string file_name_of(const std::string& name) {
  std::string out = name.empty() ? "_" : name;
  for (char& c : out) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '.' && c != '-' && c != '_') c = '_';
  }
  if (out.front() == '.') out.front() = '_';
  return out;
}

Expected<void> replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::path beside = path;
  beside += ".new";
  int error = write_new_file(beside, bytes);
  if (error == 0 && ::rename(beside.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(beside.c_str());
    return system_failure("cannot be written", path.string(), error);
  }
  error = sync_folder(path.has_parent_path() ? path.parent_path() : ".");
  if (error != 0) return system_failure("cannot be flushed to the disk", path.string(), error);
  return {};
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code vanished;
    if (it->is_regular_file(vanished)) files.push_back(it->path());
  }
  return files;
}

AppendFile::AppendFile(AppendFile&& other) noexcept {
  *this = std::move(other);
}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  if (this != &other) {
    close();
    fd_ = std::exchange(other.fd_, -1);
    size_ = std::exchange(other.size_, 0);
    name_ = std::move(other.name_);
  }
  return *this;
}

AppendFile::~AppendFile() {
  close();
}

Expected<AppendFile> AppendFile::create(const std::filesystem::path& path) {
  AppendFile file;
  file.name_ = path.string();
  file.fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0640);
  if (file.fd_ < 0) return system_failure("cannot be made", file.name_, errno);
  // Nobody else knows the file yet; a file system without locks only means that retention trusts the folder to us.
  (void)::flock(file.fd_, LOCK_EX | LOCK_NB);
  return file;
}

bool AppendFile::is_free(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool free = ::flock(fd, LOCK_EX | LOCK_NB) == 0;
  ::close(fd);
  return free;
}

Expected<void> AppendFile::append(std::span<const std::byte> bytes) {
  const int error = write_all(fd_, bytes);
  if (error == 0) {
    size_ += bytes.size();
    return {};
  }
  // Cutting a file back needs no room on the disk. If even that fails, a reader finds the half frame by its checksum, and what a
  // later try appends behind it is not found: so this file is given up.
  if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0) close();
  return system_failure("cannot be written", name_, error);
}

Expected<void> AppendFile::sync() {
  if (::fdatasync(fd_) != 0) return system_failure("cannot be flushed to the disk", name_, errno);
  return {};
}

void AppendFile::close() {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

}  // namespace mechane::record
