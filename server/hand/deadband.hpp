// Deadband coding for a weak network: a sample or an answer is left out while its receiver has one that differs from it by less than a hand
// can tell, a share of what it feels (Hinterseer et al. 2008).
#pragma once

#include <optional>

#include "server/base/clock.hpp"
#include "server/hand/hand_force.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::hand {

/// The largest share. 0: nothing is left out.
inline constexpr double kMaxDeadband = 0.5;
/// Nothing is left out for longer. When one message is lost, the next one still comes before a force is lowered (kHoldFor).
inline constexpr Duration kKeepAlive = std::chrono::milliseconds(4);
/// No hand feels less, however small the force: two steps of a stylus's encoders, and what they change on the stiffest part of an exhibit
/// (600 N/m).
inline constexpr double kFineWay_m = 1e-4;
inline constexpr double kFineForce_n = 0.06;

/// How far the hand at `p_WH` is from where its force begins, m: from the nearest surface of `answer`, from outside or from inside, as it
/// is known from the answered sample's place, `p_WH0`; where it holds something, how far the grip is stretched. At most 20 mm. A hand
/// that is wrong by a share of this feels a force that is wrong by no more than the same share.
[[nodiscard]] double reach_m(const HapticOutput& answer, const Vec3& p_WH0, const Vec3& p_WH) noexcept;

/// Which samples of a hand a client sends. The server goes on with the last one, so that its answers belong to a place where the hand was.
/// One thread; no allocation.
class InputDeadband {
 public:
  /// `share`: 0 to kMaxDeadband.
  explicit InputDeadband(double share) noexcept;
  [[nodiscard]] bool is_on() const noexcept { return share_ > 0; }

  /// Whether `sample` has to be sent at `now`: its place is farther from the last one's than kFineWay_m and the share of `reach_m`, or its
  /// speed differs by as much as that matters; fingers, buttons or grasp differ at all; a number is not finite; or it is time.
  [[nodiscard]] bool is_due(const HandSample& sample, double reach_m, TimePoint now) const noexcept;
  /// `sample` as it was sent.
  void note_sent(const HandSample& sample, TimePoint now) noexcept;

 private:
  double share_;
  std::optional<HandSample> sent_;
  TimePoint sent_at_;
};

/// Which answers a server sends to one hand. One thread; no allocation.
class OutputDeadband {
 public:
  /// Whether `answer` has to be sent at `now`: force, contacts or the held path differ from what the client makes of the last one by more
  /// than `share` (0 to kMaxDeadband); contacts, reasons, clicks or the grasp are others; a number is not finite; or it answers a newer
  /// sample, and it is time. An answer to the same sample would not keep a force alive at the client. `p_WH`: of the answered sample.
  [[nodiscard]] bool is_due(double share, const HapticOutput& answer, const Vec3& p_WH, TimePoint now) const noexcept;
  void note_sent(const HapticOutput& answer, const Vec3& p_WH, TimePoint now) noexcept;

 private:
  std::optional<HapticOutput> sent_;
  Vec3 p_WH_sent_ = Vec3::Zero();
  TimePoint sent_at_;
};

}  // namespace mechane::hand
