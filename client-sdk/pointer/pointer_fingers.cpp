#include "client-sdk/pointer/pointer_fingers.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/math.hpp"

namespace mechane::pointer {
namespace {

constexpr double kGoneAfter_s = 30;
// Fingers nearer to each other than this share of the picture's height give no reliable angle or distance.
constexpr double kLeastApart = 0.04;
// How far a thing turns when the mouse moves by the picture's height with the right button held.
constexpr double kMouseTurn_rad = kPi;
constexpr double kFarthest_px = 1e6;

bool is_place(const PointerEvent& event) {
  return std::abs(event.x) <= kFarthest_px && std::abs(event.y) <= kFarthest_px;
}

}  // namespace

std::vector<HandRequest> PointerFingers::take(const PointerEvent& event, const HandState& hand) {
  using Kind = PointerEvent::Kind;
  switch (event.kind) {
    case Kind::press:
      return press(event, hand);
    case Kind::release:
      return lift(event.finger);
    case Kind::move:
      return move(event, hand);
    case Kind::turn_press:
    case Kind::turn_release:
      turning_ = event.kind == Kind::turn_press;
      return {};
    case Kind::gone: {
      turning_ = false;
      second_.reset();
      return first_ ? lift(first_->id) : std::vector<HandRequest>{};
    }
    default:
      return {};
  }
}

std::vector<HandRequest> PointerFingers::press(const PointerEvent& event, const HandState& hand) {
  if (!is_place(event)) return {};
  const picture::PixelPlace at{event.x, event.y};
  std::vector<HandRequest> requests;
  // A finger that was never lifted, or whose hand has nothing more to do.
  if (second_ && second_->id == event.finger) second_.reset();
  if (first_ && first_->id == event.finger) requests = lift(event.finger);
  if (first_ && !hand.busy) first_ = second_ = std::nullopt;
  if (!first_) {
    first_ = Finger{event.finger, at, 0};
    hand_ = at;
    requests.push_back({HandRequest::Kind::take, at, 0});
  } else if (!second_ && event.finger != kMouse && first_->id != kMouse) {
    second_ = Finger{event.finger, at, 0};
  }
  return requests;
}

/// The remaining finger continues from where the hand is.
std::vector<HandRequest> PointerFingers::lift(FingerId id) {
  if (second_ && second_->id == id) {
    second_.reset();
    return {};
  }
  if (!first_ || first_->id != id) return {};
  first_ = std::exchange(second_, std::nullopt);
  if (first_) return {};
  return {{HandRequest::Kind::release, {}, 0}};
}

std::vector<HandRequest> PointerFingers::move(const PointerEvent& event, const HandState& hand) {
  if (!is_place(event)) return {};
  const picture::PixelPlace to{event.x, event.y};
  const bool of_second = second_ && second_->id == event.finger;
  if (!of_second && (!first_ || first_->id != event.finger)) return {};
  Finger& moved = of_second ? *second_ : *first_;
  moved.silent_s = 0;
  if (second_ && hand.carries) return move_pair(moved, to, hand);
  const picture::PixelPlace from = std::exchange(moved.at, to);
  if (of_second) return {};
  if (turning_ && moved.id == kMouse) {
    const double turn = kMouseTurn_rad * (to.x - from.x) / std::max(1.0, static_cast<double>(hand.picture.height));
    return {{HandRequest::Kind::twist, {}, turn}};
  }
  return {go_by(to.x - from.x, to.y - from.y)};
}

/// The hand follows the point in the middle of the two fingers. The carried thing turns as they turn, and comes nearer
/// by as much as they move apart.
std::vector<HandRequest> PointerFingers::move_pair(Finger& moved, picture::PixelPlace to, const HandState& hand) {
  const picture::PixelPlace from = moved.at;
  const double x0 = second_->at.x - first_->at.x, y0 = second_->at.y - first_->at.y;
  moved.at = to;
  const double x1 = second_->at.x - first_->at.x, y1 = second_->at.y - first_->at.y;
  std::vector<HandRequest> requests{go_by((to.x - from.x) / 2, (to.y - from.y) / 2)};
  const double least = std::max(1.0, kLeastApart * hand.picture.height);
  const double apart_before = std::hypot(x0, y0), apart = std::hypot(x1, y1);
  if (apart_before < least || apart < least) return requests;
  requests.push_back({HandRequest::Kind::twist, {}, std::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1)});
  requests.push_back({HandRequest::Kind::deepen, {}, std::log(apart_before / apart)});
  return requests;
}

HandRequest PointerFingers::go_by(double dx, double dy) {
  hand_ = {std::clamp(hand_.x + dx, -kFarthest_px, kFarthest_px),
           std::clamp(hand_.y + dy, -kFarthest_px, kFarthest_px)};
  return {HandRequest::Kind::move, hand_, 0};
}

std::vector<HandRequest> PointerFingers::pass(double dt_s) {
  std::vector<HandRequest> requests;
  for (std::optional<Finger>* finger : {&second_, &first_}) {
    if (!*finger || (*finger)->id == kMouse) continue;
    (*finger)->silent_s += std::max(dt_s, 0.0);
    if ((*finger)->silent_s > kGoneAfter_s) requests = lift((*finger)->id);
  }
  return requests;
}

}  // namespace mechane::pointer
