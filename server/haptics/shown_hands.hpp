// Where displays show hands: a hand that is pressed into something is seen on its surface, as far as walls hold it.
#pragma once

#include <array>
#include <cstdint>

#include "server/haptics/hand_model.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// By how far each hand of a world is shown beside where it is. People who see their hand stay on a surface feel that surface as stiffer,
/// and do not press deeper. The hand is moved as a whole, out of all walls that hold its segments, as nearly as it can. One that holds
/// something is shown where it is. Nothing that is felt depends on this. For the thread that steps the world; allocates nothing.
class ShownHands {
 public:
  /// How fast the way between a hand and its picture may change, beyond what the hand itself moves.
  static constexpr double kCatchesUp_m_per_s = 0.5;

  ShownHands() noexcept { out_W_.fill(Vec3::Zero()); }

  /// To be called whenever a picture is made. A hand that has come since the last one is shown where it is.
  void follow(const HandModel& hand, const state::WorldState& state) noexcept;
  /// In W, by user: to be added to X_WS.
  [[nodiscard]] const std::array<Vec3, hand::kMaxUsers>& out_W() const { return out_W_; }

 private:
  std::array<Vec3, hand::kMaxUsers> out_W_;
  std::array<Vec3, hand::kMaxUsers> p_WH_;  // where the hands of these sessions were in the last picture
  std::array<std::uint64_t, hand::kMaxUsers> session_{};
  std::uint64_t tick_ = 0;
};

}  // namespace mechane::haptics
