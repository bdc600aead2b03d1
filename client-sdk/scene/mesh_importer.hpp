// Brings the mesh files of a world: finds them, reads them in a child process, decodes their images. With a worker that happens beside the
// drawing.
#pragma once

#include <future>
#include <map>
#include <memory>
#include <set>
#include <stop_token>
#include <string>

#include "client-sdk/assets/mesh_files.hpp"
#include "client-sdk/scene/prepared_file.hpp"
#include "server/base/error.hpp"
#include "server/base/worker.hpp"

namespace mechane::scene {

/// One world's. On the display's thread. Jobs own what they read with, and their results come by value: nothing is shared that changes.
class MeshImporter {
 public:
  /// `worker` may be null: then take() imports. It outlives this, and the catalogue of `files`, if there is one, outlives the worker.
  MeshImporter(assets::MeshFiles files, Worker* worker);
  MeshImporter(const MeshImporter&) = delete;
  MeshImporter& operator=(const MeshImporter&) = delete;
  /// Stops imports that are under way, and waits for none.
  ~MeshImporter();

  /// Begins to import a file, once. `hash`: what the manifest says of its content; empty: nothing.
  void want(const std::string& uri, const std::string& hash);
  /// Begins to import a wanted file again, which was missing before.
  void want_again(const std::string& uri);
  /// Imports are under way, and take() may not be called.
  [[nodiscard]] bool busy() const;
  /// A wanted file as it was imported last; it is given away. Errors: MeshFiles's, the import's.
  [[nodiscard]] Expected<PreparedFile> take(const std::string& uri);
  /// Files whose content here is not the server's, of those that were taken.
  [[nodiscard]] const std::set<std::string>& differing() const { return differing_; }

 private:
  struct Import {
    Expected<PreparedFile> file;
    std::set<std::string> differing;
  };
  struct Wanted {
    std::string hash;
    std::future<Import> coming;  ///< without a worker, and once it was taken: not valid
  };
  void begin(const std::string& uri, Wanted& wanted);
  [[nodiscard]] static Import import(assets::MeshFiles& files, const std::string& uri, const std::string& hash,
                                     const std::stop_token& stop);

  std::shared_ptr<assets::MeshFiles> files_;  ///< where there is a worker, its alone
  Worker* worker_;
  std::stop_source stop_;
  std::map<std::string, Wanted> wanted_;
  std::set<std::string> differing_;
};

}  // namespace mechane::scene
