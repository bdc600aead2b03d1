#include "server/content/whole_file.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include <stdlib.h>
#include <unistd.h>

namespace mechane::content {

namespace fs = std::filesystem;

Expected<void> write_whole(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code code;
  fs::create_directories(file.parent_path(), code);
  std::string draft = file.string() + ".XXXXXX";
  const int fd = mkstemp(draft.data());
  if (fd < 0) return fail("cannot be written", file.string());
  ::close(fd);
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) fs::rename(draft, file, code);
  if (out && !code) return {};
  std::error_code ignored;
  fs::remove(draft, ignored);
  return fail(code ? code.message() : "cannot be written whole", file.string());
}

}  // namespace mechane::content
