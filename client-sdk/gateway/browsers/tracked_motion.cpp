#include "client-sdk/gateway/browsers/tracked_motion.hpp"

#include <algorithm>
#include <iterator>

#include "client-sdk/drivers/joints/hand_geometry.hpp"
#include "client-sdk/haptic/driver_link.hpp"

namespace mechane::gateway {
namespace {

// Pictures of 90 to 20 a second. A later one finds the hand waiting.
constexpr Duration kShortestStep = std::chrono::milliseconds(8);
constexpr Duration kLongestStep = std::chrono::milliseconds(50);
// No hand moves so far between two pictures: the server must see the jump, and let go.
constexpr double kJump_m = 0.3;

}  // namespace

std::optional<client::HandSample> TrackedMotion::sample_of(const TrackedHand& seen) noexcept {
  client::HandSample sample;
  sample.kind = seen.kind;
  sample.side = seen.side;
  if (seen.kind == hand::HandKind::one_point) {
    sample.X_WH = seen.X_WH;
    sample.grasp_intent = seen.closed.value_or(0);
    return sample;
  }
  drivers::HandDatagram datagram;
  datagram.left = seen.side == hand::HandSide::left;
  datagram.tracked = true;
  datagram.pinch = seen.closed;
  datagram.points = seen.points;
  mechane_device_state state{};
  if (*drivers::place_tracked_hand(datagram, state) != 0) return std::nullopt;
  measure_.add(seen.points);
  measure_.tell(state);
  static_cast<hand::HandBuild&>(sample) = haptic::build_of(seen.side, state, 1);
  const auto& q = state.orientation_wxyz;
  sample.X_WH = {Vec3(state.position_m[0], state.position_m[1], state.position_m[2]), Quat(q[0], q[1], q[2], q[3])};
  std::copy(std::begin(state.joints_rad), std::end(state.joints_rad), sample.joints.begin());
  sample.grasp_intent = state.grasp;
  return sample;
}

void TrackedMotion::take(const TrackedHand& seen, TimePoint now) noexcept {
  if (!seen.tracked) return;
  if (!is_seen(now) || newest_->kind != seen.kind) forget();
  const auto sample = sample_of(seen);
  if (!sample) return;
  from_ = newest_ ? at(now) : sample;
  step_ = newest_ ? std::clamp(now - seen_at_, kShortestStep, kLongestStep) : kShortestStep;
  if ((from_->X_WH.p - sample->X_WH.p).norm() > kJump_m) from_ = sample;
  newest_ = sample;
  seen_at_ = now;
}

client::HandSample TrackedMotion::between(double share) const noexcept {
  client::HandSample out = *newest_;
  out.X_WH.p = from_->X_WH.p + share * (newest_->X_WH.p - from_->X_WH.p);
  out.X_WH.R = from_->X_WH.R.slerp(share, newest_->X_WH.R).normalized();
  for (std::size_t j = 0; j < out.joints.size(); ++j)
    out.joints[j] = from_->joints[j] + share * (newest_->joints[j] - from_->joints[j]);
  out.grasp_intent = from_->grasp_intent + share * (newest_->grasp_intent - from_->grasp_intent);
  return out;
}

std::optional<client::HandSample> TrackedMotion::at(TimePoint now) noexcept {
  if (!is_seen(now)) return std::nullopt;
  const double share = std::clamp(to_seconds(now - seen_at_) / to_seconds(step_), 0.0, 1.0);
  client::HandSample out = between(share);
  if (share < 1) out.V_WH = mean_twist(from_->X_WH, newest_->X_WH, to_seconds(step_));
  return out;
}

void TrackedMotion::forget() noexcept {
  from_.reset();
  newest_.reset();
  measure_ = {};
}

}  // namespace mechane::gateway
