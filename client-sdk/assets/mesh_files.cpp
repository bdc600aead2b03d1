#include "client-sdk/assets/mesh_files.hpp"

#include <vector>

#include <fmt/format.h>

#include "server/content/content_hash.hpp"
#include "server/log/log.hpp"

namespace mechane::assets {
namespace {

constexpr std::size_t kHashDigits = 8;  // enough for a person to distinguish two hashes

}  // namespace

Expected<std::filesystem::path> MeshFiles::find(const std::string& uri) {
  const auto said = expected_.find(uri);
  const std::string wanted = said == expected_.end() ? std::string() : said->second;
  std::vector<std::filesystem::path> places;
  if (catalogue_ != nullptr && !wanted.empty()) {
    auto files = catalogue_->files_of(wanted);
    if (!files) return tl::unexpected(files.error());
    places = std::move(*files);
  }
  if (store_ == nullptr) places.push_back(folder_ / uri);
  std::filesystem::path other;
  std::string other_hash;
  for (const std::filesystem::path& place : places) {
    const auto hash = content::content_hash(place);
    if (!hash) continue;
    if (wanted.empty() || *hash == wanted) return place;
    other = place;
    other_hash = *hash;
  }
  if (store_ != nullptr) return from_store(uri, wanted);
  if (other.empty()) {
    const std::string here = folder_.is_relative() ? "start the display in the server's folder, or " : "";
    return fail(
        ErrorCode::not_found, "the file is not here, and a catalogue with its content is not here either",
        (folder_ / uri).string(),
        here +
            "give --assets FOLDER, or --catalogue with the export of 'mechane content export' on the server's machine");
  }
  differing_.insert(uri);
  log::warning(fmt::format(
      "{}: its content is {}, the server's is {}, so visitors may see another shape than they feel; copy the "
      "server's files to this machine (mechane content export)",
      other.string(), other_hash.substr(0, kHashDigits), wanted.substr(0, kHashDigits)));
  return other;
}

Expected<std::filesystem::path> MeshFiles::from_store(const std::string& uri, const std::string& wanted) const {
  AssetFile file = store_->find(uri, wanted);
  if (file.state == AssetState::here) return std::move(file.file);
  if (file.state == AssetState::amiss) return tl::unexpected(std::move(file.error));
  return fail(ErrorCode::busy, "the file is being fetched", uri, "wait: it is shown as soon as it is here");
}

}  // namespace mechane::assets
