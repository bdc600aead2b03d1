#include "server/record/file.hpp"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "server/base/whole_file.hpp"

namespace mechane::record {

std::string file_name_of(const std::string& name) {
  std::string out = name.empty() ? "_" : name;
  for (char& c : out) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '.' && c != '-' && c != '_') c = '_';
  }
  if (out.front() == '.') out.front() = '_';
  return out;
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
  if (file.fd_ < 0) return tl::unexpected(file_error("cannot be made", file.name_, errno));
  // The file is new, so that the lock is free. On a file system without locks, retention may delete a journal that is being written.
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
  // Cutting a file back needs no room on the disk. If even that fails, the file ends in half a frame. A reader stops there, so that it
  // would not find what is appended later: the file is given up.
  if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0) close();
  return tl::unexpected(file_error("cannot be written", name_, error));
}

Expected<void> AppendFile::sync() {
  if (::fdatasync(fd_) != 0) return tl::unexpected(file_error("cannot be flushed to the disk", name_, errno));
  return {};
}

void AppendFile::close() {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
}

}  // namespace mechane::record
