#include "client-sdk/gateway/file_store.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "client-sdk/gateway/request_path.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"

namespace mechane::gateway {

Expected<FileStore::Kept> FileStore::read(const std::filesystem::path& file) {
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(file, error);
  const std::uintmax_t size = error ? 0 : std::filesystem::file_size(file, error);
  if (const auto known = kept_.find(file); known != kept_.end()) {
    if (!error && known->second.changed == changed && known->second.size == size) {
      known->second.used = ++uses_;
      return known->second;
    }
    kept_bytes_ -= known->second.bytes->size();
    kept_.erase(known);
  }
  const auto bytes = read_whole(file, kMostOfFile);
  if (!bytes) return tl::unexpected(bytes.error());
  Kept kept{changed, bytes->size(),
            std::make_shared<const std::string>(reinterpret_cast<const char*>(bytes->data()), bytes->size()),
            content::content_hash(*bytes), ++uses_};
  while (!kept_.empty() && kept_bytes_ + kept.size > kMostKept) {
    const auto oldest = std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.used; });
    kept_bytes_ -= oldest->second.bytes->size();
    kept_.erase(oldest);
  }
  kept_bytes_ += kept.size;
  kept_[file] = kept;
  return kept;
}

HttpAnswer FileStore::answer(const FileWanted& wanted) {
  const auto type = content_type_of(wanted.path);
  if (!type) return refusal(403, "files of this kind are not served", "ask for a model, a sound or an image");
  const auto file = file_within(wanted.folder, wanted.path);
  if (!file) return refusal(404, file.error().what, file.error().remedy);
  const auto kept = read(*file);
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
