// The skin of a hand: one smooth closed surface over palm and fingers, made once from rounded shapes, that follows the segments' poses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client-sdk/picture/scene_assets.hpp"
#include "client-sdk/scene/hand_shape.hpp"

namespace mechane::scene {

class HandSkin {
 public:
  /// Some 0.1 s.
  HandSkin();
  /// One for all hands: made at the first use, and never changed.
  [[nodiscard]] static const HandSkin& shared();

  /// The skin for these poses, `scale` times the middle-sized hand, in the frame that the poses are in.
  [[nodiscard]] picture::MeshData follow(const SegmentPoses& X_WS, double scale) const;

  /// At rest: flat, the fingers a little apart, in H.
  [[nodiscard]] const picture::MeshData& rest() const { return rest_; }
  [[nodiscard]] static SegmentPoses rest_poses();

 private:
  static constexpr std::size_t kBones = 3;  ///< that a vertex follows, at most
  struct Hold {
    std::array<std::uint8_t, kBones> segment{};
    std::array<float, kBones> weight{};  ///< sum 1
  };
  picture::MeshData rest_;
  std::vector<Hold> holds_;  ///< by vertex
};

}  // namespace mechane::scene
