// An exhibit's picture as a display makes it, without images: for a simulated person who looks where things are.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "client-sdk/scene/scene_builder.hpp"

namespace mechane::visitor {

/// Made once for all visits of an exhibit. One thread.
class ShownExhibit {
 public:
  /// Reads the mesh files, which takes seconds. `folder`: the scenario's; `objects`: the whole manifest, in its order.
  ShownExhibit(std::filesystem::path folder, std::vector<client::SceneObject> objects,
               std::shared_ptr<const client::WorldPresentation> presentation);
  ShownExhibit(const ShownExhibit&) = delete;
  ShownExhibit& operator=(const ShownExhibit&) = delete;

  /// `status` may be null: then there are no words, and no place of work.
  [[nodiscard]] picture::RenderScene scene(const client::Frame& frame, const client::WorldStatus* status = nullptr);
  [[nodiscard]] const picture::SceneAssets& assets() const { return library_.assets(); }
  [[nodiscard]] const std::vector<client::SceneObject>& objects() const { return objects_; }
  [[nodiscard]] const client::WorldPresentation& presentation() const { return *presentation_; }

 private:
  std::vector<client::SceneObject> objects_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  scene::AssetLibrary library_;
  scene::SceneBuilder builder_;
};

}  // namespace mechane::visitor
