#include "client-sdk/client/frame_history.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::client {
namespace {

constexpr std::int64_t kJumpNs = 250'000'000;
// How far a frame moves the estimate towards a longer delay, as a share: 16 ms of jitter move it by 80 us.
constexpr std::int64_t kCreep = 200;
constexpr Duration kLeastStep = std::chrono::milliseconds(10);

Pose between(const Pose& a, const Pose& b, double t) {
  const Vec3 turn = rotation_vector(a.R.conjugate() * b.R);
  return {a.p + t * (b.p - a.p), (a.R * quat_from_rotation_vector(t * turn)).normalized()};
}

const HandPose* same_hand(const Frame& frame, const HandPose& hand) {
  const auto it = std::find_if(frame.hands.begin(), frame.hands.end(), [&](const HandPose& h) {
    return h.user == hand.user && h.kind == hand.kind && h.kiosk == hand.kiosk;
  });
  return it == frame.hands.end() ? nullptr : &*it;
}

}  // namespace

TimePoint ClockOffset::to_local(std::uint64_t sent_ns, TimePoint received) {
  const auto sent = static_cast<std::int64_t>(sent_ns);
  // Unsigned arithmetic wraps where wrong times of a sender would overflow.
  const auto measured = static_cast<std::int64_t>(to_ns(received) - sent_ns);
  const auto later =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(measured) - static_cast<std::uint64_t>(offset_ns_));
  if (!known_ || later < 0 || later > kJumpNs) {
    offset_ns_ = measured;
  } else {
    offset_ns_ += later / kCreep;
  }
  known_ = true;
  const auto local =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(sent) + static_cast<std::uint64_t>(offset_ns_));
  return TimePoint(Duration(local));
}

void interpolate(const Frame& a, const Frame& b, double t, Frame& out) {
  out = b;
  const bool same_bodies = a.bodies.size() == b.bodies.size() &&
                           std::equal(a.bodies.begin(), a.bodies.end(), b.bodies.begin(),
                                      [](const BodyPose& x, const BodyPose& y) { return x.object == y.object; });
  for (std::size_t i = 0; same_bodies && i < b.bodies.size(); ++i) {
    out.bodies[i].X_WB = between(a.bodies[i].X_WB, b.bodies[i].X_WB, t);
  }
  for (std::size_t i = 0; a.quantities.size() == b.quantities.size() && i < b.quantities.size(); ++i) {
    out.quantities[i] = a.quantities[i] + t * (b.quantities[i] - a.quantities[i]);
  }
  for (std::size_t i = 0; a.ropes.size() == b.ropes.size() && i < b.ropes.size(); ++i) {
    const std::vector<Vec3>& before = a.ropes[i].points_W;
    std::vector<Vec3>& points = out.ropes[i].points_W;
    for (std::size_t k = 0; before.size() == points.size() && k < points.size(); ++k)
      points[k] = before[k] + t * (points[k] - before[k]);
  }
  for (HandPose& hand : out.hands) {
    const HandPose* before = same_hand(a, hand);
    for (std::size_t s = 0; before != nullptr && s < kHandSegments; ++s) {
      hand.X_WS[s] = between(before->X_WS[s], hand.X_WS[s], t);
    }
  }
}

void FrameHistory::add(const Frame& frame, std::uint64_t sent_ns) {
  const TimePoint time = offset_.to_local(sent_ns, frame.received);
  if (!frames_.empty() && frame.sequence <= frames_.back().frame.sequence) return;
  // The estimate may step back a little, but times must rise.
  const TimePoint least = frames_.empty() ? time : frames_.back().time + std::chrono::microseconds(1);
  frames_.push_back({std::max(time, least), frame});
  if (frames_.size() > kFrames) frames_.pop_front();
}

void FrameHistory::clear() {
  frames_.clear();
  offset_ = ClockOffset{};
}

bool FrameHistory::at(TimePoint at, Frame& out) const {
  if (frames_.empty()) return false;
  at = std::min(at, frames_.back().time + kExtrapolateAtMost);
  if (frames_.size() == 1 || at <= frames_.front().time) {
    out = frames_.front().frame;
    return true;
  }
  auto after =
      std::upper_bound(frames_.begin(), frames_.end(), at, [](TimePoint t, const Entry& e) { return t < e.time; });
  if (after == frames_.end()) --after;
  const auto before = std::prev(after);
  const Duration gap = after->time - before->time;
  // For extrapolation, two frames that are almost simultaneous say little about speed.
  const Duration step = at > after->time ? std::max(gap, kLeastStep) : gap;
  const double beyond = at > after->time ? 1.0 : 0.0;
  const Duration since = at > after->time ? at - after->time : at - before->time;
  const double t = beyond + std::chrono::duration<double>(since) / std::chrono::duration<double>(step);
  interpolate(before->frame, after->frame, t, out);
  return true;
}

}  // namespace mechane::client
