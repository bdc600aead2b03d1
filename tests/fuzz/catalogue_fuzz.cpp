// A catalogue may come on a stick from anywhere: whatever its bytes, it gives entries inside its folder, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "server/content/catalogue.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using mechane::content::Catalogue;

/// One file for all inputs of a run, in memory where possible; it is deleted at the end of the program.
const std::filesystem::path& catalogue_file() {
  static const mechane::test::ScratchFolder kFolder(mechane::test::folder_in_memory());
  static const std::filesystem::path kFile = kFolder.path() / "catalogue.db";
  return kFile;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path& file = catalogue_file();
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto catalogue = Catalogue::open(file, Catalogue::Access::read);
  if (!catalogue) return 0;
  const auto entries = catalogue->entries();
  if (!entries) return 0;
  for (const auto& entry : *entries) {
    if (!mechane::content::is_inside(entry.path) || entry.hash.size() != 32) std::abort();
    const auto files = catalogue->files_of(entry.hash);
    if (!files) continue;  // the damaged page is of the index, which entries() does not read
    for (const auto& found : *files) {
      if (!mechane::content::is_inside(found.lexically_relative(file.parent_path()).string())) std::abort();
    }
  }
  return 0;
}
