#include "server/transport/validate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/base/utf8.hpp"
#include "server/hand/deadband.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {
namespace {

bool finite(const proto::HapticInput& s) {
  return proto::all_finite(s.X_WH) && proto::all_finite(s.v_WH) && proto::all_finite(s.w_WH) &&
         proto::all_finite(s.joints) && std::isfinite(s.hand_scale) && proto::all_finite(s.finger_scale) &&
         std::isfinite(s.grasp_intent) && std::isfinite(s.deadband);
}

bool good_values(const proto::HapticInput& s) {
  return s.user < hand::kMaxUsers && hand::is_hand_kind(s.kind) && hand::is_hand_side(s.side) && s.grasp_intent >= 0 &&
         s.grasp_intent <= 1 && s.deadband >= 0 && s.deadband <= hand::kMaxDeadband &&
         std::all_of(std::begin(s.joints), std::end(s.joints), [](float a) { return std::abs(a) <= kMaxJointRad; });
}

bool good_sizes(const proto::HapticInput& s) {
  // A float of 0.7 is less than the double.
  constexpr auto kLeast = static_cast<float>(hand::kMinFingerScale), kMost = static_cast<float>(hand::kMaxFingerScale);
  return s.hand_scale >= hand::kMinHandScale && s.hand_scale <= hand::kMaxHandScale &&
         std::all_of(std::begin(s.finger_scale), std::end(s.finger_scale),
                     [&](float scale) { return scale >= kLeast && scale <= kMost; });
}

}  // namespace

std::string_view to_string(Reject reason) {
  switch (reason) {
    case Reject::none:
      return "none";
    case Reject::wrong_protocol:
      return "of another protocol version";
    case Reject::not_finite:
      return "not finite";
    case Reject::bad_rotation:
      return "with a rotation that is not a unit quaternion";
    case Reject::too_far:
      return "over 100 m away";
    case Reject::too_fast:
      return "too fast for a hand";
    case Reject::bad_size:
      return "with a size that no hand has";
    case Reject::bad_value:
      return "with a value out of range";
    case Reject::wrong_kiosk:
      return "under another kiosk's name";
    case Reject::wrong_session:
      return "of a session that does not own the hand";
    case Reject::old_sequence:
      return "repeated or out of order";
    case Reject::high_sequence:
      return "with a sequence number that jumped too far";
    case Reject::too_late:
      return "whose round trip took over 250 ms";
    case Reject::kinds:
      break;
  }
  return "?";
}

Reject validate(const proto::HapticInput& s, hand::SentSample& out) noexcept {
  if (s.protocol != proto::kProtocol) return Reject::wrong_protocol;
  if (!finite(s)) return Reject::not_finite;
  Pose X_WH = proto::to_pose(s.X_WH);
  if (!proto::normalise(X_WH)) return Reject::bad_rotation;
  if (!(X_WH.p.norm() < hand::kFarthestHand_m)) return Reject::too_far;
  const Twist V_WH{proto::to_vec3(s.v_WH), proto::to_vec3(s.w_WH)};
  if (!(V_WH.v.norm() < kMaxSpeedMPerS && V_WH.w.norm() < kMaxTurnRadPerS)) return Reject::too_fast;
  if (!good_sizes(s)) return Reject::bad_size;
  if (!good_values(s)) return Reject::bad_value;
  if (s.session == 0) return Reject::wrong_session;
  out.session = s.session;
  out.sequence = s.seq;
  out.sent_ns = s.sent_ns;
  out.kind = static_cast<hand::HandKind>(s.kind);
  out.side = static_cast<hand::HandSide>(s.side);
  out.X_WH = X_WH;
  out.V_WH = V_WH;
  std::copy(std::begin(s.joints), std::end(s.joints), out.joints.begin());
  out.hand_scale = s.hand_scale;
  std::copy(std::begin(s.finger_scale), std::end(s.finger_scale), out.finger_scale.begin());
  out.buttons = s.buttons;
  out.grasp_intent = s.grasp_intent;
  return Reject::none;
}

Reject validate(const proto::KioskStatus& s, Session& out) {
  if (s.protocol != proto::kProtocol) return Reject::wrong_protocol;
  if (!proto::is_name(proto::text_of(s.kiosk))) return Reject::wrong_kiosk;
  if (s.user >= hand::kMaxUsers || s.role > mechane_role_watcher) return Reject::bad_value;
  if (s.session == 0) return Reject::wrong_session;
  out.id = s.session;
  out.kiosk = proto::text_of(s.kiosk);
  out.user = s.user;
  out.role = s.role == mechane_role_hand ? Role::hand : Role::watcher;
  out.program = without_controls(proto::text_of(s.program));
  out.host = without_controls(proto::text_of(s.host));
  out.scenario = without_controls(proto::text_of(s.scenario));
  out.was_there = s.was_there != 0;
  out.join_kiosk = without_controls(proto::text_of(s.join_kiosk));
  return Reject::none;
}

std::uint64_t RejectCounters::total() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& c : counts_)
    sum += c.load(std::memory_order_relaxed);
  return sum;
}

std::string RejectReport::since_last(const RejectCounters& counters) {
  std::string reasons;
  std::uint64_t total = 0;
  for (std::size_t i = 1; i < seen_.size(); ++i) {
    const std::uint64_t now = counters.count(static_cast<Reject>(i));
    const std::uint64_t count = now - std::exchange(seen_[i], now);
    if (count == 0) continue;
    total += count;
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, to_string(static_cast<Reject>(i)));
  }
  return total == 0 ? std::string() : fmt::format("rejected {} samples: {}", total, reasons);
}

}  // namespace mechane::transport
