// A mesh file with its materials, decoded images and levels of detail, ready to be added to an AssetLibrary.
#pragma once

#include <string>
#include <vector>

#include "client-sdk/picture/scene_assets.hpp"
#include "client-sdk/scene/coarser_mesh.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::scene {

struct PreparedFile {
  content::ImportedScene scene;                  ///< without its textures
  std::vector<picture::MaterialData> materials;  ///< of the scene; their image numbers index `images`
  std::vector<picture::ImageData> images;
  std::vector<CoarserMeshes> coarser;  ///< of each of the scene's meshes
};

/// Slow; any thread. `uri` names the file in messages. An image that cannot be decoded is logged and left out of its
/// materials.
[[nodiscard]] PreparedFile prepare(content::ImportedScene scene, const std::string& uri);

}  // namespace mechane::scene
