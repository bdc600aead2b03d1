#include "client-sdk/visitor/shown_exhibit.hpp"

#include <utility>

#include "server/content/mesh_import.hpp"

namespace mechane::visitor {
namespace {

/// The mesh file's shapes alone: nobody looks at the images.
Expected<content::ImportedScene> import_shapes(const std::filesystem::path& file) {
  auto scene = content::import_mesh(file);
  if (scene) scene->textures.clear();
  return scene;
}

}  // namespace

ShownExhibit::ShownExhibit(std::filesystem::path folder, std::vector<client::SceneObject> objects,
                           std::shared_ptr<const client::WorldPresentation> presentation)
    : objects_(std::move(objects)),
      presentation_(std::move(presentation)),
      library_([folder = std::move(folder)](const std::string& uri) { return import_shapes(folder / uri); }),
      builder_(library_, "en") {
  builder_.set_manifest(objects_);
  builder_.set_presentation(presentation_);
}

picture::RenderScene ShownExhibit::scene(const client::Frame& frame, const client::WorldStatus* status) {
  return builder_.build(&frame, status, client::LinkState::joined);
}

}  // namespace mechane::visitor
