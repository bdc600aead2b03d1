// How a visitor's hand looks: 16 superquadrics of a middle-sized hand, as the server touches with, or a small sphere for a one-point
// device. Segment frames as on the wire: x along the bone, the frame in the segment's middle.
#pragma once

#include <array>

#include "client-sdk/display/asset_library.hpp"
#include <mechane/client/types.hpp>

namespace mechane::display {

class HandModel {
 public:
  explicit HandModel(AssetLibrary& library);
  /// Adds instances and occluders of one hand.
  void draw(const client::HandPose& hand, RenderScene& out) const;

 private:
  std::array<std::uint32_t, client::kHandSegments> segments_{};
  std::uint32_t tip_ = 0;
  std::uint32_t skin_ = 0;
  std::uint32_t stale_ = 0;
  std::uint32_t tip_material_ = 0;
};

/// The hand's scale against the middle-sized one, from the poses of palm and index finger.
[[nodiscard]] double hand_scale(const client::HandPose& hand);

}  // namespace mechane::display
