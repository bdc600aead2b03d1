// What a left hand feels: in a mirrored world it is the mirror image of what the right one feels.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "server/collision/superquadric_object.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptics {
namespace {

/// Places, ways and forces in the mirror at z = 0, and what turns: torques and angular speeds.
Vec3 seen_in_mirror(const Vec3& v) {
  return {v.x(), v.y(), -v.z()};
}
Vec3 turning_in_mirror(const Vec3& v) {
  return {-v.x(), -v.y(), v.z()};
}

hand::HandSample seen_in_mirror(hand::HandSample hand) {
  hand.side = hand::HandSide::left;
  hand.X_WH = hand::mirrored(hand.X_WH);
  hand.V_WH = {seen_in_mirror(hand.V_WH.v), turning_in_mirror(hand.V_WH.w)};
  return hand;
}

/// Not round, so that it has another skin in a mirror.
collision::Object pebble() {
  geometry::Superquadric shape;
  shape.a = Vec3(0.06, 0.035, 0.045);
  shape.e1 = 0.7;
  shape.e2 = 0.9;
  return collision::make_superquadric_object(shape, 0.004);
}

/// Under the palm and the fingers of a hand at the origin.
Pose somewhere_below() {
  return {Vec3(*test::between(0.05, 0.15), -0.07, *test::between(-0.04, 0.04)),
          quat_from_rotation_vector(0.5 * test::any_unit())};
}

hand::HandSample any_loose_hand() {
  hand::HandSample hand;
  hand.kind = hand::HandKind::glove;
  hand.hand_scale = *test::between(0.7, 1.3);
  for (double& scale : hand.finger_scale)
    scale = *test::between(0.9, 1.1);
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    test::close_finger(hand, f, *test::between(0, 0.7));
  return hand;
}

/// A right hand in a world and a left hand in its mirror image: what each feels in the same millisecond.
class BothHands {
 public:
  explicit BothHands(const ForceConfig& config)
      : right_(std::make_shared<collision::Object>(pebble()), config),
        left_(std::make_shared<collision::Object>(collision::mirrored(pebble())), config) {
    rest(flat_hand(), 600);  // until the ramp of the visit is over
  }
  /// From free of contact down onto the pebble, which lies somewhere else each time, sliding and turning. False where it ended early: a
  /// touch that begins a tick later on one side, by rounding, has slid less from then on.
  template <class Compare>
  bool press(hand::HandSample hand, const Compare& compare) {
    constexpr int kPress_ms = 100;
    rest(hand, 50);
    const Pose X_WB = somewhere_below();
    right_.place(X_WB);
    left_.place(hand::mirrored(X_WB));
    hand.V_WH = {Vec3(*test::between(-0.1, 0.1), -0.4, *test::between(-0.1, 0.1)), 0.5 * test::any_unit()};
    for (int ms = 0; ms < kPress_ms; ++ms) {
      const double t_s = 0.001 * ms;
      hand.X_WH = {Vec3(0, 0.02, 0) + t_s * hand.V_WH.v, quat_from_rotation_vector(t_s * hand.V_WH.w)};
      feel(hand);
      if (right_.user().anchor_count != left_.user().anchor_count) return false;
      compare(right_.user().output, left_.user().output);
    }
    return true;
  }

 private:
  static hand::HandSample flat_hand() {
    hand::HandSample hand;
    hand.kind = hand::HandKind::glove;
    return hand;
  }
  void rest(hand::HandSample hand, int time_ms) {
    hand.X_WH = {Vec3(0, 2, 0), Quat::Identity()};
    for (int ms = 0; ms < time_ms; ++ms)
      feel(hand);
  }
  void feel(const hand::HandSample& hand) {
    right_.answer(hand);
    left_.answer(seen_in_mirror(hand));
  }

  test::FloorServer right_, left_;
};

/// How far the left hand's force, torque and finger forces are from the mirror image of the right hand's, N and N m.
double from_mirror_image(const hand::HapticOutput& right, const hand::HapticOutput& left) {
  double off = (left.force_W.f - seen_in_mirror(right.force_W.f)).norm();
  off = std::max(off, (left.force_W.t - turning_in_mirror(right.force_W.t)).norm());
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    off = std::max(off, std::abs(left.finger_force_n[f] - right.finger_force_n[f]));
  return off;
}

TEST(LeftHand, FeelsTheMirrorImageOfWhatTheRightHandFeels) {
  constexpr double kOnePoint_n = 0.05;  // a point that is just at the surface may count on one side alone, by rounding
  ForceConfig config;
  config.normals = NormalKind::of_contacts;  // the pad that smooths touches is not the same in a mirror
  // Without that pad, what holds a tip deep behind a wall turns by degrees with each point that lies in the surface.
  config.thin_walls = ThinWalls::let_through;
  BothHands hands(config);
  double most_n = 0, most_finger_n = 0;
  int whole = 0;
  EXPECT_TRUE(rc::check([&] {
    whole += hands.press(any_loose_hand(), [&](const hand::HapticOutput& right, const hand::HapticOutput& left) {
      RC_ASSERT(from_mirror_image(right, left) < kOnePoint_n);
      most_n = std::max(most_n, right.force_W.f.norm());
      most_finger_n = std::max(most_finger_n, *std::ranges::max_element(right.finger_force_n));
    });
  }));
  EXPECT_GT(whole, 50);
  EXPECT_GT(most_n, 2);
  EXPECT_GT(most_finger_n, 0.2);
}

}  // namespace
}  // namespace mechane::haptics
