// The force that a hand feels, as an arrow before it: for who teaches, or tunes a device. Off unless it is asked for.
#pragma once

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

class ForceArrow {
 public:
  static constexpr double kLeast_n = 0.1;  ///< less is not shown
  /// A force has no size of its own in the world: its arrow grows with the distance from which it is seen, and is as large in the picture.
  static constexpr double kLengthPerNewton = 0.03;  ///< of that distance
  static constexpr double kLongest = 0.25;

  explicit ForceArrow(AssetLibrary& library);
  /// From beside the fingertip (a glove: the palm), where the hand does not hide it from the camera, along the force on the hand.
  void draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const;

 private:
  std::uint32_t shaft_ = 0;
  std::uint32_t head_ = 0;
  std::uint32_t material_ = 0;
};

}  // namespace mechane::scene
