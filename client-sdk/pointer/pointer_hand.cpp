#include "client-sdk/pointer/pointer_hand.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mechane::pointer {
namespace {

// A hand approaches from this far in front of the surface,
constexpr double kBefore_m = 0.06;
// and goes in this far: the tip of a one-point hand is a ball of 8 mm, part of which should touch.
constexpr double kInto_m = 0.003;
constexpr double kReachSpeed_m_per_s = 0.5;
// A hanging thing swings away from a faster hand before the hand has closed.
constexpr double kTouchSpeed_m_per_s = 0.06;
constexpr double kSlowing_per_s = 6;
// From in front of a thing that stays, it is there after half of this time.
constexpr double kArrives_s = 1.0;
constexpr double kTravelSpeed_m_per_s = 2.0;
constexpr double kDragSpeed_m_per_s = 1.2;
constexpr double kTurnSpeed_rad_per_s = 1.5;
constexpr double kTwistSpeed_rad_per_s = 3;  // where fingers turn it
constexpr double kClosesAt_m = 0.02;
// How far the hand may be ahead of what it holds: a grip is lost at 8 cm, and a visitor with a pointer feels no warning
// force.
constexpr double kLeash_m = 0.045;
// A thing that moves less than kRests_m in kRests_s, while it is at least kKept_m from under the pointer, is blocked.
constexpr double kRests_s = 0.3, kRests_m = 0.01, kKept_m = 0.03;
// A blocked thing is pulled towards the viewer and pressed a little towards its goal; after kPast_m that way it has
// passed.
constexpr double kDrawn_m = 0.035, kPressed_m = 0.008, kPast_m = 0.03, kMostDrawn_m = 0.8;
// For a body that turns in the grip: the server lets it lag behind the hand by at most this angle.
constexpr double kGripLag_rad = 0.6;
constexpr double kGripFelt_s = 1.0;
// A smaller tilt does not count as knocked over.
constexpr double kAskew_rad = 0.2;
constexpr double kLongestAdvance_s = 0.02;
// How long the hand waits before it treats a lost thing as lost: to a snap, a step, or its own weight.
constexpr double kNoticesLoss_s = 0.25;
// The server treats a hand as open after about 20 ms.
constexpr double kOpens_s = 0.1;
constexpr double kHome_m = 0.08;
constexpr int kFetches = 5;
constexpr double kLeaves_s = 0.25;
constexpr double kNearestCarried_m = 0.2;
// Distances from a goal, in shares of the picture's height: within the first the thing has the goal's depth, beyond the
// second the hand's.
constexpr double kDepthInner = 0.06, kDepthOuter = 0.30;
// The same for the place in the picture, because a finger is broad.
constexpr double kPlaceInner = 0.02, kPlaceOuter = 0.08;
// A circle seen from its edge is a line, around which nobody can drag: it is treated as an ellipse with at least this
// ratio.
constexpr double kLeastRound = 0.4;
// Nearer to the circle's middle than this share of its radius, angles are not reliable.
constexpr double kDeadMiddle = 0.2;
constexpr double kMostAhead_rad = 2 * kPi;

bool sane(picture::PixelPlace place, const picture::Sight& sight) {
  const double most = 10.0 * std::max(sight.picture.width, sight.picture.height);
  return std::abs(place.x) <= most && std::abs(place.y) <= most;
}

/// 1 up to `inner`, 0 from `outer` on.
double nearness(double distance, double inner, double outer) {
  const double s = std::clamp((outer - distance) / (outer - inner), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

double wrapped(double angle) {
  return std::remainder(angle, 2 * kPi);
}

Vec3 leashed(const Vec3& goal_W, const Vec3& held_W) {
  const Vec3 ahead = goal_W - held_W;
  const double length = ahead.norm();
  return length > kLeash_m ? Vec3(held_W + ahead * (kLeash_m / length)) : goal_W;
}

}  // namespace

std::optional<PointerSenses> senses_of(const PointerWorld& world, std::uint32_t object, bool holding) {
  const auto pose = [&](std::uint32_t other) { return pose_in(world.frame, world.objects, other); };
  const std::optional<Pose> X_WB = pose(object);
  if (!X_WB || world.presentation == nullptr) return {};
  const client::SceneObject* known = object_of(world.objects, object);
  return PointerSenses{*X_WB, leeway_of(world.presentation->affordances, world.enabled, object, pose), holding,
                       known == nullptr ? std::nullopt : std::optional(known->X_WB.R)};
}

void PointerHand::press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) {
  if (sight.picture.width < 2 || sight.picture.height < 2 || !sane(place, sight) || !touched.p_WT.allFinite()) return;
  const bool here = phase_ != Phase::resting;
  sight_ = sight;
  pointer_ = place;
  touched_ = touched;
  p_BT_.reset();
  p_WT_.reset();
  near_s_ = 0;
  fetched_ = 0;
  phase_ = Phase::reaching;
  phase_s_ = 0;
  grasp_ = 0;
  away_W_ = picture::ray_through(sight, place).d_W;
  if (!here) X_WH_ = {touched.p_WT - kBefore_m * away_W_, Quat::Identity()};
}

void PointerHand::move(picture::PixelPlace place) {
  if (phase_ == Phase::resting || !sane(place, sight_)) return;
  pointer_ = place;
  if (phase_ != Phase::holding || drag_ != Drag::turn) return;
  const Eigen::Vector2d on_circle = circle_ * Eigen::Vector2d(place.x - middle_.x, place.y - middle_.y);
  if (on_circle.norm() < kDeadMiddle) return;
  const double now = angle_seen(place);
  wanted_rad_ += wrapped(now - seen_rad_);
  wanted_rad_ = std::clamp(wanted_rad_, angle_rad_ - kMostAhead_rad, angle_rad_ + kMostAhead_rad);
  seen_rad_ = now;
}

void PointerHand::deepen(double amount) {
  if (phase_ != Phase::holding || !std::isfinite(amount)) return;
  const double wanted = depth_m_ * std::exp(std::clamp(amount, -3.0, 3.0));
  depth_m_ = std::clamp(wanted, std::max(kNearestCarried_m, gripped_depth_m_ / 4), 4 * gripped_depth_m_);
}

void PointerHand::turn(double angle_rad) {
  if (phase_ != Phase::holding || !std::isfinite(angle_rad)) return;
  if (drag_ == Drag::carry) {
    const Vec3 away_W = X_WH_.p - sight_.view.p_WE.cast<double>();
    if (away_W.norm() < 1e-6) return;
    const Eigen::AngleAxisd turn(std::clamp(angle_rad, -kPi, kPi), away_W.normalized());
    turned_W_ = (turn * turned_W_).normalized();
    twisted_ = true;
  }
  if (drag_ != Drag::turn) return;
  const Vec3 to_eye = sight_.view.p_WE.cast<double>() - line_.p_W;
  const double clockwise = to_eye.dot(line_.a_W) > 0 ? -1 : 1;
  wanted_rad_ += clockwise * std::clamp(angle_rad, -kPi, kPi);
  wanted_rad_ = std::clamp(wanted_rad_, angle_rad_ - kMostAhead_rad, angle_rad_ + kMostAhead_rad);
}

void PointerHand::release() {
  if (phase_ == Phase::reaching || phase_ == Phase::holding) let_go();
}

void PointerHand::let_go() {
  phase_ = Phase::leaving;
  phase_s_ = 0;
  grasp_ = 0;
}

std::optional<client::HandSample> PointerHand::advance(double dt_s, const PointerSenses& senses) {
  if (phase_ == Phase::resting || !(dt_s > 0)) return {};
  const double dt = std::min(dt_s, kLongestAdvance_s);
  const Pose before = X_WH_;
  phase_s_ += dt;
  if (phase_ == Phase::reaching) {
    reach(dt, senses);
  } else if (phase_ == Phase::holding) {
    hold(dt, senses);
  } else {
    leave(dt);
  }
  client::HandSample input;
  input.kind = client::HandKind::one_point;
  input.X_WH = X_WH_;
  input.V_WH = mean_twist(before, X_WH_, dt);
  input.grasp_intent = grasp_;
  return input;
}

/// Reaches for the pressed point of the thing, which may have moved since.
void PointerHand::reach(double dt_s, const PointerSenses& senses) {
  if (!p_BT_) p_BT_ = senses.X_WB.inverse() * touched_.p_WT;
  const Vec3 p_WT = senses.X_WB * *p_BT_;
  turn_towards(Quat::Identity(), kTurnSpeed_rad_per_s, dt_s);
  // First to the place in front of the surface: a direct path from elsewhere could hit other things.
  const Vec3 before_W = p_WT - kBefore_m * away_W_;
  const double ahead = (p_WT - X_WH_.p).dot(away_W_);
  const bool beside = (X_WH_.p - p_WT + ahead * away_W_).norm() > kClosesAt_m;
  if (beside && grasp_ == 0) {
    p_WT_.reset();
    go_towards(before_W, kTravelSpeed_m_per_s, dt_s);
    return;
  }
  near_s_ += dt_s;
  if (near_s_ > kArrives_s) go_with(p_WT, dt_s);
  const Vec3 into_W = p_WT + kInto_m * away_W_;
  const double gap_m = (into_W - X_WH_.p).norm();
  go_towards(into_W, std::clamp(kSlowing_per_s * gap_m, kTouchSpeed_m_per_s, kReachSpeed_m_per_s), dt_s);
  if ((X_WH_.p - p_WT).norm() < kClosesAt_m && phase_s_ > kOpens_s) grasp_ = 1;
  if (senses.holding && grasp_ > 0) grip(senses);
}

/// A thing that drifts away, as weightless ones do after a push, stays ahead of a hand that slows near it. One that only yields to the
/// hand is not gone after: it would be pushed on.
void PointerHand::go_with(const Vec3& p_WT, double dt_s) {
  owed_W_ = p_WT_ ? Vec3(owed_W_ + p_WT - *p_WT_) : Vec3::Zero();
  p_WT_ = p_WT;
  const double owed_m = owed_W_.norm(), most_m = kDragSpeed_m_per_s * dt_s;
  const Vec3 step_W = owed_m > most_m ? Vec3(owed_W_ * (most_m / owed_m)) : owed_W_;
  X_WH_.p += step_W;
  owed_W_ -= step_W;
}

void PointerHand::grip(const PointerSenses& senses) {
  phase_ = Phase::holding;
  phase_s_ = empty_s_ = 0;
  X_BH_ = senses.X_WB.inverse() * X_WH_;
  depth_m_ = gripped_depth_m_ = std::max(picture::depth_of(sight_, X_WH_.p), kNearestCarried_m);
  p_WG_goal_.reset();
  R_WH_gripped_ = X_WH_.R;
  turned_W_ = Quat::Identity();
  twisted_ = false;
  obstacle_ = {};
  const Quat R_WB_rest = senses.R_WB_rest.value_or(senses.X_WB.R);
  knocked_ = rotation_vector(senses.X_WB.R * R_WB_rest.conjugate()).norm() > kAskew_rad;
  drag_ = Drag::carry;
  if (senses.leeway.axle) begin_turn(*senses.leeway.axle);
  if (drag_ == Drag::carry && senses.leeway.track) {
    drag_ = Drag::slide;
    line_ = {X_WH_.p, senses.leeway.track->a_W};
    slid_from_m_ = 0;
    slid_from_m_ = (slid_to() - X_WH_.p).dot(line_.a_W);
  }
}

/// Finds the map from pixels to angles: the circle appears nearly as an ellipse, whose inverse takes pixels to the
/// circle.
void PointerHand::begin_turn(const AffordanceLine& axle) {
  const Vec3 arm = X_WH_.p - axle.p_W;
  const Vec3 middle_W = axle.p_W + arm.dot(axle.a_W) * axle.a_W;
  const Vec3 from_W = X_WH_.p - middle_W;
  const auto middle = picture::pixel_of(sight_, middle_W);
  const auto one = picture::pixel_of(sight_, middle_W + from_W);
  const auto other = picture::pixel_of(sight_, middle_W + axle.a_W.cross(from_W));
  if (!middle || !one || !other || from_W.norm() < 1e-3) return;
  Eigen::Matrix2d seen;
  seen << one->x - middle->x, other->x - middle->x, one->y - middle->y, other->y - middle->y;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(seen, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector2d half_axes = svd.singularValues();
  if (half_axes.x() < 2) return;  // pixels: too small to drag around
  half_axes.y() = std::max(half_axes.y(), kLeastRound * half_axes.x());
  circle_ = svd.matrixV() * half_axes.cwiseInverse().asDiagonal() * svd.matrixU().transpose();
  drag_ = Drag::turn;
  line_ = {middle_W, axle.a_W};
  from_W_ = from_W;
  middle_ = *middle;
  angle_rad_ = wanted_rad_ = 0;
  seen_rad_ = angle_seen(pointer_);
}

double PointerHand::angle_seen(picture::PixelPlace place) const {
  const Eigen::Vector2d on_circle = circle_ * Eigen::Vector2d(place.x - middle_.x, place.y - middle_.y);
  return std::atan2(on_circle.y(), on_circle.x());
}

double PointerHand::angle_of(const Vec3& p_W) const {
  const Vec3 arm = p_W - line_.p_W;
  return std::atan2(arm.dot(line_.a_W.cross(from_W_)), arm.dot(from_W_));
}

void PointerHand::hold(double dt_s, const PointerSenses& senses) {
  empty_s_ = senses.holding ? 0 : empty_s_ + dt_s;
  if (empty_s_ > kNoticesLoss_s) return lose(senses);
  const Vec3 held_W = senses.X_WB * X_BH_.p;
  if (drag_ == Drag::turn) {
    X_WH_.p = turned_to(held_W, dt_s);
    return;
  }
  if (drag_ == Drag::slide) return go_towards(leashed(slid_to(), held_W), kDragSpeed_m_per_s, dt_s);
  feel_grip(senses, dt_s);
  go_towards(leashed(past_obstacle(carried_to(senses), held_W, dt_s), held_W), kDragSpeed_m_per_s, dt_s);
  turn_towards(R_WH_wanted_, twisted_ ? kTwistSpeed_rad_per_s : kTurnSpeed_rad_per_s, dt_s);
}

/// A knocked thing turns in the grip: updates the rotation in which the hand holds it.
void PointerHand::feel_grip(const PointerSenses& senses, double dt_s) {
  const Vec3 lag = rotation_vector(X_WH_.R * X_BH_.R.conjugate() * senses.X_WB.R.conjugate());
  knocked_ = knocked_ || lag.norm() > kGripLag_rad;
  if (!knocked_) return;  // the grip alone damps a swinging thing; a hand that follows would make it swing more
  const double kept = std::min(1.0, kGripLag_rad / std::max(lag.norm(), 1e-9)) * std::exp(-dt_s / kGripFelt_s);
  const Quat left = quat_from_rotation_vector(kept * lag);
  X_BH_.R = (senses.X_WB.R.conjugate() * left.conjugate() * X_WH_.R).normalized();
}

/// The picture lacks a dimension: a thing that is dragged against another's side would get stuck there. A person would
/// pull it towards them and pass in front of the obstacle, and so does the hand.
Vec3 PointerHand::past_obstacle(const Vec3& goal_W, const Vec3& held_W, double dt_s) {
  const Vec3 away_W = (held_W - sight_.view.p_WE.cast<double>()).normalized();
  const Vec3 lag_W = goal_W - held_W;
  const Vec3 aside_W = lag_W - lag_W.dot(away_W) * away_W;
  Obstacle& o = obstacle_;
  const Vec3 gone_W = held_W - o.from_W;
  if (aside_W.norm() < kKept_m || (o.passing && gone_W.dot(o.aside_W) > kPast_m)) {
    if (o.passing) depth_m_ = std::max(picture::depth_of(sight_, held_W), kNearestCarried_m);
    o = Obstacle();
    o.rests_W = held_W;
    return goal_W;
  }
  o.rests_s = (held_W - o.rests_W).norm() > kRests_m ? 0 : o.rests_s + dt_s;
  if (o.rests_s == 0) o.rests_W = held_W;
  if (!o.passing && !o.stays && o.rests_s > kRests_s) {
    o.passing = true;
    o.from_W = held_W;
    o.aside_W = aside_W.normalized();
  } else if (o.passing && -gone_W.dot(away_W) > kMostDrawn_m) {
    o.passing = false;
    o.stays = true;
  }
  return o.passing ? Vec3(held_W + kPressed_m * o.aside_W - kDrawn_m * away_W) : goal_W;
}

/// A thing that has reached its place is released. One that slipped away is fetched again, as the finger is still down.
void PointerHand::lose(const PointerSenses& senses) {
  const bool home = std::ranges::any_of(senses.leeway.goals, [&](const AffordanceGoal& goal) {
    return goal.turns_too && (goal.X_WB.p - senses.X_WB.p).norm() < kHome_m;
  });
  if (home || !senses.leeway.taken || fetched_ >= kFetches) return let_go();
  ++fetched_;
  p_BT_ = X_BH_.p;
  p_WT_.reset();
  near_s_ = 0;
  phase_ = Phase::reaching;
  phase_s_ = 0;
  grasp_ = 0;
}

/// Where the hand carries the thing: in the plane that faces the viewer; near one of its goals, towards that goal.
Vec3 PointerHand::carried_to(const PointerSenses& senses) {
  p_WG_goal_.reset();
  // The rotation at rest, or else at the grip, and the visitor's turns since.
  const Quat R_WH_rest = knocked_ && senses.R_WB_rest ? *senses.R_WB_rest * X_BH_.R : R_WH_gripped_;
  R_WH_wanted_ = turned_W_ * R_WH_rest;
  const AffordanceGoal* meant = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (const AffordanceGoal& goal : senses.leeway.goals) {
    const Vec3 p_WG = goal.X_WB * X_BH_.p;
    const auto seen = picture::pixel_of(sight_, p_WG);
    if (!seen) continue;
    const double away = std::hypot(seen->x - pointer_.x, seen->y - pointer_.y) / sight_.picture.height;
    if (away >= nearest) continue;
    nearest = away;
    p_WG_goal_ = p_WG;
    meant = &goal;
  }
  if (!p_WG_goal_) return picture::point_at(sight_, pointer_, depth_m_);
  // The thing takes the goal's depth only when it is near itself: before, other things may stand in between.
  const auto held = picture::pixel_of(sight_, senses.X_WB * X_BH_.p);
  const auto place = picture::pixel_of(sight_, *p_WG_goal_);
  const double apart =
      held && place ? std::hypot(held->x - place->x, held->y - place->y) / sight_.picture.height : nearest;
  const double near = nearness(std::max(nearest, apart), kDepthInner, kDepthOuter);
  if (meant->turns_too) R_WH_wanted_ = R_WH_wanted_.slerp(near, meant->X_WB.R * X_BH_.R);
  const double depth_m = depth_m_ + near * (picture::depth_of(sight_, *p_WG_goal_) - depth_m_);
  const Vec3 dragged_W = picture::point_at(sight_, pointer_, depth_m);
  return dragged_W + nearness(nearest, kPlaceInner, kPlaceOuter) * (*p_WG_goal_ - dragged_W);
}

/// The point of the track that is nearest to the pointer's ray. If the track leads straight away from the eye, dragging
/// up moves along it.
Vec3 PointerHand::slid_to() const {
  const picture::SightRay ray = picture::ray_through(sight_, pointer_);
  const double cosine = line_.a_W.dot(ray.d_W);
  const Vec3 gap = line_.p_W - ray.p_W;
  constexpr double kStraightAway = 0.97;
  double along_m = 0;
  if (std::abs(cosine) < kStraightAway) {
    along_m = (cosine * gap.dot(ray.d_W) - gap.dot(line_.a_W)) / (1 - cosine * cosine);
  } else {
    const double depth_m = std::max(picture::depth_of(sight_, line_.p_W), kNearestCarried_m);
    const auto began = picture::pixel_of(sight_, line_.p_W);
    const picture::PixelPlace level{pointer_.x, began ? began->y : pointer_.y};
    const double up_m =
        (picture::point_at(sight_, pointer_, depth_m) - picture::point_at(sight_, level, depth_m)).norm();
    along_m = std::copysign(up_m, (level.y - pointer_.y) * cosine);
  }
  return line_.p_W + (along_m - slid_from_m_) * line_.a_W;
}

/// Moves along the circle, at most at a hand's speed and no farther ahead of the thing than the grip allows.
Vec3 PointerHand::turned_to(const Vec3& held_W, double dt_s) {
  const double radius_m = from_W_.norm();
  const double step = kDragSpeed_m_per_s / radius_m * dt_s;
  const double next = angle_rad_ + std::clamp(wanted_rad_ - angle_rad_, -step, step);
  const double held = angle_rad_ + wrapped(angle_of(held_W) - angle_rad_);
  const double leash = kLeash_m / radius_m;
  angle_rad_ = std::clamp(next, std::min(held - leash, angle_rad_), std::max(held + leash, angle_rad_));
  return line_.p_W + Eigen::AngleAxisd(angle_rad_, line_.a_W) * from_W_;
}

/// Opens the hand, then moves it back towards the viewer.
void PointerHand::leave(double dt_s) {
  if (phase_s_ > kOpens_s) X_WH_.p -= kReachSpeed_m_per_s * dt_s * away_W_;
  if (phase_s_ > kLeaves_s) phase_ = Phase::resting;
}

void PointerHand::go_towards(const Vec3& goal_W, double speed_m_per_s, double dt_s) {
  if (!goal_W.allFinite()) return;
  const Vec3 offset = goal_W - X_WH_.p;
  const double step_m = speed_m_per_s * dt_s;
  X_WH_.p += offset.norm() > step_m ? Vec3(offset.normalized() * step_m) : offset;
}

void PointerHand::turn_towards(const Quat& goal_R_WH, double speed_rad_per_s, double dt_s) {
  const Vec3 turn = rotation_vector(goal_R_WH * X_WH_.R.conjugate());
  const double share = std::min(1.0, speed_rad_per_s * dt_s / std::max(turn.norm(), 1e-9));
  X_WH_.R = (quat_from_rotation_vector(share * turn) * X_WH_.R).normalized();
}

PointerView PointerHand::view() const {
  PointerView view{phase_, drag_, touched_.object, X_WH_.p, pointer_, {}, {}, 0};
  if (phase_ != Phase::holding) return view;
  if (drag_ == Drag::carry) view.p_WG = p_WG_goal_;
  if (drag_ == Drag::turn) {
    view.axle = line_;
    view.radius_m = from_W_.norm();
  }
  return view;
}

}  // namespace mechane::pointer
