// Where the mesh files of a scenario lie on this machine: in a catalogue, by content, or in a folder, by name, or in the cache of what is
// fetched from a server of assets.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "client-sdk/assets/asset_store.hpp"
#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::assets {

/// One scenario's. From one thread at a time: it reads files whole.
class MeshFiles {
 public:
  /// A relative `folder` is in this program's own. `catalogue` may be null, and must outlive this.
  MeshFiles(std::filesystem::path folder, const content::Catalogue* catalogue)
      : folder_(std::move(folder)), catalogue_(catalogue) {}
  /// In place of a folder, a server. `catalogue` may be null, and must outlive this.
  MeshFiles(std::shared_ptr<AssetStore> store, const content::Catalogue* catalogue)
      : store_(std::move(store)), catalogue_(catalogue) {}

  /// What the manifest says that the server's file is: content::content_hash(). Empty: it does not say.
  void expect(const std::string& uri, const std::string& hash) { expected_[uri] = hash; }

  /// The file whose content the server has, from the catalogue or else from the folder. Where no file's is that, the folder's file, or the
  /// catalogue's that should be: a warning says that what is seen may not be what is felt. From a server comes that content or none. Errors:
  /// there is no file at all, or it is still being fetched (AssetStore::take_arrived() says when it is here).
  [[nodiscard]] Expected<std::filesystem::path> find(const std::string& uri);

  /// uris whose file here is not the server's.
  [[nodiscard]] const std::set<std::string>& differing() const { return differing_; }

 private:
  [[nodiscard]] Expected<std::filesystem::path> from_store(const std::string& uri, const std::string& wanted) const;

  std::filesystem::path folder_;
  std::shared_ptr<AssetStore> store_;
  const content::Catalogue* catalogue_;
  std::map<std::string, std::string> expected_;
  std::set<std::string> differing_;
};

}  // namespace mechane::assets
