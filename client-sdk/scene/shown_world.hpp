// The world that a picture is of, as a client hears of it, live or recorded, with all that is made from it: its mesh files, what they look
// like, the scene. Another world, or another exhibit in it, begins all of that anew.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/assets/asset_store.hpp"
#include "client-sdk/scene/mesh_importer.hpp"
#include "client-sdk/scene/scene_builder.hpp"
#include <mechane/client/client.hpp>

namespace mechane::scene {

/// Where mesh files come from.
struct AssetSource {
  std::string folder;  ///< empty: the scenario's folder, as its server says
  std::shared_ptr<assets::AssetStore>
      store;  ///< in its place; may be null. One for all worlds: who comes back finds all at once
  const content::Catalogue* catalogue =
      nullptr;  ///< may be null; outlives the world and its worker, which alone reads it
  Worker* worker =
      nullptr;  ///< reads files, decodes images and grows trees; outlives the world. Null: hear() does, and waits
};

/// On the display's thread.
class ShownWorld {
 public:
  struct News {
    bool another_world = false;  ///< all that was uploaded is to be forgotten
    bool assets = false;         ///< to be uploaded
    bool whole = false;          ///< all files are here, or were awaited long enough, and are in the scene
  };

  ShownWorld(AssetSource assets, std::string language) : source_(std::move(assets)), language_(std::move(language)) {}
  ShownWorld(const ShownWorld&) = delete;  // the library's loader knows its address
  ShownWorld& operator=(const ShownWorld&) = delete;

  /// Takes what the client knows by now. Without a worker slow where mesh files are to be read. With one, things appear once all files are
  /// there that were wanted by then.
  News hear(const client::Client& client);
  /// Something is to be shown beside a note about the link.
  [[nodiscard]] bool known() const { return builder_ != nullptr; }

  void set_language(const std::string& language);
  void show_forces(bool shown);
  /// `frame` may be null: then things stand where the manifest has them. Before anything is known, and while its files are read, a calm
  /// note.
  [[nodiscard]] picture::RenderScene build(const client::Frame* frame, client::LinkState link) const;

  /// Null before the first has come.
  [[nodiscard]] const client::WorldStatus* status() const { return status_ ? &*status_ : nullptr; }
  [[nodiscard]] const std::shared_ptr<const client::WorldPresentation>& presentation() const { return presentation_; }
  [[nodiscard]] const std::vector<client::SceneObject>& objects() const { return objects_; }
  /// Of the world that is known.
  [[nodiscard]] const picture::SceneAssets& assets() const { return library_->assets(); }
  /// The scenario's folder, or a server's address in its place.
  [[nodiscard]] const std::string& folder() const { return folder_; }
  /// Name of an object that the last scene left out; see SceneBuilder. Empty: none.
  [[nodiscard]] std::string stray() const { return builder_ ? builder_->stray() : std::string(); }
  [[nodiscard]] std::optional<std::uint32_t> unknown() const { return placed() ? builder_->unknown() : std::nullopt; }
  /// Mesh files that are missing, or are not those of the server. Null before anything is known.
  [[nodiscard]] const std::set<std::string>* missing() const { return library_ ? &library_->missing() : nullptr; }
  /// What the graphics card did not take: Renderer::refused(). Nothing before anything is known.
  void add_missing(const std::set<std::string>& names) {
    if (library_) library_->add_missing(names);
  }
  [[nodiscard]] const std::set<std::string>* differing() const { return importer_ ? &importer_->differing() : nullptr; }

 private:
  void begin();
  void take_manifest(std::vector<client::SceneObject> objects);
  void take_arrived();
  void place();
  /// The scene has all objects that the world is known to have.
  [[nodiscard]] bool placed() const { return builder_ != nullptr && !unplaced_; }

  AssetSource source_;
  std::string language_;
  bool forces_shown_ = false;
  std::string key_;
  std::string folder_;
  std::unique_ptr<MeshImporter> importer_;  ///< of the library
  std::unique_ptr<AssetLibrary> library_;
  std::unique_ptr<SceneBuilder> builder_;
  std::optional<client::WorldStatus> status_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  std::vector<client::SceneObject> objects_;
  bool unplaced_ = false;          ///< the builder does not have all of `objects_` yet
  std::set<std::string> arrived_;  ///< files that came from the store, and are not in the library yet
};

}  // namespace mechane::scene
