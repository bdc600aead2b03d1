// The world that is shown, live or recorded, with all that is made from it: its mesh files, their models, the scene.
// For another world, or another exhibit in it, all of that is made again.
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
  std::string folder;  ///< empty: the scenario's folder on the server's machine
  /// Used in place of the folder; may be null. One store for all worlds, so that a known world is complete at once.
  std::shared_ptr<assets::AssetStore> store;
  /// May be null; must outlive the world and its worker; read by the worker only.
  const content::Catalogue* catalogue = nullptr;
  /// Reads files, decodes images and makes trees; must outlive the world. Null: hear() does this, and waits.
  Worker* worker = nullptr;
};

/// On the display's thread.
class ShownWorld {
 public:
  struct News {
    bool another_world = false;  ///< forget everything that was uploaded
    bool assets = false;         ///< there are new assets to upload
    bool whole = false;          ///< all files are in the scene, except those that were awaited long enough
  };

  ShownWorld(AssetSource assets, std::string language) : source_(std::move(assets)), language_(std::move(language)) {}
  ShownWorld(const ShownWorld&) = delete;  // the library's loader keeps its address
  ShownWorld& operator=(const ShownWorld&) = delete;

  /// Takes what the client knows by now. Without a worker, this reads mesh files and is slow. With one, things appear
  /// once all files requested so far are there.
  News hear(const client::Client& client);
  /// Whether there is more to show than a note about the link.
  [[nodiscard]] bool known() const { return builder_ != nullptr; }

  void set_language(const std::string& language);
  void show_forces(bool shown);
  void show_hands(HandLook look);
  /// `frame` may be null: then things stand where the manifest has them. Before anything is known, and while files are
  /// read, shows a calm note.
  [[nodiscard]] picture::RenderScene build(const client::Frame* frame, client::LinkState link) const;

  /// Null before the first status.
  [[nodiscard]] const client::WorldStatus* status() const { return status_ ? &*status_ : nullptr; }
  [[nodiscard]] const std::shared_ptr<const client::WorldPresentation>& presentation() const { return presentation_; }
  [[nodiscard]] const std::vector<client::SceneObject>& objects() const { return objects_; }
  /// Of the known world.
  [[nodiscard]] const picture::SceneAssets& assets() const { return library_->assets(); }
  /// The scenario's folder, or a server's address in its place.
  [[nodiscard]] const std::string& folder() const { return folder_; }
  /// See SceneBuilder::stray().
  [[nodiscard]] std::string stray() const { return builder_ ? builder_->stray() : std::string(); }
  [[nodiscard]] std::optional<std::uint32_t> unknown() const { return placed() ? builder_->unknown() : std::nullopt; }
  /// Mesh files that are missing, or differ from the server's. Null before anything is known.
  [[nodiscard]] const std::set<std::string>* missing() const { return library_ ? &library_->missing() : nullptr; }
  /// Takes note of what did not fit on the graphics card (Renderer::refused()). No effect before anything is known.
  void add_missing(const std::set<std::string>& names) {
    if (library_) library_->add_missing(names);
  }
  [[nodiscard]] const std::set<std::string>* differing() const { return importer_ ? &importer_->differing() : nullptr; }

 private:
  void begin();
  void take_manifest(std::vector<client::SceneObject> objects);
  void take_arrived();
  void place();
  /// Whether the scene has all known objects of the world.
  [[nodiscard]] bool placed() const { return builder_ != nullptr && !unplaced_; }

  AssetSource source_;
  std::string language_;
  bool forces_shown_ = false;
  HandLook hand_look_ = HandLook::medium;
  std::string key_;
  std::string folder_;
  std::unique_ptr<MeshImporter> importer_;  ///< of the library
  std::unique_ptr<AssetLibrary> library_;
  std::unique_ptr<SceneBuilder> builder_;
  std::optional<client::WorldStatus> status_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  std::vector<client::SceneObject> objects_;
  bool unplaced_ = false;          ///< the builder does not have all of `objects_` yet
  std::set<std::string> arrived_;  ///< files from the store that are not in the library yet
};

}  // namespace mechane::scene
