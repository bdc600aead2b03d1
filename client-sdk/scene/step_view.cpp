#include "client-sdk/scene/step_view.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::scene {
namespace {

// What a window must contain lies within these shares of its half height from its middle: captions cover what is below,
// gauges and the inset what is beside it.
constexpr double kAbove = 0.90;
constexpr double kBelow = 0.34;
constexpr double kAside = 0.50;  // of its half width
// The window is changed when it is too small, or larger than needed by more than the first factor. It is then made larger
// than needed by the second one.
constexpr double kLarger = 1.2;
constexpr double kRoomy = 1.03;
// A side of the place of work is still used while hands come as near to it, compared with the whole place.
constexpr double kNear = 0.1;
// It grows by so much more than it must, so that a next round that goes a hair further moves nothing.
constexpr double kSlack = 0.02;
// So near to where it goes, it is there, to the bit: a display without a graphics card draws what stands still once.
constexpr double kArrived = 0.0003;
// What lies nearer or farther by no more than this share leaves the screen's plane where it is.
constexpr double kSameDepth = 0.15;

void approach(double& value, double to, double s) {
  value = std::abs(to - value) < kArrived ? to : value + s * (to - value);
}

/// The value nearest to `value` for which [low, high] lies between value - below and value + above.
double containing(double value, double low, double high, double below, double above) {
  return std::clamp(value, std::min(high - above, low + below), std::max(high - above, low + below));
}

}  // namespace

StepView::Part StepView::part_for(const picture::Camera& usual, double aspect) const {
  Part part = wanted_;
  const double whole = picture::whole_window(usual, aspect).half_height;
  const double least = std::max({kLeastHalf_m / part.depth_m, worked_.sizes().y() / (kAbove + kBelow),
                                 worked_.sizes().x() / (2 * kAside * aspect)});
  const double needed = std::min(least / whole, 1.0);
  if (part.share < needed || part.share > kLarger * needed) part.share = std::min(kRoomy * needed, 1.0);
  const double half = part.share * whole;
  part.x = containing(part.x, worked_.min().x(), worked_.max().x(), kAside * aspect * half, kAside * aspect * half);
  part.y = containing(part.y, worked_.min().y(), worked_.max().y(), kBelow * half, kAbove * half);
  // What the usual view does not show may come under captions and gauges, but not where hands work.
  const double most_x = aspect * (whole - kAside * half);
  part.x = std::clamp(part.x, -most_x, most_x);
  part.y = std::clamp(part.y, kBelow * half - whole, whole - half);
  return part;
}

/// Remembers for some seconds where hands have worked, so that the view rests while one goes round and round.
void StepView::remember(const Eigen::AlignedBox2d& seen, double passed_s) {
  if (worked_.isEmpty()) worked_ = seen;
  const double s = 1 - std::exp(-passed_s / kForgets_s);
  for (int axis = 0; axis < 2; ++axis) {
    const double size = worked_.max()[axis] - worked_.min()[axis];
    const auto side = [&](double& value, double& since_s, double now, double outwards) {
      const double beyond = outwards * (now - value);
      since_s = beyond >= -kNear * size ? 0 : since_s + passed_s;
      if (beyond > 0) value = now + outwards * kSlack * size;
      if (since_s > kRemembers_s) value += s * (now - value);
    };
    side(worked_.min()[axis], lower_since_s_[axis], seen.min()[axis], -1);
    side(worked_.max()[axis], upper_since_s_[axis], seen.max()[axis], 1);
  }
}

void StepView::Part::approach(const Part& other, double s) {
  scene::approach(x, other.x, s);
  scene::approach(y, other.y, s);
  scene::approach(share, other.share, s);
  scene::approach(depth_m, other.depth_m, s);
}

void StepView::follow(const Eigen::AlignedBox3d& work_W, const picture::Camera& usual, double aspect, TimePoint now) {
  const bool first = !seen_ || p_WC_ != usual.p_WC;
  const double passed_s = first ? 0 : std::max(to_seconds(now - *seen_), 0.0);
  const double s = first ? 1 : 1 - std::exp(-passed_s / kFollows_s);
  seen_ = now;
  const Vec3 ahead_W = usual.p_WT - usual.p_WC;
  if (first) {
    wanted_ = halfway_ = shown_ = {0, 0, 1, ahead_W.norm()};
    worked_.setEmpty();
  }
  p_WC_ = usual.p_WC;
  const Eigen::AlignedBox2d seen = picture::seen_box(usual, work_W);
  if (seen.isEmpty()) {
    wanted_ = {0, 0, 1, wanted_.depth_m};
    worked_ = seen;
  } else {
    const double depth_m = ahead_W.normalized().dot(work_W.center() - usual.p_WC);
    if (std::abs(depth_m - wanted_.depth_m) > kSameDepth * depth_m) wanted_.depth_m = depth_m;
    remember(seen, passed_s);
    wanted_ = part_for(usual, aspect);
  }
  // Twice, so that it sets out gently, too.
  halfway_.approach(wanted_, s);
  shown_.approach(halfway_, s);
}

picture::Camera StepView::shown(const picture::Camera& usual, double aspect) const {
  if (shown_.share == 1 && shown_.x == 0 && shown_.y == 0) return usual;
  const double half = shown_.share * picture::whole_window(usual, aspect).half_height;
  return picture::narrowed_to(usual, {shown_.x, shown_.y, half}, aspect, shown_.depth_m);
}

}  // namespace mechane::scene
