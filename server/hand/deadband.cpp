#include "server/hand/deadband.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"
#include "server/hand/local_contact_model.hpp"

namespace mechane::hand {
namespace {

constexpr double kFarthest_m = 0.02;  // a server tells of surfaces up to this distance
constexpr double kStiffness_n_per_m = kFineForce_n / kFineWay_m;
// A wrong speed counts like the way in this time: damping over stiffness of the exhibits' parts.
constexpr double kDampingTime_s = 0.0025;
// A stylus reads its speed from two encoder steps in some milliseconds, and does not know it more exactly.
constexpr double kFineSpeed_m_per_s = 0.01;
// A wrong angle counts like the way at this distance: of a wrist to its fingertips, of a tip to the place where it holds something.
constexpr double kGloveLever_m = 0.2;
constexpr double kTipLever_m = 0.05;

static_assert(2 * kKeepAlive + kTickPeriod < kHoldFor, "one message may be lost");

/// Half a tick early: a message that waits for the next tick would be late.
bool is_time(TimePoint sent_at, TimePoint now) {
  return now - sent_at >= kKeepAlive - kTickPeriod / 2 || now < sent_at;
}

bool differ_only_in_motion(const HandSample& a, const HandSample& b) {
  return a.kind == b.kind && static_cast<const HandBuild&>(a) == b && a.joints == b.joints && a.buttons == b.buttons &&
         a.grasp_intent == b.grasp_intent;
}

/// Whether the motion of `a` stands for that of `b`, where a way of `allowed_m` more than the finest is too small to be felt.
bool same_motion(const HandSample& a, const HandSample& b, double allowed_m) {
  const double lever_m = b.kind == HandKind::glove ? kGloveLever_m : kTipLever_m;
  const double angle_rad = rotation_vector(a.X_WH.R * b.X_WH.R.conjugate()).norm();
  const double speed_m_per_s = (a.V_WH.v - b.V_WH.v).norm() + lever_m * (a.V_WH.w - b.V_WH.w).norm();
  return (a.X_WH.p - b.X_WH.p).norm() + lever_m * angle_rad <= kFineWay_m + allowed_m &&
         speed_m_per_s <= kFineSpeed_m_per_s + allowed_m / kDampingTime_s;
}

/// False where a number is not finite, as all comparisons here.
bool within(double share, double a, double b) {
  return std::abs(a - b) <= share * std::abs(b);
}

bool alike(double share, const Vec3& a, const Vec3& b, double fine) {
  return (a - b).norm() <= fine + share * b.norm();
}

bool same_material(double share, const LocalContact& a, const LocalContact& b) {
  return within(share, a.stiffness_n_per_m, b.stiffness_n_per_m) &&
         within(share, a.damping_ns_per_m, b.damping_ns_per_m) && within(share, a.static_friction, b.static_friction) &&
         within(share, a.dynamic_friction, b.dynamic_friction) &&
         within(share, a.viscosity_ns_per_m, b.viscosity_ns_per_m) &&
         within(share, a.grooves.depth_m, b.grooves.depth_m) && alike(share, a.grooves.wave_W, b.grooves.wave_W, 0) &&
         a.validity == b.validity;
}

/// What a client knows of a contact after `time_s`, with the hand `way_W` away from where it was: against the contact as it is.
bool is_foreseen(double share, const LocalContact& known, const LocalContact& now, const Vec3& way_W, double time_s) {
  const Vec3 travelled_W = time_s * known.v_W;
  const Overlap seen = overlap_of(known, known.depth_m * known.n_W + travelled_W, way_W);
  const double phase_rad = known.grooves.phase_rad + known.grooves.wave_W.dot(way_W - travelled_W);
  const double off_m = std::abs(seen.depth_m - now.depth_m) + kDampingTime_s * (known.v_W - now.v_W).norm();
  return off_m <= kFineWay_m + share * std::abs(now.depth_m) && alike(share, seen.n_W, now.n_W, 0) &&
         std::abs(2 * std::sin(0.5 * (phase_rad - now.grooves.phase_rad))) <= share && same_material(share, known, now);
}

/// A path stands still in the world; the point of a line may be any.
bool alike(double share, const HeldPath& a, const HeldPath& b) {
  if (a.kind != b.kind) return false;
  if (a.kind == HeldPath::Kind::none) return true;
  Vec3 apart_W = a.p_W - b.p_W;
  if (b.kind == HeldPath::Kind::line) apart_W -= apart_W.dot(b.axis_W) * b.axis_W;
  const double turned_m = (b.radius_m + kTipLever_m) * (a.axis_W - b.axis_W).norm();
  const double off_m = apart_W.norm() + (a.p_HG - b.p_HG).norm() + std::abs(a.radius_m - b.radius_m) + turned_m;
  return off_m <= kFineWay_m && std::abs(a.along_n - b.along_n) <= kFineForce_n + share * std::abs(b.along_n) &&
         within(share, a.stiffness_n_per_m, b.stiffness_n_per_m) &&
         within(share, a.damping_ns_per_m, b.damping_ns_per_m) && within(share, a.limit_n, b.limit_n) &&
         a.validity == b.validity;
}

bool same_events(const HapticOutput& a, const HapticOutput& b) {
  return a.reasons == b.reasons && a.contact_count == b.contact_count && a.holding == b.holding &&
         a.clicks.count == b.clicks.count;
}

bool alike_forces(double share, const HapticOutput& a, const HapticOutput& b) {
  const auto alike_n = [share](double x, double y) { return std::abs(x - y) <= kFineForce_n + share * std::abs(y); };
  return alike(share, a.force_W.f, b.force_W.f, kFineForce_n) &&
         alike(share, a.force_W.t, b.force_W.t, kFineForce_n * kTipLever_m) &&
         std::equal(a.finger_force_n.begin(), a.finger_force_n.end(), b.finger_force_n.begin(), alike_n);
}

}  // namespace

double reach_m(const HapticOutput& answer, const Vec3& p_WH0, const Vec3& p_WH) noexcept {
  double reach = kFarthest_m;
  for (const LocalContact& c : answer.contact_span())
    reach = std::min(reach, std::abs(overlap_of(c, p_WH0 + c.depth_m * c.n_W, p_WH).depth_m));
  const double force_n = answer.force_W.f.norm();
  const bool of_no_contact = answer.holding || (answer.contact_count == 0 && force_n > 0);  // as in the mode `paper`
  if (!of_no_contact) return reach;
  const bool on_path = answer.holding && answer.held.kind != HeldPath::Kind::none;
  return std::min(reach, force_n / (on_path ? answer.held.stiffness_n_per_m : kStiffness_n_per_m));
}

InputDeadband::InputDeadband(double share) noexcept : share_(share) {
  MECHANE_ASSERT(share >= 0 && share <= kMaxDeadband);
}

bool InputDeadband::is_due(const HandSample& sample, double reach_m, TimePoint now) const noexcept {
  if (!is_on() || !sent_ || is_time(sent_at_, now)) return true;
  return !differ_only_in_motion(*sent_, sample) || !same_motion(*sent_, sample, share_ * reach_m);
}

void InputDeadband::note_sent(const HandSample& sample, TimePoint now) noexcept {
  sent_ = sample;
  sent_at_ = now;
}

bool OutputDeadband::is_due(double share, const HapticOutput& answer, const Vec3& p_WH, TimePoint now) const noexcept {
  if (!(share > 0) || !sent_) return true;
  if (answer.echo_sequence != sent_->echo_sequence && is_time(sent_at_, now)) return true;
  if (!same_events(*sent_, answer) || !alike_forces(share, *sent_, answer) || !alike(share, sent_->held, answer.held))
    return true;
  const Vec3 way_W = p_WH - p_WH_sent_;
  const double time_s = to_seconds(now - sent_at_);
  for (std::size_t i = 0; i < answer.contact_count; ++i)
    if (!is_foreseen(share, sent_->contacts[i], answer.contacts[i], way_W, time_s)) return true;
  return false;
}

void OutputDeadband::note_sent(const HapticOutput& answer, const Vec3& p_WH, TimePoint now) noexcept {
  sent_ = answer;
  p_WH_sent_ = p_WH;
  sent_at_ = now;
}

}  // namespace mechane::hand
