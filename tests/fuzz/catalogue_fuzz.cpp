// A catalogue may come on a stick from anywhere: whatever its bytes, it is entries inside its folder, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "server/content/catalogue.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using mechane::content::Catalogue;
  const int fd = memfd_create("catalogue", MFD_CLOEXEC);
  if (fd < 0) std::abort();
  if (write(fd, data, size) != static_cast<ssize_t>(size)) std::abort();
  const auto catalogue = Catalogue::open("/proc/self/fd/" + std::to_string(fd), Catalogue::Access::read);
  if (catalogue) {
    if (const auto entries = catalogue->entries()) {
      for (const auto& entry : *entries) {
        if (!mechane::content::is_inside(entry.path) || entry.hash.size() != 32) std::abort();
        if (!catalogue->files_of(entry.hash)) std::abort();
      }
    }
  }
  close(fd);
  return 0;
}
