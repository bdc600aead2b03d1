#include "client-sdk/haptic/tracked_hand.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "client-sdk/drivers/joints/hand_geometry.hpp"
#include "client-sdk/haptic/driver_link.hpp"
#include "client-sdk/haptic/seen_hand.hpp"

namespace mechane::haptic {
namespace {

constexpr Duration kPicture = std::chrono::microseconds(16'667);
constexpr double kNoise_m = 0.0003;  // standard deviation of each coordinate

}  // namespace

client::HandSample TrackedHand::read(Duration dt) noexcept {
  until_picture_ -= dt;
  if (until_picture_ <= Duration{0}) {
    until_picture_ = kPicture + until_picture_ % kPicture;  // none is taken twice after a pause
    take_picture();
  }
  return told_;
}

hand::GovernorConfig TrackedHand::limits() const {
  hand::GovernorConfig none;
  none.max_force_n = none.max_torque_nm = none.max_finger_force_n = 0;
  return none;
}

void TrackedHand::take_picture() {
  drivers::HandDatagram seen;
  seen.tracked = true;
  // The tracker's own measure: the scripted visitor's fingers close only around what they hold.
  seen.pinch = intent_.grasp_intent;
  SeenHand real;
  real.joints_rad = intent_.joints;
  real.X_DH = intent_.X_WH;
  real.build.side = side_;
  seen.left = real.left();
  set(seen.points[0], real.in_D(Vec3::Zero()));
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    const auto joints = real.finger_D(f);
    for (std::size_t k = 0; k < joints.size(); ++k)
      set(seen.points[drivers::point_of(f, k)], joints[k]);
  }
  if (pictures_ >= on_the_way_.size()) tell(on_the_way_[pictures_ % on_the_way_.size()]);
  on_the_way_[pictures_++ % on_the_way_.size()] = seen;
}

void TrackedHand::set(drivers::HandPoint& point, const Vec3& p_D) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = p_D[static_cast<Eigen::Index>(axis)] + std::normal_distribution<>(0, kNoise_m)(random_);
}

void TrackedHand::tell(const drivers::HandDatagram& seen) {
  ++since_told_;
  mechane_device_state state{};
  if (*drivers::place_tracked_hand(seen, state) != 0) return;  // as the driver does: the hand stays
  measure_.add(seen.points);
  measure_.tell(state);
  const Pose before = told_.X_WH;
  const auto& q = state.orientation_wxyz;
  told_.kind = client::HandKind::glove;
  static_cast<hand::HandBuild&>(told_) = build_of(side_, state, 1);
  told_.X_WH = {Vec3(state.position_m[0], state.position_m[1], state.position_m[2]), Quat(q[0], q[1], q[2], q[3])};
  std::copy(std::begin(state.joints_rad), std::end(state.joints_rad), told_.joints.begin());
  told_.grasp_intent = state.grasp;
  const double passed_s = to_seconds(kPicture) * std::exchange(since_told_, 0);
  if (!std::exchange(was_told_, true)) return;
  told_.V_WH = mean_twist(before, told_.X_WH, passed_s);
}

}  // namespace mechane::haptic
