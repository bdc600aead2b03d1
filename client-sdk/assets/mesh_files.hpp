// Finds the mesh files of a scenario on this machine: in a catalogue by content, in a folder by name, or in the cache
// of files fetched from a web server.
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

/// The files of one scenario. One thread at a time; slow, as it reads whole files.
class MeshFiles {
 public:
  /// A relative `folder` starts from this program's working folder. `catalogue` may be null, and must outlive this.
  MeshFiles(std::filesystem::path folder, const content::Catalogue* catalogue)
      : folder_(std::move(folder)), catalogue_(catalogue) {}
  /// With a web server in place of a folder. `catalogue` may be null, and must outlive this.
  MeshFiles(std::shared_ptr<AssetStore> store, const content::Catalogue* catalogue)
      : store_(std::move(store)), catalogue_(catalogue) {}

  /// Sets the hash of the server's file, from the manifest: content::content_hash(). Empty: unknown.
  void expect(const std::string& uri, const std::string& hash) { expected_[uri] = hash; }

  /// The file with the server's content, from the catalogue or else from the folder. Where neither has it, a file of the
  /// same name but other content is used, with a warning: visitors may then see another shape than they feel. Files from
  /// a web server are used only with the server's content. Errors: not_found; busy, while the file is being fetched
  /// (AssetStore::take_arrived() returns it when it has arrived).
  [[nodiscard]] Expected<std::filesystem::path> find(const std::string& uri);

  /// uris whose file here differs from the server's.
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
