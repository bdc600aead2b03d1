#include "client-sdk/visitor/visit_player.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "client-sdk/haptic/haptic_loop.hpp"

namespace mechane::visitor {
namespace {

using state::VisitMove;

// A hand's acceleration on a crank, turns per second squared.
constexpr double kTurnRampRadPerS2 = 6.0;
// A fingertip feels less than this force, and the noise of a resting hand stays below it.
constexpr double kTouchN = 0.1;
constexpr double kFollowMPerS = 0.15;
// How long a person needs to notice that the hand is empty.
constexpr double kNoticesLossS = 0.3;
// A hand that feels something farther than this from the grip has met another thing, or another end of it, and goes on.
constexpr double kNearGripM = 0.2;
// A thing that is farther than this from where it should have been carried was lost on the way.
constexpr double kSlippedM = 0.1;
// How fast a hand stops pressing: when it has caught a thing, or let it go; and across the way of a handle that it works.
constexpr double kRelaxesInS = 0.1;
constexpr double kGivesWayMPerNs = 0.05;
// A stylus that feels more than this does not press harder to get hold of a thing.
constexpr double kPressesN = 1;
constexpr double kPatienceS = 5;  // with a thing that is held and does not come after the hand
// Who picks up what fell brings it back calmly: from the floor the way is longer than the visit's own.
constexpr double kBringsBackMPerS = 0.4;
// Nobody carries a thing farther: one that fell into the void is given up in the end.
constexpr double kArmsReachM = 2;
// A thing that lies farther than this from where the hand has reached for it fell or rolled meanwhile: the hand reaches for it again.
constexpr double kMovedOnM = 0.2;
constexpr int kReachesAgain = 5;

// Places in a whole hand: where a handle lies, under the roots of the fingers; the tip of a stretched index finger.
const Vec3 kGrip_H(0.095, -0.030, 0);
const Vec3 kIndexTip_H(0.1965, 0, -0.031);

/// Thumb first; of each finger abduction, then three flexions.
HandJoints bent(double thumb_rad, double index_rad, double others_rad) {
  HandJoints joints{};
  for (std::size_t finger = 0; finger < joints.size() / 4; ++finger) {
    const double angle = finger == 0 ? thumb_rad : finger == 1 ? index_rad : others_rad;
    for (std::size_t k = 1; k < 4; ++k)
      joints[4 * finger + k] = angle;
  }
  return joints;
}

const HandJoints kOpen = bent(0.1, 0.15, 0.15);
const HandJoints kClosed = bent(0.5, 0.9, 0.9);
const HandJoints kPointing = bent(0.6, 0, 1.3);
constexpr double kClosesInS = 0.3;
// A whole hand approaches from above what it will carry: otherwise its long fingers push the thing away or catch its
// side.
constexpr double kOverM = 0.12;
constexpr double kUpAfter = 0.5, kOverAfter = 0.75, kDownFrom = 0.65;  // shares of the reach's duration

/// Palm down, fingers across the axis: away from the visitor, who looks along -z, or to the visitor's right.
Quat across(const Vec3& axis_W) {
  Vec3 x = Vec3::UnitY().cross(axis_W);
  if (x.norm() < 0.1) x = -Vec3::UnitZ();
  if (x.z() > 1e-9 || (std::abs(x.z()) <= 1e-9 && x.x() < 0)) x = -x;
  x.normalize();
  Mat3 R_WH;
  R_WH << x, Vec3::UnitY(), x.cross(Vec3::UnitY());
  return Quat(R_WH);
}

/// From a goal to where a hand with stretched fingers does not touch it yet; `back_W` leads back to where the hand comes from.
Vec3 beside(Vec3 back_W) {
  constexpr double kBesideM = 0.25;  // less than a closing hand goes in its patience: 2 s at kFollowMPerS
  back_W.y() = 0;
  return std::min(kBesideM, back_W.norm()) * back_W.normalized();
}

}  // namespace

std::string name_of(const state::WorldDescription& description, const VisitMove& move) {
  switch (move.kind) {
    case VisitMove::Kind::reach:
      return "reach " + description.bodies[move.body.index()].name;
    case VisitMove::Kind::grasp:
      return "grasp " + description.bodies[move.body.index()].name;
    case VisitMove::Kind::move_to:
      return "carry " + description.bodies[move.body.index()].name;
    case VisitMove::Kind::turn:
      return "turn " + description.joints[move.joint.index()].name;
    case VisitMove::Kind::swing:
      return "swing " + description.joints[move.joint.index()].name;
    case VisitMove::Kind::release:
      return "release";
    case VisitMove::Kind::wait:
      break;
  }
  return "wait";
}

std::size_t reach_before(const state::VisitDescription& visit, std::size_t from) {
  std::size_t i = std::min(from, visit.moves.size() - 1);
  while (i > 0 && visit.moves[i].kind != VisitMove::Kind::reach)
    --i;
  return i;
}

double joint_angle(const state::JointDescription& joint, std::span<const Pose> X_WB) {
  const Pose X_J1J2 = (X_WB[joint.body1.index()] * joint.X_B1J).inverse() * (X_WB[joint.body2.index()] * joint.X_B2J);
  return rotation_vector(X_J1J2.R).z();
}

PlayerConfig fitted(PlayerConfig config, const haptic::VirtualChoice& device) {
  constexpr double kSeenLag_m = 0.03;
  config.kind = device.hand;
  config.side = device.side;
  if (device.tracked) config.waits_for_lag_m = kSeenLag_m;
  return config;
}

HandSense sense_hand(const haptic::SimulatedDevice& device, const haptic::HapticLoop& loop) {
  constexpr double kSeenTouchN = 1;
  const double felt_n = device.renders() ? device.force_W().norm() : loop.touches() ? kSeenTouchN : 0;
  HandSense sense{loop.holding(), felt_n, device.force_W(), loop.hand().X_WH.p, {}};
  const hand::HeldPath& held = loop.held();
  const bool has_path = held.kind == hand::HeldPath::Kind::circle || held.kind == hand::HeldPath::Kind::line;
  if (sense.holding && has_path) sense.p_HG = held.p_HG;
  return sense;
}

double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

VisitPlayer::VisitPlayer(const state::WorldDescription& description, const state::VisitDescription& visit,
                         const PlayerConfig& config)
    : description_(description), visit_(visit), config_(config) {
  intent_.kind = config.kind;
  intent_.X_WH = config.X_WH_rest;
  results_.reserve(visit.moves.size());
  done_rad_.resize(visit.moves.size());
}

void VisitPlayer::advance(double dt_s, std::span<const Pose> X_WB, const HandSense& hand) {
  if (finished()) return;
  if (!begun_) begin_move(X_WB, hand);
  if (waits(X_WB, hand.holding, dt_s)) return;
  time_s_ += dt_s;
  last_dt_s_ = dt_s;
  note_grip(X_WB, hand);
  bend_fingers(hand.holding);
  const bool over = continue_move(X_WB, hand);
  const bool again =
      (lost_its_handle() || (over && slipped(X_WB, hand.holding))) && fetched_again_ < config_.fetch_again;
  if (!over && !again) return;
  end_move(again);
  if (again) fetch_again();
}

void VisitPlayer::begin_move(std::span<const Pose> X_WB, const HandSense& hand) {
  const VisitMove& move = visit_.moves[index_];
  begun_ = true;
  ok_ = true;
  time_s_ = 0;
  duration_s_ = move.duration_s;
  turned_rad_ = 0;
  held_ = false;
  held_rad_ = 0;
  empty_s_ = 0;
  waited_s_ = 0;
  to_grip_m_ = to_grip_m(X_WB);
  X_WH_start_ = intent_.X_WH;
  X_WH_goal_ = X_WH_start_;
  over_m_ = 0;
  if (move.kind == VisitMove::Kind::reach) {
    const bool from_side = config_.kind == client::HandKind::glove && config_.shapes_hand && shape_hand(X_WB);
    if (index_ != last_reach_) fetched_again_ = reached_again_ = 0;
    last_reach_ = index_;
    p_BG_ = move.p_BG;
    p_WG_reached_ = grip_W(X_WB);
    X_WH_goal_.p = p_WG_reached_ - X_WH_goal_.R * p_HG_;
    if (from_side) X_WH_goal_.p += beside(X_WH_start_.p - X_WH_goal_.p);
  } else if (move.kind == VisitMove::Kind::move_to) {
    // From here on, the hand keeps the pose that it now has relative to the body.
    const Pose X_BH = X_WB[move.body.index()].inverse() * X_WH_start_;
    X_WH_goal_ = move.X_WB * X_BH;
    const double way_m = std::min((X_WH_goal_.p - X_WH_start_.p).norm(), kArmsReachM);
    if (fetched_again_ > 0) duration_s_ = std::max(duration_s_, way_m / kBringsBackMPerS);
  } else if (move.kind == VisitMove::Kind::turn || move.kind == VisitMove::Kind::swing) {
    const state::JointDescription& joint = description_.joints[move.joint.index()];
    seen_rad_ = 0;
    swing_from_rad_ = seen_at_rad_ = joint_angle(joint, X_WB);
    p_HG_W_ = X_WH_start_.R * hand.p_HG.value_or(p_HG_);
    arm_J_ = frame_of(joint).inverse() * Vec3(X_WH_start_.p + p_HG_W_);
  } else if (move.kind == VisitMove::Kind::grasp) {
    intent_.grasp_intent = 1;
    grasp_ = {move.body, std::numeric_limits<double>::infinity(), false};
  } else if (move.kind == VisitMove::Kind::release) {
    intent_.grasp_intent = 0;
  }
}

Vec3 VisitPlayer::grip_W(std::span<const Pose> X_WB) const {
  return X_WB[visit_.moves[index_].body.index()] * p_BG_ + config_.offset_W;
}

/// From where the hand has its grip to the grip of what it last reached for; 0 before the first reach.
double VisitPlayer::to_grip_m(std::span<const Pose> X_WB) const {
  const VisitMove& reach = visit_.moves[last_reach_];
  if (reach.kind != VisitMove::Kind::reach) return 0;
  return (X_WB[reach.body.index()] * p_BG_ - intent_.X_WH * p_HG_).norm();
}

/// A thing that comes after the hand is waited for each time; one that does not come at all is pulled in the end.
bool VisitPlayer::waits(std::span<const Pose> X_WB, bool holding, double dt_s) {
  if (!config_.waits_for_lag_m || !holding) return false;
  const bool lags = to_grip_m(X_WB) - to_grip_m_ > *config_.waits_for_lag_m;
  waited_s_ = lags ? waited_s_ + dt_s : 0;
  return lags && waited_s_ <= kPatienceS;
}

/// The hand's pose depends on the move after this reach: a handle to be worked lies across the palm, a sign is touched
/// with the index finger. What will be carried is taken at the wrist, without turning the hand: there its weight turns
/// it least.
bool VisitPlayer::shape_hand(std::span<const Pose> X_WB) {
  const auto move_at = [&](std::size_t i) { return i < visit_.moves.size() ? &visit_.moves[i] : nullptr; };
  const VisitMove* next = move_at(index_ + 1);
  const VisitMove* after = move_at(index_ + 2);
  const bool grasps = next != nullptr && next->kind == VisitMove::Kind::grasp;
  if (!grasps) {
    p_HG_ = kIndexTip_H;
    if (config_.side == client::HandSide::left) p_HG_.z() = -p_HG_.z();
    X_WH_goal_.R = across(Vec3::UnitX());
    joints_goal_ = kPointing;
  } else if (after != nullptr && after->joint) {
    const state::JointDescription& joint = description_.joints[after->joint.index()];
    p_HG_ = kGrip_H;
    X_WH_goal_.R = across(frame_of(joint).rotate(Vec3::UnitZ()));
    joints_goal_ = kOpen;
  } else {
    p_HG_.setZero();
    X_WH_goal_.R.setIdentity();
    joints_goal_ = kOpen;
    if (taken_from_side(X_WB)) return true;
    over_m_ = kOverM;
  }
  return false;
}

/// Whether the centre of mass of what the hand reaches for is over its grip: a person takes it from the side then.
bool VisitPlayer::taken_from_side(std::span<const Pose> X_WB) const {
  constexpr double kOverGripM = 0.05;
  const VisitMove& reach = visit_.moves[index_];
  const Vec3 p_BCm = description_.bodies[reach.body.index()].p_BCm;
  return X_WB[reach.body.index()].rotate(p_BCm - reach.p_BG).y() > kOverGripM;
}

/// Fingers close around a held thing without pushing it.
void VisitPlayer::bend_fingers(bool holding) {
  if (config_.kind != client::HandKind::glove || !config_.shapes_hand) return;
  const HandJoints& goal = intent_.grasp_intent > 0 && holding ? kClosed
                           : intent_.grasp_intent > 0          ? intent_.joints
                                                               : joints_goal_;
  const double share = std::min(last_dt_s_ / kClosesInS, 1.0);
  for (std::size_t i = 0; i < goal.size(); ++i)
    intent_.joints[i] += share * (goal[i] - intent_.joints[i]);
}

bool VisitPlayer::grasps_next() const {
  return index_ + 1 < visit_.moves.size() && visit_.moves[index_ + 1].kind == VisitMove::Kind::grasp;
}

/// A hand may still touch what it has just lost, so it gets time to open first.
bool VisitPlayer::touched_what_it_reaches_for(std::span<const Pose> X_WB, double felt_n) const {
  return grasps_next() && time_s_ >= kClosesInS && felt_n > kTouchN && to_grip_m(X_WB) < kNearGripM;
}

/// A loose thing moves when it is touched: the hand follows its grip slowly.
void VisitPlayer::follow_grip(std::span<const Pose> X_WB) {
  const Vec3 to_grip = grip_W(X_WB) - intent_.X_WH * p_HG_;
  const double step_m = kFollowMPerS * last_dt_s_;
  intent_.X_WH.p += to_grip.norm() > step_m ? Vec3(to_grip.normalized() * step_m) : to_grip;
}

/// Whether a stylus presses against a thing that it tries to take. A whole hand goes on until its fingers are around the thing.
bool VisitPlayer::presses(const HandSense& hand) const {
  return config_.kind == client::HandKind::one_point && hand.f_W.norm() > kPressesN;
}

/// It stops pressing: what it intends becomes where it is.
void VisitPlayer::stay_at(const Vec3& p_WH, const HandSense& hand) {
  if (hand.f_W.isZero(0)) return;  // it feels no reason to
  intent_.X_WH.p += std::min(last_dt_s_ / kRelaxesInS, 1.0) * (p_WH - intent_.X_WH.p);
}

bool VisitPlayer::continue_move(std::span<const Pose> X_WB, const HandSense& hand) {
  const VisitMove& move = visit_.moves[index_];
  switch (move.kind) {
    case VisitMove::Kind::reach:
      move_hand_towards_goal();
      if (touched_what_it_reaches_for(X_WB, hand.felt_n)) return true;
      return time_s_ >= duration_s_ && !reaches_again(X_WB);
    case VisitMove::Kind::move_to:
      move_hand_towards_goal();
      // Placed early: the snap released it, not the hand.
      ok_ = ok_ && (hand.holding || time_s_ > 0.8 * duration_s_);
      return time_s_ >= duration_s_;
    case VisitMove::Kind::grasp:
      ok_ = hand.holding;
      note_grasp(X_WB, hand.felt_n);
      if (hand.holding)
        stay_at(p_WH_caught_, hand);
      else if (presses(hand))
        stay_at(hand.p_WH, hand);
      else
        follow_grip(X_WB);
      return time_s_ >= (hand.holding ? move.duration_s : std::max(move.duration_s, config_.grasp_patience_s));
    case VisitMove::Kind::turn:
      ok_ = ok_ && hand.holding;
      return turn(move, hand);
    case VisitMove::Kind::swing:
      ok_ = ok_ && hand.holding;
      return swing(move, hand);
    case VisitMove::Kind::release:
      if (!hand.holding) stay_at(hand.p_WH, hand);
      break;
    case VisitMove::Kind::wait:
      break;
  }
  return time_s_ >= move.duration_s;
}

/// Whether the thing is no longer where it was when the hand began to reach for it; then the move begins anew.
bool VisitPlayer::reaches_again(std::span<const Pose> X_WB) {
  if (!grasps_next() || (grip_W(X_WB) - p_WG_reached_).norm() < kMovedOnM || reached_again_ >= kReachesAgain)
    return false;
  ++reached_again_;
  begun_ = false;
  return true;
}

void VisitPlayer::move_hand_towards_goal() {
  const double share = duration_s_ > 0 ? time_s_ / duration_s_ : 1.0;
  const double s = over_m_ > 0 ? minimum_jerk(share / kOverAfter) : minimum_jerk(share);
  intent_.X_WH.p = X_WH_start_.p + s * (X_WH_goal_.p - X_WH_start_.p);
  intent_.X_WH.R = X_WH_start_.R.slerp(s, X_WH_goal_.R);
  if (over_m_ <= 0) return;
  // Up first, then over the thing, then down.
  const double rises_m = X_WH_goal_.p.y() + over_m_ - X_WH_start_.p.y();
  intent_.X_WH.p.y() = X_WH_start_.p.y() + minimum_jerk(share / kUpAfter) * rises_m -
                       minimum_jerk((share - kDownFrom) / (1 - kDownFrom)) * over_m_;
}

bool VisitPlayer::turn(const VisitMove& move, const HandSense& hand) {
  const double whole_rad = std::max(2 * kPi * std::abs(move.turns) - done_rad_[index_], 0.0);
  const double gone = go_through(whole_rad, 2 * kPi / 60 * std::abs(move.rate_rpm));
  go_round(move.joint, std::copysign(gone, move.turns), hand);
  return turned_rad_ >= whole_rad;
}

/// Back and forth as a sine; its phase starts where the lever stands and runs through all cycles.
bool VisitPlayer::swing(const VisitMove& move, const HandSense& hand) {
  const double whole_rad = std::max(2 * kPi * move.cycles - done_rad_[index_], 0.0);
  const double phase = std::asin(std::clamp(swing_from_rad_ / move.amplitude_rad, -1.0, 1.0));
  const double gone = go_through(whole_rad, 2 * kPi / 60 * move.cycles_per_min);
  go_round(move.joint, move.amplitude_rad * (std::sin(phase + gone) - std::sin(phase)), hand);
  return turned_rad_ >= whole_rad;
}

double VisitPlayer::go_through(double whole_rad, double rate_rad_per_s) {
  const double left = whole_rad - turned_rad_;
  const double speed =
      std::min({rate_rad_per_s, kTurnRampRadPerS2 * time_s_, std::sqrt(2 * kTurnRampRadPerS2 * std::max(left, 0.0))});
  turned_rad_ += std::max(speed, 0.01) * last_dt_s_;
  return std::min(turned_rad_, whole_rad);
}

/// The joint's frame in the world, with the body that bears it where it began.
Pose VisitPlayer::frame_of(const state::JointDescription& joint) const {
  return description_.bodies[joint.body1.index()].X_WB * joint.X_B1J;
}

/// The hand goes around the joint's axis with the handle in the place where it feels it; the wrist keeps its direction, and the handle
/// turns in the hand. How far from the axis, and where along it, the handle that it holds tells by its force.
void VisitPlayer::go_round(JointId id, double angle_rad, const HandSense& hand) {
  const Pose X_WJ = frame_of(description_.joints[id.index()]);
  if (hand.holding) {
    const Vec3 grip_J = X_WJ.inverse() * Vec3(hand.p_WH + p_HG_W_);
    const Vec3 gives_way_J = kGivesWayMPerNs * last_dt_s_ * X_WJ.inverse().rotate(hand.f_W);
    arm_J_.head<2>() += gives_way_J.head<2>().dot(grip_J.head<2>().normalized()) * arm_J_.head<2>().normalized();
    arm_J_.z() += gives_way_J.z();
  }
  intent_.X_WH.p = X_WJ * Vec3(Eigen::AngleAxisd(angle_rad, Vec3::UnitZ()) * arm_J_) - p_HG_W_;
}

void VisitPlayer::note_grasp(std::span<const Pose> X_WB, double felt_n) {
  const Vec3 to_grip = X_WB[grasp_.body.index()] * p_BG_ - intent_.X_WH * p_HG_;
  grasp_.nearest_m = std::min(grasp_.nearest_m, to_grip.norm());
  grasp_.touched = grasp_.touched || felt_n > kTouchN;
}

void VisitPlayer::note_grip(std::span<const Pose> X_WB, const HandSense& hand) {
  const VisitMove& move = visit_.moves[index_];
  if (move.joint) {
    const double angle_rad = joint_angle(description_.joints[move.joint.index()], X_WB);
    seen_rad_ += std::remainder(angle_rad - seen_at_rad_, 2 * kPi);
    seen_at_rad_ = angle_rad;
  }
  if (hand.holding && !held_) p_WH_caught_ = hand.p_WH;
  held_ = held_ || hand.holding;
  if (hand.holding) held_rad_ = turned_rad_;
  empty_s_ = hand.holding ? 0 : empty_s_ + last_dt_s_;
}

/// Whether the hand has lost the handle that it had at the start of this turn or swing, or caught during it.
bool VisitPlayer::lost_its_handle() const {
  const VisitMove::Kind kind = visit_.moves[index_].kind;
  const bool works = kind == VisitMove::Kind::turn || kind == VisitMove::Kind::swing;
  return works && held_ && empty_s_ > kNoticesLossS && visit_.moves[last_reach_].kind == VisitMove::Kind::reach;
}

/// Whether the carried thing was lost, or something else is in the hand. One that a snap took out of the hand was not lost: it is where it
/// should be.
bool VisitPlayer::slipped(std::span<const Pose> X_WB, bool holding) const {
  const VisitMove& move = visit_.moves[index_];
  const bool it_comes = holding && waited_s_ <= kPatienceS;
  if (move.kind != VisitMove::Kind::move_to || it_comes) return false;
  const VisitMove& reach = visit_.moves[last_reach_];
  if (reach.kind != VisitMove::Kind::reach || reach.body != move.body) return false;
  return (X_WB[move.body.index()].p - move.X_WB.p).norm() > kSlippedM;
}

void VisitPlayer::fetch_again() {
  ++fetched_again_;
  index_ = last_reach_;
  intent_.grasp_intent = 0;
}

void VisitPlayer::try_step_again() {
  index_ = reach_before(visit_, step_move_);
  std::fill(done_rad_.begin() + static_cast<std::ptrdiff_t>(index_), done_rad_.end(), 0.0);
  fetched_again_ = 0;
  begun_ = false;
  intent_.grasp_intent = 0;
}

void VisitPlayer::end_move(bool again) {
  const VisitMove& move = visit_.moves[index_];
  done_rad_[index_] +=
      again && move.kind == VisitMove::Kind::turn ? std::max(std::copysign(1, move.turns) * seen_rad_, 0.0) : held_rad_;
  results_.push_back({name_of(description_, move), time_s_, ok_});
  if (!ok_ && move.kind == VisitMove::Kind::grasp) results_.back().failed_grasp = grasp_;
  ++index_;
  begun_ = false;
}

}  // namespace mechane::visitor
