// The force on a hand as an arrow, for teaching or for tuning a device. Off by default.
#pragma once

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

class ForceArrow {
 public:
  static constexpr double kLeast_n = 0.1;  ///< smaller forces are not shown
  /// The arrow's length per newton, as a share of the viewing distance, so that it has the same size in the picture
  /// from any distance.
  static constexpr double kLengthPerNewton = 0.03;
  static constexpr double kLongest = 0.25;

  explicit ForceArrow(AssetLibrary& library);
  /// Draws it along the force, starting beside the fingertip (of a glove: the palm), where the hand does not hide it
  /// from the camera.
  void draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const;

 private:
  std::uint32_t shaft_ = 0;
  std::uint32_t head_ = 0;
  std::uint32_t material_ = 0;
};

}  // namespace mechane::scene
