#include "server/content/importer/folder_io.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include <assimp/MemoryIOWrapper.h>

#include "server/base/utf8.hpp"
#include "server/content/importer/obj_text.hpp"

namespace mechane::content {

namespace fs = std::filesystem;

namespace {

/// Null where it cannot be read.
Assimp::IOStream* open_obj(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad() || !in.is_open()) return nullptr;
  const std::string text = plain_obj(bytes);
  auto copy = std::make_unique<std::uint8_t[]>(text.size());
  std::copy(text.begin(), text.end(), copy.get());
  return new Assimp::MemoryIOStream(copy.release(), text.size(), true);
}

}  // namespace

FolderIo::FolderIo(const fs::path& folder, std::uint64_t most_bytes) : most_bytes_(most_bytes) {
  std::error_code code;
  folder_ = fs::canonical(folder.empty() ? "." : folder, code);
}

std::optional<fs::path> FolderIo::allowed(const fs::path& name) const {
  std::error_code code;
  const fs::path real = fs::canonical(name.is_absolute() ? name : folder_ / name, code);
  if (code || !fs::is_regular_file(real, code)) return std::nullopt;
  const auto [end, at] = std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
  if (end != folder_.end() || at == real.end()) return std::nullopt;
  if (fs::file_size(real, code) > most_bytes_ || code) return std::nullopt;
  return real;
}

bool FolderIo::Exists(const char* name) const {
  return allowed(name).has_value();
}

Assimp::IOStream* FolderIo::Open(const char* name, const char* mode) {
  const std::optional<fs::path> real = allowed(name);
  if (!real || std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
  if (lower_case(fs::path(name).extension().string()) == ".obj") return open_obj(*real);
  return DefaultIOSystem::Open(real->c_str(), mode);
}

}  // namespace mechane::content
