// Phase 5 of the tick: from contacts and grasps to what the visitor feels and what the bodies get.
#pragma once

#include "server/hand/governor.hpp"
#include "server/haptics/hand_model.hpp"
#include "server/haptics/wall_sides.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// How penetration depths become a force.
enum class ForceMode {
  /// Per segment and body, F = k sum S_i^2 n_i / sum S_i: continuous when points enter and leave, and a pinch does not cancel.
  continuous,
  /// Equation 18 as published, F = (k/N) sum S_i n_i over the whole hand, kept for comparison. No damping, no friction.
  paper,
};

/// What friction does below the speed at which it slides. `damps` is that of journals before StateVersion::with_anchors: it never holds.
enum class FrictionKind { sticks, damps };

/// The normal of a touch: that of smooth_surface(), or the mean of its contacts, as in journals before StateVersion::with_anchors.
enum class NormalKind { smooth, of_contacts };

struct ForceConfig {
  ForceMode mode = ForceMode::continuous;
  FrictionKind friction = FrictionKind::sticks;
  NormalKind normals = NormalKind::smooth;
  ThinWalls thin_walls = ThinWalls::hold_hands;
  bool weights = true;  ///< known as such to the governor; false: as in journals before StateVersion::with_corners
  double damping_depth_m = 0.001;  ///< damping comes in over this depth, so that a first touch is not a step
  hand::GovernorConfig
      governor;  ///< the server's own limits; the client's governor comes after it and has the last word
};

/// Renders the forces of a world's users. Remembers nothing itself: what changes lies in the WorldState. Any thread.
class ForceRenderer {
 public:
  /// Errors: a setting of the governor that is out of range.
  [[nodiscard]] static Expected<ForceRenderer> create(const ForceConfig& config);

  /// Puts the governors into the state that they have before anybody comes.
  void start(state::WorldState& state) const noexcept;
  /// Writes every user's HapticOutput and adds the opposite forces to the bodies' loads. Allocates nothing.
  void run(const state::WorldDescription& description, const HandModel& hand, state::WorldState& state) const noexcept;

 private:
  ForceRenderer(const ForceConfig& config, const hand::ForceGovernor& governor)
      : config_(config), governor_(governor) {}
  void render_user(const state::WorldDescription& description, const HandModel& hand, state::WorldState& state,
                   std::size_t index) const noexcept;

  ForceConfig config_;
  hand::ForceGovernor governor_;
};

}  // namespace mechane::haptics
