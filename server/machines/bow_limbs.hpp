// Where a bow's limbs and its string are while the string is drawn. Inside this room only.
#pragma once

#include <array>

#include "server/machines/machine.hpp"

namespace mechane::machines {

/// Two stiff limbs that turn about their roots at the bow's middle, and two halves of a string that does not stretch. The draw alone
/// determines where they are: a limb's tip lies where a circle about its root meets one about the claw. Their mass is left out.
/// Immutable.
class BowLimbs {
 public:
  /// From the parameters `limbs` and `strings`, two bodies each, as they lie at the start with the string at rest: a limb's origin is
  /// its root, that of half a string is the limb's tip. `slider` draws along its axis times `direction`. Without the parameters there is
  /// nothing to move. Errors: other counts, fixed bodies, places from which no bow can be made.
  [[nodiscard]] static Expected<BowLimbs> make(const Build& build, JointId slider, double direction);

  /// Puts limbs and string where they are while the string is drawn by draw_m.
  void follow(state::WorldState& state, double draw_m) const noexcept;
  /// Hides the string: it is cut.
  void lose_string(state::WorldState& state) const noexcept;

 private:
  using Vec2 = Eigen::Vector2d;

  struct Side {
    BodyId limb;
    BodyId string;
    Pose X_SL;  // at rest, in the frame of the stock
    Pose X_ST;
    Vec3 across_S = Vec3::UnitX();  // from the string's middle to the limb's tip
    Vec2 root = Vec2::Zero();       // from the string's middle: across, and along the draw
    double arm_m = 0;               // from the root to the tip
    double half_m = 0;              // of the string
    double sign = 1;                // chooses the tip from the two points where the circles meet
  };

  [[nodiscard]] static Vec2 tip(const Side& side, double draw_m) noexcept;

  bool given_ = false;
  BodyId stock_;
  Vec3 draw_S_ = Vec3::UnitX();
  Vec3 p_SN_ = Vec3::Zero();  // the middle of the string at rest
  std::array<Side, 2> sides_;
};

}  // namespace mechane::machines
