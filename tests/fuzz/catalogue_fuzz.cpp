// A catalogue may come on a stick from anywhere: whatever its bytes, it is entries inside its folder, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <unistd.h>

#include "server/content/catalogue.hpp"

namespace {

using mechane::content::Catalogue;

/// One file for all inputs of a run, in memory where there is a place for that; it goes with the program.
struct CatalogueFile {
  CatalogueFile() {
    const bool memory = access("/dev/shm", W_OK) == 0;
    const std::filesystem::path folder = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
    path = folder / fmt::format("mechane-catalogue-fuzz-{}.db", getpid());
  }
  CatalogueFile(const CatalogueFile&) = delete;
  CatalogueFile& operator=(const CatalogueFile&) = delete;
  ~CatalogueFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  std::filesystem::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CatalogueFile file;
  std::ofstream(file.path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto catalogue = Catalogue::open(file.path, Catalogue::Access::read);
  if (!catalogue) return 0;
  const auto entries = catalogue->entries();
  if (!entries) return 0;
  for (const auto& entry : *entries) {
    if (!mechane::content::is_inside(entry.path) || entry.hash.size() != 32) std::abort();
    if (!catalogue->files_of(entry.hash)) std::abort();
  }
  return 0;
}
