// A person with a mouse before a display's picture, for PlayOptions::make_person: presses on what a visit reaches for, drags it, rolls the
// wheel, goes round what turns. What is under a pixel, what can be taken and how the hand then moves are the display's own code; only the
// network, the window and the drawing are missing.
#pragma once

#include <memory>
#include <vector>

#include "client-sdk/scene/scene_builder.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane::test {

/// An exhibit's picture as a display makes it, without images: read once for all visits.
class ShownExhibit {
 public:
  explicit ShownExhibit(const state::WorldDescription& description);
  ShownExhibit(const ShownExhibit&) = delete;
  ShownExhibit& operator=(const ShownExhibit&) = delete;

  [[nodiscard]] picture::RenderScene scene(const client::Frame& frame);
  [[nodiscard]] const picture::SceneAssets& assets() const { return library_.assets(); }
  [[nodiscard]] const std::vector<client::SceneObject>& objects() const { return objects_; }
  [[nodiscard]] const client::WorldPresentation& presentation() const { return *presentation_; }

 private:
  std::vector<client::SceneObject> objects_;
  std::shared_ptr<const client::WorldPresentation> presentation_;
  scene::AssetLibrary library_;
  scene::SceneBuilder builder_;
};

/// Both outlive the person.
[[nodiscard]] std::unique_ptr<Person> make_pointer_person(ShownExhibit& shown,
                                                          const state::WorldDescription& description,
                                                          const state::VisitDescription& visit);

}  // namespace mechane::test
