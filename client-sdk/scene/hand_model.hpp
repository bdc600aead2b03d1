// Draws a visitor's hand: one smooth skin in a linen sleeve. A glove's hand is drawn where the server has its segments.
// A one-point device has only a tip: the drawn hand points there with its index finger or, while the device holds
// something, holds it between thumb and index finger.
#pragma once

#include <array>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include "client-sdk/scene/hand_skin.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

class HandModel {
 public:
  explicit HandModel(AssetLibrary& library);
  /// Adds skin, sleeve and occluders of one hand. `camera` gives the direction from which a one-point hand comes.
  void draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const;

 private:
  std::uint32_t skin_material_ = 0;
  std::uint32_t stale_material_ = 0;
  struct Sleeve {
    std::uint32_t mesh = 0;
    std::uint32_t fresh = 0;  ///< material
    std::uint32_t stale = 0;  ///< of a hand whose device is silent
  };
  Sleeve sleeve_;
  Sleeve fading_sleeve_;
};

/// The segments of a one-point device's hand, in W: the index finger ends at `p_WT`, or index finger and thumb meet
/// there.
[[nodiscard]] SegmentPoses hand_at_tip(const Vec3& p_WT, bool holding, const picture::Camera& camera);

}  // namespace mechane::scene
