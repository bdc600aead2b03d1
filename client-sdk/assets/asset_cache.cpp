#include "client-sdk/assets/asset_cache.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"
#include "server/log/log.hpp"

namespace mechane::assets {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNoteBytes = 4096;

struct CachedFile {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

std::vector<CachedFile> files_below(const fs::path& folder) {
  std::vector<CachedFile> files;
  std::error_code code;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, code), end;
       !code && at != end; at.increment(code)) {
    std::error_code gone;
    if (!at->is_regular_file(gone) || gone) continue;
    CachedFile file{at->path(), at->file_size(gone), at->last_write_time(gone)};
    if (!gone) files.push_back(std::move(file));
  }
  return files;
}

void touch(const fs::path& file) {
  std::error_code ignored;  // on a read-only disk only the order of use is lost
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
}

}  // namespace

bool is_content_hash(const std::string& text) {
  return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

AssetCache::AssetCache(fs::path folder, std::uint64_t limit_bytes)
    : folder_(std::move(folder)), limit_bytes_(limit_bytes) {}

AssetCache::~AssetCache() {
  std::error_code ignored;
  for (const fs::path& aside : asides_)
    fs::remove_all(aside, ignored);
}

fs::path AssetCache::place_of(const std::string& hash, const std::string& extension) const {
  return folder_ / "files" / hash.substr(0, 2) / (hash + extension);
}

fs::path AssetCache::note_of(const std::string& address) const {
  return folder_ / "names" / (content::content_hash(std::as_bytes(std::span(address))) + ".json");
}

std::optional<fs::path> AssetCache::find(const std::string& hash, const std::string& extension) {
  const fs::path file = place_of(hash, extension);
  std::error_code code;
  if (!fs::exists(file, code)) return {};
  const Expected<std::string> have = content::content_hash(file);
  if (have && *have == hash) {
    touch(file);
    in_use_.insert(file);
    return file;
  }
  log::warning(fmt::format("{}: the copy on this disk is damaged; the file is fetched again", file.string()));
  fs::remove(file, code);
  return {};
}

Expected<fs::path> AssetCache::keep(std::span<const std::byte> bytes, const std::string& hash,
                                    const std::string& extension) {
  const fs::path file = place_of(hash, extension);
  const Expected<void> written = write_whole(file, bytes, WholeFile::shared);
  if (written) {
    touch(file);  // sets the time by the clock of find(), which is finer than the file system's
    in_use_.insert(file);
    make_room();
    return file;
  }
  if (!std::exchange(told_no_room_, true)) {
    log::warning(
        fmt::format("{}: {}; until this folder has room and can be written, files are fetched again at each start "
                    "(see --asset-cache)",
                    written.error().where, written.error().what));
  }
  return keep_aside(bytes, hash + extension);
}

/// Puts the file into a temporary folder, or into /dev/shm, which is memory and has room when the disk is full.
Expected<fs::path> AssetCache::keep_aside(std::span<const std::byte> bytes, const std::string& name) {
  std::error_code code;
  for (const fs::path& place : {fs::temp_directory_path(code), fs::path("/dev/shm")}) {
    if (place.empty()) continue;
    const auto old = std::ranges::find(asides_, place, &fs::path::parent_path);
    fs::path aside = old != asides_.end() ? *old : fs::path();
    if (aside.empty()) {
      std::string fresh = (place / "mechane-assets-XXXXXX").string();
      if (mkdtemp(fresh.data()) == nullptr) continue;
      aside = *asides_.insert(fs::path(fresh)).first;
    }
    if (write_whole(aside / name, bytes, WholeFile::shared)) return aside / name;
  }
  return fail(ErrorCode::io_failure, "a fetched file fits neither in this folder nor in a temporary one",
              folder_.string(), "free some disk space, or choose another folder with --asset-cache");
}

void AssetCache::make_room() const {
  std::vector<CachedFile> files = files_below(folder_);
  std::uint64_t sum = 0;
  for (const CachedFile& file : files)
    sum += file.bytes;
  if (sum <= limit_bytes_) return;
  std::ranges::sort(files, {}, &CachedFile::used);
  for (const CachedFile& file : files) {
    if (sum <= limit_bytes_) return;
    std::error_code code;
    if (!in_use_.contains(file.path) && fs::remove(file.path, code)) sum -= file.bytes;
  }
}

std::optional<RememberedFile> AssetCache::recall(const std::string& address) const {
  std::ifstream in(note_of(address), std::ios::binary);
  std::string text(kMostNoteBytes, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  const nlohmann::json note = nlohmann::json::parse(text, nullptr, false);
  if (!note.is_object()) return {};
  const auto field = [&](const char* name) {
    const auto at = note.find(name);
    return at != note.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  RememberedFile file{field("hash"), field("etag"), field("modified")};
  if (field("address") != address || !is_content_hash(file.hash)) return {};
  return file;
}

void AssetCache::remember(const std::string& address, const RememberedFile& file) const {
  const nlohmann::ordered_json note{
      {"address", address}, {"hash", file.hash}, {"etag", file.etag}, {"modified", file.modified}};
  const std::string text = note.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  (void)write_whole(note_of(address), std::as_bytes(std::span(text)), WholeFile::shared);
}

}  // namespace mechane::assets
