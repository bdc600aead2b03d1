#include "client-sdk/scene/mesh_importer.hpp"

#include <algorithm>
#include <utility>

#include "server/base/assert.hpp"
#include "server/content/mesh_import.hpp"

namespace mechane::scene {

MeshImporter::MeshImporter(assets::MeshFiles files, Worker* worker)
    : files_(std::make_shared<assets::MeshFiles>(std::move(files))), worker_(worker) {}

MeshImporter::~MeshImporter() {
  stop_.request_stop();
}

MeshImporter::Import MeshImporter::import(assets::MeshFiles& files, const std::string& uri, const std::string& hash,
                                          const std::stop_token& stop) {
  if (stop.stop_requested())
    return {fail(ErrorCode::cancelled, "the import was stopped", uri, "open the exhibit again"), {}};
  files.expect(uri, hash);
  const auto path = files.find(uri);
  if (!path) return {tl::unexpected(path.error()), files.differing()};
  auto scene = content::import_mesh(*path, {}, stop);
  if (!scene) return {tl::unexpected(scene.error()), files.differing()};
  return {prepare(std::move(*scene), uri), files.differing()};
}

void MeshImporter::want(const std::string& uri, const std::string& hash) {
  if (uri.empty()) return;
  const auto [wanted, is_new] = wanted_.try_emplace(uri);
  wanted->second.hash = hash;
  if (is_new) begin(uri, wanted->second);
}

void MeshImporter::want_again(const std::string& uri) {
  const auto wanted = wanted_.find(uri);
  if (wanted != wanted_.end()) begin(uri, wanted->second);
}

void MeshImporter::begin(const std::string& uri, Wanted& wanted) {
  if (worker_ == nullptr) return;
  wanted.coming = worker_->ask(
      [files = files_, uri, hash = wanted.hash, stop = stop_.get_token()] { return import(*files, uri, hash, stop); });
}

bool MeshImporter::busy() const {
  return std::ranges::any_of(wanted_, [](const auto& named) {
    const auto& coming = named.second.coming;
    return coming.valid() && !is_ready(coming);
  });
}

Expected<PreparedFile> MeshImporter::take(const std::string& uri) {
  const auto wanted = wanted_.find(uri);
  MECHANE_ASSERT(wanted != wanted_.end());
  if (worker_ != nullptr) MECHANE_ASSERT(is_ready(wanted->second.coming));
  Import imported = worker_ != nullptr ? wanted->second.coming.get() : import(*files_, uri, wanted->second.hash, {});
  differing_ = std::move(imported.differing);
  return std::move(imported.file);
}

}  // namespace mechane::scene
