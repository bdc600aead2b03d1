// Gears, ratchets, ropes and ties as rows of a Mechanism.
#pragma once

#include <vector>

#include "server/base/error.hpp"
#include "server/dynamics/joint_rows.hpp"
#include "server/dynamics/mechanism.hpp"

namespace mechane::dynamics {

/// A joint in one step, for the couplings: its one direction of motion.
struct JointAxis {
  bool on = false;
  std::size_t body1 = kGround;
  std::size_t body2 = kGround;
  Row row;  ///< the joint's rate
  JointMeasure now;
  Vec3 arm2_W = Vec3::Zero();  ///< from body2's centre of mass to the joint
};

/// The couplings of one world. Joints that are off, and balls, couple nothing.
class CouplingRows {
 public:
  /// Errors name the coupling by index: a body or joint that does not exist, a number out of range. Allocates for all later steps.
  [[nodiscard]] static Expected<CouplingRows> create(const state::WorldState& state);

  /// As many as gather() can add.
  [[nodiscard]] std::size_t most_rows() const noexcept { return most_rows_; }

  /// Adds to the mechanism what the couplings ask for in a step of dt_s. Position errors are taken back as joints do. A rope and
  /// a stop let their ends move in this step up to their limit, and no further. `frames` are the bodies at the start of the step.
  void gather(const state::WorldState& state, std::span<const Frame> frames, std::span<const JointAxis> axes,
              double dt_s, Mechanism& mechanism) noexcept;
  /// Writes what the couplings bore, after the mechanism was solved.
  void store(state::WorldState& state, std::span<const JointAxis> axes, const Mechanism& mechanism,
             double dt_s) const noexcept;

 private:
  void add_axis(std::size_t joint, double factor) noexcept;
  void add_fixed(const state::Coupling& tie) noexcept;
  void add_gear(const state::Coupling& gear) noexcept;
  void add_intermittent(const state::Coupling& gear) noexcept;
  void add_stop(const state::Coupling& stop) noexcept;
  void add_rope(const state::WorldState& state, const state::Coupling& rope) noexcept;
  void add_rope_part(const state::Coupling& rope, const state::RopePath& path, std::size_t part) noexcept;
  [[nodiscard]] bool axis_on(JointId joint) const noexcept { return joint && axes_[joint.index()].on; }

  std::vector<std::size_t> first_;  // row of each coupling
  std::vector<std::size_t> rows_;   // how many
  std::size_t most_rows_ = 0;
  // Of the step that is being gathered.
  Mechanism* mechanism_ = nullptr;
  std::span<const Frame> frames_;
  std::span<const JointAxis> axes_;
  double dt_s_ = 0;
};

/// The poses of a rope's bodies, and of what bears its drum, as measure_rope() wants them.
[[nodiscard]] state::RopePath rope_path(const state::Coupling& rope, const state::WorldState& state) noexcept;

}  // namespace mechane::dynamics
