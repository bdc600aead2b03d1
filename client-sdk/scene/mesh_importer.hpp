// Imports the mesh files of a world: finds them, reads them in a child process, decodes their images; with a worker, in
// the background.
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

/// The importer of one world. On the display's thread. Jobs own what they need, and return results by value: no mutable
/// state is shared.
class MeshImporter {
 public:
  /// `worker` may be null: then take() imports. It must outlive this, and the catalogue of `files`, if any, must
  /// outlive the worker.
  MeshImporter(assets::MeshFiles files, Worker* worker);
  MeshImporter(const MeshImporter&) = delete;
  MeshImporter& operator=(const MeshImporter&) = delete;
  /// Stops imports that are under way, without waiting for them.
  ~MeshImporter();

  /// Begins to import a file, once. `hash` is that of the manifest; empty: none.
  void want(const std::string& uri, const std::string& hash);
  /// Begins to import a wanted file again that was missing before.
  void want_again(const std::string& uri);
  /// Whether imports are under way; then take() must not be called.
  [[nodiscard]] bool busy() const;
  /// Gives away the last import of a wanted file. Errors: those of MeshFiles and of the import.
  [[nodiscard]] Expected<PreparedFile> take(const std::string& uri);
  /// The taken files whose content here differs from the server's.
  [[nodiscard]] const std::set<std::string>& differing() const { return differing_; }

 private:
  struct Import {
    Expected<PreparedFile> file;
    std::set<std::string> differing;
  };
  struct Wanted {
    std::string hash;
    std::future<Import> coming;  ///< not valid without a worker, and after it was taken
  };
  void begin(const std::string& uri, Wanted& wanted);
  [[nodiscard]] static Import import(assets::MeshFiles& files, const std::string& uri, const std::string& hash,
                                     const std::stop_token& stop);

  std::shared_ptr<assets::MeshFiles> files_;  ///< with a worker, used by the worker only
  Worker* worker_;
  std::stop_source stop_;
  std::map<std::string, Wanted> wanted_;
  std::set<std::string> differing_;
};

}  // namespace mechane::scene
