#include "client-sdk/gateway/file_store.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "client-sdk/gateway/http/request_path.hpp"
#include "client-sdk/studio/view/shapes_glb.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/mesh_import.hpp"

namespace mechane::gateway {

namespace {

bool needs_glb(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 4> kOthers{".x3d", ".obj", ".stl", ".ply"};
  return std::ranges::find(kOthers, file.extension().string()) != kOthers.end();
}

}  // namespace

Expected<FileStore::Kept> FileStore::read(const std::filesystem::path& file, bool as_glb) {
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(file, error);
  const std::uintmax_t size = error ? 0 : std::filesystem::file_size(file, error);
  const std::pair key(file, as_glb);
  if (const auto known = kept_.find(key); known != kept_.end()) {
    if (!error && known->second.changed == changed && known->second.size == size) {
      known->second.used = ++uses_;
      return known->second;
    }
    kept_bytes_ -= known->second.bytes->size();
    kept_.erase(known);
  }
  const auto bytes = read_whole(file, kMostOfFile);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string given(as_text(*bytes));
  if (as_glb) {
    const auto scene = content::import_mesh(file);
    if (!scene) return tl::unexpected(scene.error());
    given = studio::glb_of(*scene);
  }
  Kept kept{changed, bytes->size(), std::make_shared<const std::string>(std::move(given)),
            content::content_hash(*bytes), ++uses_};
  while (!kept_.empty() && kept_bytes_ + kept.bytes->size() > kMostKept) {
    const auto oldest = std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; });
    kept_bytes_ -= oldest->second.bytes->size();
    kept_.erase(oldest);
  }
  kept_bytes_ += kept.bytes->size();
  kept_[key] = kept;
  return kept;
}

HttpAnswer FileStore::answer(const FileWanted& wanted) {
  const bool as_glb = !wanted.hash.empty() && needs_glb(wanted.path);
  const auto type = as_glb ? std::optional<std::string_view>("model/gltf-binary") : content_type_of(wanted.path);
  if (!type) return refusal(403, "files of this kind are not served", "ask for a model, a sound or an image");
  // A world has named a file with a hash, not a browser: a draft that is tried has a hidden name.
  const auto file = file_within(wanted.folder, wanted.path, !wanted.hash.empty());
  if (!file) return refusal(404, file.error().what, file.error().remedy);
  const auto kept = read(*file, as_glb);
  if (!kept) return refusal(kept.error());
  if (!wanted.hash.empty() && kept->hash != wanted.hash)
    return refusal(404, "the file has changed since the server read it", "restart the server");
  HttpAnswer answer;
  answer.content_type = std::string(*type);
  answer.body = kept->bytes;
  answer.size = kept->bytes->size();
  const std::string tag = "\"" + kept->hash + "\"";
  answer.headers = {{"ETag", tag},
                    {"Accept-Ranges", "bytes"},
                    {"Cache-Control", wanted.immutable ? "private, max-age=31536000, immutable" : "private, no-cache"}};
  if (!wanted.if_none_match.empty() && names_tag(wanted.if_none_match, tag)) {
    answer.status = 304;
    answer.size = 0;
    return answer;
  }
  if (wanted.range.empty() || (!wanted.if_range.empty() && wanted.if_range != tag)) return answer;
  const auto range = parse_range(wanted.range, answer.size);
  if (!range) {
    HttpAnswer refused = refusal(416, range.error().what, range.error().remedy);
    refused.headers = {{"Content-Range", fmt::format("bytes */{}", answer.size)}};
    return refused;
  }
  if (!*range) return answer;
  answer.status = 206;
  answer.headers.emplace_back(
      "Content-Range", fmt::format("bytes {}-{}/{}", (*range)->from, (*range)->from + (*range)->size - 1, answer.size));
  answer.from = (*range)->from;
  answer.size = (*range)->size;
  return answer;
}

}  // namespace mechane::gateway
