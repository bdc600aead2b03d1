// The skin of a hand: one smooth closed surface over palm and fingers, made once from rounded shapes. It follows the
// segments' poses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client-sdk/picture/scene_assets.hpp"
#include "client-sdk/scene/hand_shape.hpp"

namespace mechane::scene {

class HandSkin {
 public:
  /// Takes about 0.1 s.
  HandSkin();
  /// Shared by all hands; made at the first use.
  [[nodiscard]] static const HandSkin& shared();

  /// The skin for these poses of such a hand, in the frame of the poses.
  [[nodiscard]] picture::MeshData follow(const SegmentPoses& X_WS, const hand::HandBuild& build) const;

  /// The skin of a right hand at rest, in H: flat, the fingers a little apart.
  [[nodiscard]] const picture::MeshData& rest() const { return rest_; }
  [[nodiscard]] static SegmentPoses rest_poses();

 private:
  static constexpr std::size_t kBones = 3;  ///< that a vertex follows at most
  struct Hold {
    std::array<std::uint8_t, kBones> segment{};
    std::array<float, kBones> weight{};  ///< sum 1
  };
  picture::MeshData rest_;
  std::vector<Hold> holds_;  ///< by vertex
};

}  // namespace mechane::scene
