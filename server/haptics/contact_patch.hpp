// The contacts of one hand segment with one body, put together: what acts as one touch.
#pragma once

#include <cstdint>
#include <span>

#include <boost/container/static_vector.hpp>

#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// One touch. Vectors in W.
struct ContactPatch {
  BodyId body;
  std::uint8_t segment = 0;
  std::uint32_t points = 0;
  Vec3 p_WC = Vec3::Zero();    ///< depth-weighted middle of the points
  Vec3 push_m = Vec3::Zero();  ///< sum S_i^2 n_i / sum S_i: the way out; times stiffness it is the force on the hand
  Vec3 n_BH_W = Vec3::Zero();  ///< unit, along push_m
  double depth_m = 0;          ///< |push_m|
  double deepest_m = 0;        ///< of the points
  Vec3 out_W = Vec3::Zero();   ///< by what the segment was moved to find this touch; see hold_walls()
  double found_depth_m = 0;    ///< the depth there
  bool in_corner = false;      ///< of two walls that hold: the normal lies between theirs
};

/// The points of a ball's cap are spread evenly over its depth, so that a patch is two thirds as deep as the ball.
inline constexpr double kPatchShare = 2.0 / 3.0;

using state::kMaxPatches;
/// Sets up only the patches that are there: all of them would take longer than to fill those of a hand.
using ContactPatches = boost::container::static_vector<ContactPatch, kMaxPatches>;

/// Groups contacts by segment and body, in the order of the contacts, into an empty list. Those of touches that find no room are left out.
void gather_patches(std::span<const state::Contact> contacts, ContactPatches& patches) noexcept;
/// The one patch of contacts of one segment with one body; of no contact: one without depth.
[[nodiscard]] ContactPatch patch_of(std::span<const state::Contact> contacts) noexcept;

}  // namespace mechane::haptics
