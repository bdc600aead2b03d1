#include "client-sdk/display/head_view.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::display {
namespace {

/// Visitors move more slowly than this; faster jumps occur when a tracker switches to another person's head.
constexpr double kFollow_m_per_s = 3;
/// Time constant of the return to the usual place, slow enough not to startle anybody.
constexpr double kReturn_m_per_s = 0.4;
constexpr double kTurn_per_s = 4;
/// Limits in shares of the screen's width: nearer, or farther to the side, the picture would be only a stripe.
constexpr double kNearest = 0.25;
constexpr double kFarthest = 10;
/// Largest tangent of the head's direction, seen from the screen's middle.
constexpr double kSteepest = 1.2;
/// Largest tilt of the line between the eyes: beyond it, the two eyes' pictures cannot be fused.
constexpr double kLeastAcross = 0.5;

}  // namespace

picture::HeadPlace HeadView::limited(const Pose& X_SV) const {
  picture::HeadPlace out;
  const double z = std::clamp(X_SV.p.z(), kNearest * screen_.width_m, kFarthest * screen_.width_m);
  out.p_SV = {std::clamp(X_SV.p.x(), -kSteepest * z, kSteepest * z),
              std::clamp(X_SV.p.y(), -kSteepest * z, kSteepest * z), z};
  const Vec3 eyes_S = X_SV.rotate(Vec3::UnitX());
  if (eyes_S.x() >= kLeastAcross) out.eyes_S = eyes_S;
  return out;
}

void HeadView::advance(const std::optional<client::ViewerHead>& head, TimePoint now) {
  const double dt_s = advanced_ ? std::clamp(to_seconds(now - *advanced_), 0.0, 0.25) : 0.0;
  advanced_ = now;
  tracked_ = head && head->seen && now - head->received < kSilence;
  if (!screen_.known()) return;
  if (!tracked_ && !away_) return;
  const picture::HeadPlace goal = tracked_ ? limited(head->X_SV) : home_;
  const Vec3 way_S = goal.p_SV - place_.p_SV;
  const double step_m = (tracked_ ? kFollow_m_per_s : kReturn_m_per_s) * dt_s;
  const bool arrives = way_S.norm() <= step_m;
  place_.p_SV = arrives ? goal.p_SV : Vec3(place_.p_SV + step_m * way_S.normalized());
  const Vec3 turn_S = goal.eyes_S - place_.eyes_S;
  const bool turned = turn_S.norm() <= kTurn_per_s * dt_s;
  place_.eyes_S = turned ? goal.eyes_S : Vec3((place_.eyes_S + kTurn_per_s * dt_s * turn_S.normalized()).normalized());
  away_ = tracked_ || !arrives || !turned;
}

}  // namespace mechane::display
