// Draws a visitor's hand: one smooth skin in a linen sleeve. A glove's hand is drawn where the server has its segments.
// A one-point device has only a tip: the drawn hand points there with its index finger or, while the device holds
// something, holds it between thumb and index finger.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"
#include "client-sdk/scene/hand_skin.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

/// Of all hands that a display draws. A glove is white cotton, as museums use it.
enum class HandLook : std::uint8_t { light, medium, dark, glove };
/// Their names on the command line, in the order above. The usual one is medium.
[[nodiscard]] const std::vector<std::pair<std::string_view, HandLook>>& hand_look_names();
/// None: there is no such name.
[[nodiscard]] std::optional<HandLook> hand_look_of(std::string_view name);

class HandModel {
 public:
  explicit HandModel(AssetLibrary& library);
  /// From the next hand on.
  void wear(HandLook look) { look_ = look; }
  /// Adds skin, sleeve and occluders of one hand. `camera` gives the direction from which a one-point hand comes.
  void draw(const client::HandPose& hand, const picture::Camera& camera, picture::RenderScene& out) const;

 private:
  std::array<std::uint32_t, 4> materials_{};  ///< by look
  std::uint32_t stale_material_ = 0;
  HandLook look_ = HandLook::medium;
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
