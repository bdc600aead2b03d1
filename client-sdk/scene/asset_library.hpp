// The models of a scenario's objects: loads each mesh file once, merges meshes that move together, and provides
// placeholders for missing files. Called from the display's thread only.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "client-sdk/picture/scene_assets.hpp"
#include "client-sdk/scene/prepared_file.hpp"
#include "server/base/error.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::scene {

/// Triangles of one material, in the frame of the object's node.
struct ModelPart {
  std::uint32_t mesh = 0;
  std::uint32_t material = 0;
  bool water = false;  ///< a node named WATER_...: drawn by the water pass, without `material`
};

/// An object's model. B is the object's own frame.
struct ObjectModel {
  std::vector<ModelPart> parts;
  Eigen::AlignedBox3f box_B;
  bool missing = false;  ///< this is a placeholder
};

class AssetLibrary {
 public:
  /// Loads a mesh file by its name relative to the scenario's folder.
  using FileSource = std::function<Expected<PreparedFile>(const std::string& uri)>;
  explicit AssetLibrary(FileSource source);
  /// The same, prepared here.
  using Loader = std::function<Expected<content::ImportedScene>(const std::string& uri)>;
  explicit AssetLibrary(Loader loader);

  /// The model of a node of a file (empty: the whole file), loaded on first use. A failure is logged once, and gives a
  /// box.
  const ObjectModel& model(const std::string& uri, const std::string& node);
  /// Reads a file that was missing again, and replaces the placeholders of its models; references to them stay valid.
  /// True where there were any.
  bool load_again(const std::string& uri);
  /// The file itself, or null when it is missing.
  [[nodiscard]] const content::ImportedScene* file(const std::string& uri);
  /// Adds a mesh, image or material that the display has made itself.
  std::uint32_t add_mesh(picture::MeshData mesh);
  std::uint32_t add_image(picture::ImageData image);
  std::uint32_t add_material(const picture::MaterialData& material);

  [[nodiscard]] const picture::SceneAssets& assets() const { return assets_; }
  /// The amount of content: when it changes, there is something to upload.
  [[nodiscard]] std::size_t size() const {
    return assets_.meshes.size() + assets_.materials.size() + assets_.images.size();
  }
  /// "uri" or "uri#node", in order of name.
  [[nodiscard]] const std::set<std::string>& missing() const { return missing_; }
  /// Counts meshes and images that did not fit on the graphics card (GpuAssets::refused()) as missing too.
  void add_missing(const std::set<std::string>& names) { missing_.insert(names.begin(), names.end()); }

 private:
  struct File {
    std::unique_ptr<content::ImportedScene> scene;  ///< null: missing
    std::vector<CoarserMeshes> coarser;             ///< of its meshes
    std::uint32_t first_material = 0;
  };
  File& load(const std::string& uri);
  ObjectModel build(const std::string& uri, const std::string& node);
  ObjectModel placeholder(const std::string& name, const std::string& why);
  std::uint32_t add_materials(std::vector<picture::MaterialData> materials, std::vector<picture::ImageData> images);

  FileSource source_;
  picture::SceneAssets assets_;
  std::map<std::string, File> files_;
  std::map<std::string, ObjectModel> models_;
  std::set<std::string> missing_;
};

}  // namespace mechane::scene
