#include "client-sdk/visitor/pointer_player.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mechane::visitor {
namespace {

using pointer::PointerEvent;
using pointer::PointerView;
using state::VisitMove;

constexpr picture::PixelSize kScreen{1920, 1080};
constexpr double kNotch = 0.03;         // of the wheel: how much farther it takes a thing, as a share of the distance
constexpr double kPressPatience_s = 4;  // for a hand that reaches
constexpr std::size_t kPresses = 5;     // for one grasp
constexpr int kFetches = 4;             // of what was lost on the way
constexpr double kLongest_s = 120;      // of a move: where the server is gone, nothing ends one
constexpr double kArrives_s = 8;        // patience with a thing that comes after the finger
constexpr double kNotComing_s = 1.5;    // what has not moved for so long will not come to the finger
constexpr double kMoves_m_per_s = 0.02;
constexpr double kUnderFinger = 0.03;  // share of the picture's height: it has come
constexpr double kDepth_m = 0.015;     // a difference of depth that is seen
constexpr double kAskew_rad = 0.3;     // a rotation that is seen
constexpr double kBlocked_s = 4;       // what has not turned for so long will not
constexpr double kAhead_rad = 0.6;     // how far the finger goes before what turns
constexpr double kStill_s = 0.3;       // before a finger is lifted
constexpr double kTouched_m = 0.03;    // a place this near to a surface is on it
constexpr double kSlipped_m = 0.1;     // what is so far from where it was carried is not there
constexpr double kHome_m = 0.01;       // what is so near to its place is in it

double apart(picture::PixelPlace a, picture::PixelPlace b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// A mouse does not leave the screen.
picture::PixelPlace within(picture::PixelPlace place) {
  return {std::clamp(place.x, 0.0, kScreen.width - 1.0), std::clamp(place.y, 0.0, kScreen.height - 1.0)};
}

picture::Sight sight_of(const picture::RenderScene& scene) {
  return picture::seen_place(scene.camera, picture::Stereo::mono, kScreen, {})->sight;
}

}  // namespace

picture::PixelPlace PointerPlayer::Round::at(double angle_rad) const {
  const Eigen::Vector2d way = from_circle * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
  return {middle.x + way.x(), middle.y + way.y()};
}

/// Of the circle about an axle; a flat one gets at least this share of its width.
std::optional<PointerPlayer::Round> PointerPlayer::round_of(const picture::Sight& sight,
                                                            const pointer::AffordanceLine& axle, const Vec3& p_WH,
                                                            double least_round) {
  const Vec3 arm_W = p_WH - axle.p_W;
  const Vec3 middle_W = axle.p_W + arm_W.dot(axle.a_W) * axle.a_W;
  const auto middle = pixel_of(sight, middle_W);
  const auto one = pixel_of(sight, p_WH);
  const auto other = pixel_of(sight, middle_W + axle.a_W.cross(arm_W));
  if (!middle || !one || !other) return {};
  Eigen::Matrix2d seen;
  seen << one->x - middle->x, other->x - middle->x, one->y - middle->y, other->y - middle->y;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(seen, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector2d half_axes = svd.singularValues();
  half_axes.y() = std::max(half_axes.y(), least_round * half_axes.x());
  return Round{*middle, svd.matrixU() * half_axes.asDiagonal() * svd.matrixV().transpose()};
}

PointerPlayer::PointerPlayer(ShownExhibit& shown, const state::WorldDescription& description,
                             const state::VisitDescription& visit, std::unique_ptr<pointer::PointerTouch> hand)
    : shown_(shown),
      description_(description),
      visit_(visit),
      hand_(*hand),
      input_(std::move(hand)),
      done_rad_(visit.moves.size()),
      at_{kScreen.width / 2.0, kScreen.height / 2.0} {}

bool PointerPlayer::holds() {
  return hand_.view().phase == PointerView::Phase::holding && seen_->holding;
}

void PointerPlayer::look(const PointerSight& seen) {
  if (finished()) return;
  seen_ = &seen;
  if (!std::exchange(begun_, true)) begin();
  time_s_ += kPicture_s;
  const bool stuck = time_s_ > kLongest_s;
  if (!go_on() && !stuck) return;
  ok_ = ok_ && !stuck;
  const bool again = lost() && fetched_ < kFetches;
  results_.push_back({name_of(description_, move()), time_s_, ok_ && !again});
  done_rad_[index_] += std::abs(seen_rad_);
  begun_ = false;
  ++index_;
  if (!again) return;
  ++fetched_;
  index_ = last_reach_;
  say(PointerEvent::Kind::release);
}

void PointerPlayer::try_step_again() {
  index_ = reach_before(visit_, step_move_);
  std::fill(done_rad_.begin() + static_cast<std::ptrdiff_t>(index_), done_rad_.end(), 0.0);
  fetched_ = 0;
  begun_ = false;
}

void PointerPlayer::begin() {
  time_s_ = since_s_ = still_s_ = seen_rad_ = finger_rad_ = gone_rad_ = rolled_ = 0;
  ok_ = true;
  presses_ = 0;
  pressed_ = false;
  from_ = at_;
  const PointerView view = hand_.view();
  if (move().kind == VisitMove::Kind::reach) {
    if (index_ != last_reach_) fetched_ = 0;
    last_reach_ = index_;
    if (!takes()) touch();
  } else if (move().kind == VisitMove::Kind::move_to && holds()) {
    p_WG_goal_ = move().X_WB * (pose_of(move().body).inverse() * view.p_WH);
    from_depth_m_ = depth_of(sight(), view.p_WH);
    to_ = within(pixel_of(sight(), p_WG_goal_).value_or(at_));
  } else if (move().joint) {
    seen_at_rad_ = swing_from_rad_ = joint_angle(joint(), seen_->X_WB);
    round_ = holds() ? way_round() : std::nullopt;
  }
}

bool PointerPlayer::go_on() {
  switch (move().kind) {
    case VisitMove::Kind::reach:
      return takes() || time_s_ >= move().duration_s;
    case VisitMove::Kind::grasp:
      return take();
    case VisitMove::Kind::move_to:
      return carry();
    case VisitMove::Kind::turn:
    case VisitMove::Kind::swing:
      return work();
    case VisitMove::Kind::release:
      if (!pressed_ && time_s_ >= kStill_s) say(PointerEvent::Kind::release), pressed_ = true;
      return pressed_ && resting() && time_s_ >= move().duration_s;
    case VisitMove::Kind::wait:
      break;
  }
  return time_s_ >= move().duration_s;
}

bool PointerPlayer::takes() const {
  return index_ + 1 < visit_.moves.size() && visit_.moves[index_ + 1].kind == VisitMove::Kind::grasp;
}

Vec3 PointerPlayer::grip_W() const {
  const VisitMove& reach = visit_.moves[last_reach_];
  return pose_of(reach.body) * reach.p_BG;
}

/// A click, if the place is seen on a surface; in the air a pointer touches nothing.
void PointerPlayer::touch() {
  const picture::RenderScene scene = shown_.scene(seen_->frame);
  const auto at = pixel_of(sight_of(scene), grip_W());
  const auto seen = at ? picture::picked_at(scene, shown_.assets(), sight_of(scene), *at) : std::nullopt;
  if (!seen || !seen->object || (seen->p_WT - grip_W()).norm() > kTouched_m) return;
  at_ = *at;
  say(PointerEvent::Kind::press);
  say(PointerEvent::Kind::release);
  click_ = *seen->object;
}

bool PointerPlayer::take() {
  since_s_ += kPicture_s;
  if (holds()) return time_s_ >= move().duration_s;
  if (pressed_ && since_s_ < kPressPatience_s && !resting()) return false;
  pressed_ = false;
  say(PointerEvent::Kind::release);
  if (!resting()) return false;
  const auto place = place_to_press(presses_++);
  ok_ = place && presses_ <= kPresses;
  if (!ok_) return true;
  at_ = *place;
  pressed_ = true;
  since_s_ = 0;
  say(PointerEvent::Kind::press);
  return false;
}

/// Where the body is seen, the nearest to its grip first.
std::optional<picture::PixelPlace> PointerPlayer::place_to_press(std::size_t which) {
  constexpr int kRound = 12;
  const picture::RenderScene scene = shown_.scene(seen_->frame);
  const auto grip = pixel_of(sight(), grip_W());
  const auto body = static_cast<std::uint32_t>(move().body.index());
  if (!grip || !under_mouse(scene).takeable(body)) return {};
  std::vector<std::pair<double, picture::PixelPlace>> places;
  for (const double share : {0.0, 0.008, 0.016, 0.03, 0.05, 0.08, 0.12}) {
    for (int k = 0; k < kRound; ++k) {
      const double angle = 2 * kPi * k / kRound;
      const double radius = share * kScreen.height;
      const picture::PixelPlace near{grip->x + radius * std::cos(angle), grip->y + radius * std::sin(angle)};
      const auto seen = picture::picked_at(scene, shown_.assets(), sight(), near);
      if (seen && seen->object == body && apart(near, within(near)) == 0)
        places.emplace_back((seen->p_WT - grip_W()).norm(), near);
      if (share == 0) break;
    }
  }
  if (places.empty()) return which == 0 ? grip : std::nullopt;  // thin: a finger is broad
  std::ranges::sort(places, {}, &std::pair<double, picture::PixelPlace>::first);
  return places[std::min(which * places.size() / kPresses, places.size() - 1)].second;
}

bool PointerPlayer::carry() {
  if (!holds()) {
    since_s_ += kPicture_s;
    ok_ = !lost();
    const bool waits = !resting() && since_s_ < kPressPatience_s;  // for a hand that fetches it again
    return !waits && time_s_ >= move().duration_s;
  }
  const double s = minimum_jerk(time_s_ / move().duration_s);
  go_to({from_.x + s * (to_.x - from_.x), from_.y + s * (to_.y - from_.y)});
  const double wanted = s * std::log(depth_of(sight(), p_WG_goal_) / from_depth_m_);
  if (time_s_ <= move().duration_s) roll(wanted - rolled_);
  rolled_ = wanted;
  if (time_s_ <= move().duration_s) return false;
  return arrives() || still_s_ > kNotComing_s || time_s_ > move().duration_s + kArrives_s;
}

/// Looks whether the hand has come to its goal, and mends the depth that is seen.
bool PointerPlayer::arrives() {
  const PointerView view = hand_.view();
  const auto seen = pixel_of(sight(), view.p_WH);
  const bool under = seen && apart(*seen, at_) < kUnderFinger * kScreen.height;
  const double goal_m = depth_of(sight(), p_WG_goal_), is_m = depth_of(sight(), view.p_WH);
  const bool deep = view.drag != PointerView::Drag::carry || std::abs(goal_m - is_m) < kDepth_m;
  since_s_ += kPicture_s;
  if (!deep && since_s_ > kStill_s) {
    roll(std::log(goal_m / is_m));
    since_s_ = 0;
  }
  still_s_ = (view.p_WH - p_WH_seen_).norm() > kMoves_m_per_s * kPicture_s ? 0 : still_s_ + kPicture_s;
  p_WH_seen_ = view.p_WH;
  const Quat R_lies = pose_of(move().body).R * move().X_WB.R.conjugate();
  return under && deep && rotation_vector(R_lies).norm() < kAskew_rad;
}

bool PointerPlayer::work() {
  const double angle_rad = joint_angle(joint(), seen_->X_WB);
  const double turned_rad = std::remainder(angle_rad - seen_at_rad_, 2 * kPi);
  seen_at_rad_ = angle_rad;
  seen_rad_ += turned_rad;
  since_s_ = std::abs(turned_rad) > 1e-4 ? 0 : since_s_ + kPicture_s;
  ok_ = ok_ && !lacks();
  if (!round_ || since_s_ > kBlocked_s || resting()) return true;
  const bool over = move().kind == VisitMove::Kind::turn ? turn() : swing();
  go_to(round_->at(finger_rad_));
  return over;
}

/// As the hand turns what it holds; where it carries a thing that is fixed to what turns, the way that this really goes.
std::optional<PointerPlayer::Round> PointerPlayer::way_round() {
  constexpr double kLeastRound = 0.4;  // as PointerHand
  const PointerView view = hand_.view();
  if (view.drag == PointerView::Drag::turn) return round_of(sight(), view.axle, view.p_WH, kLeastRound);
  const Pose X_WJ = pose_of(joint().body1) * joint().X_B1J;
  return round_of(sight(), {X_WJ.p, X_WJ.rotate(Vec3::UnitZ())}, view.p_WH, 0);
}

bool PointerPlayer::turn() {
  const double way = std::copysign(1, move().turns);
  const double whole_rad = std::max(2 * kPi * std::abs(move().turns) - done_rad_[index_], 0.0);
  const double step_rad = 2 * kPi / 60 * move().rate_rpm * kPicture_s;
  finger_rad_ = way * std::min(way * finger_rad_ + step_rad, std::min(way * seen_rad_, whole_rad) + kAhead_rad);
  return way * seen_rad_ >= whole_rad;
}

bool PointerPlayer::swing() {
  const double phase = std::asin(std::clamp(swing_from_rad_ / move().amplitude_rad, -1.0, 1.0));
  const double whole_rad = 2 * kPi * move().cycles;
  const bool lags = std::abs(finger_rad_ - seen_rad_) > std::abs(move().amplitude_rad);
  if (!lags) gone_rad_ += 2 * kPi / 60 * move().cycles_per_min * kPicture_s;
  finger_rad_ = move().amplitude_rad * (std::sin(phase + std::min(gone_rad_, whole_rad)) - std::sin(phase));
  return gone_rad_ >= whole_rad;
}

/// Whether the hand lacks a thing that it could have: one that its place or a step has taken is not lost.
bool PointerPlayer::lacks() {
  const VisitMove& reach = visit_.moves[last_reach_];
  if (holds() || reach.kind != VisitMove::Kind::reach) return false;
  const auto body = static_cast<std::uint32_t>(reach.body.index());
  const pointer::PointerScene scene = under_mouse(scene_);
  return scene.takeable(body) && std::ranges::none_of(scene.leeway(body).goals, [&](const auto& goal) {
           return goal.turns_too && (goal.X_WB.p - seen_->X_WB[body].p).norm() < kHome_m;
         });
}

/// Whether what was carried or worked is in the hand no more, and not where it should be.
bool PointerPlayer::lost() {
  if (!lacks()) return false;
  return move().joint || (move().kind == VisitMove::Kind::move_to && visit_.moves[last_reach_].body == move().body &&
                          (pose_of(move().body).p - move().X_WB.p).norm() > kSlipped_m);
}

/// The display's camera stands still.
const picture::Sight& PointerPlayer::sight() {
  if (!sight_) sight_ = sight_of(shown_.scene(seen_->frame));
  return *sight_;
}

pointer::PointerScene PointerPlayer::under_mouse(const picture::RenderScene& scene) const {
  return {scene,         shown_.assets(),  picture::Stereo::mono, kScreen,
          &seen_->frame, shown_.objects(), &seen_->status,        &shown_.presentation()};
}

void PointerPlayer::say(PointerEvent::Kind kind, double amount) {
  PointerEvent event;
  event.kind = kind;
  event.x = at_.x;
  event.y = at_.y;
  event.amount = amount;
  // Only a press looks at the things.
  if (kind == PointerEvent::Kind::press) scene_ = shown_.scene(seen_->frame);
  input_.take(event, under_mouse(scene_), false);
}

void PointerPlayer::go_to(picture::PixelPlace place) {
  at_ = within(place);
  say(PointerEvent::Kind::move);
}

void PointerPlayer::roll(double deeper) {
  if (hand_.view().drag == PointerView::Drag::carry) say(PointerEvent::Kind::wheel, deeper / kNotch);
}

}  // namespace mechane::visitor
