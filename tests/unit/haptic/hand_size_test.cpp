// From what a tracker sees of a person's hand to where the server touches with it.
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "client-sdk/drivers/joints/hand_geometry.hpp"
#include "client-sdk/drivers/joints/hand_measure.hpp"
#include "client-sdk/haptic/driver_link.hpp"
#include "client-sdk/haptic/seen_hand.hpp"
#include "server/haptics/hand_model.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptic {
namespace {

constexpr double kDegree = kPi / 180;

const haptics::HandModel& model() {
  static const haptics::HandModel kModel = *haptics::HandModel::create({});
  return kModel;
}

/// A person's hand, nearly flat: no two phalanges of it are in the model's proportions.
SeenHand any_person(double least_hand, double most_hand, double least_finger, double most_finger) {
  SeenHand hand;
  hand.X_DH = {Vec3(0.1, 0.9, -0.3), Quat(Eigen::AngleAxisd(*test::between(-kPi, kPi), test::any_unit()))};
  hand.build.side = *rc::gen::element(hand::HandSide::right, hand::HandSide::left);
  hand.build.hand_scale = *test::between(least_hand, most_hand);
  for (double& scale : hand.build.finger_scale)
    scale = *test::between(least_finger, most_finger);
  for (hand::FingerSize& finger : hand.sizes)
    for (double& length : finger.length_m)
      length *= *test::between(0.975, 1.025);
  hand.joints_rad.fill(5 * kDegree);
  return hand;
}

void bend(SeenHand& hand) {
  for (std::size_t j = 0; j < hand.joints_rad.size(); ++j)
    hand.joints_rad[j] =
        j % hand::kFingerJoints == 0 ? *test::between(-15 * kDegree, 15 * kDegree) : *test::between(0, 70 * kDegree);
}

/// With joints some tenths of a millimetre off.
drivers::HandDatagram seen(const SeenHand& hand, std::mt19937& random) {
  drivers::HandDatagram datagram;
  datagram.left = hand.left();
  const auto see = [&](drivers::HandPoint& point, const Vec3& p_D) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = p_D[static_cast<Eigen::Index>(axis)] + std::normal_distribution<>(0, 0.0003)(random);
  };
  see(datagram.points[0], hand.in_D(Vec3::Zero()));
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    for (std::size_t k = 0; k < drivers::kJointsOfFinger; ++k)
      see(datagram.points[drivers::point_of(f, k)], hand.finger_D(f)[k]);
  return datagram;
}

/// How far the tip that the server touches with is from where the tracker saw it, of the worst finger. `measured`: with the person's sizes.
double worst_tip_m(SeenHand person, bool measured) {
  std::mt19937 random(7);
  drivers::HandMeasure measure;
  for (int picture = 0; picture < 30; ++picture)
    measure.add(seen(person, random).points);
  bend(person);
  mechane_device_state state{};
  RC_ASSERT(std::string(drivers::place_tracked_hand(seen(person, random), state)) == "");
  if (measured) measure.tell(state);
  client::HandSample sample;
  sample.kind = client::HandKind::glove;
  static_cast<hand::HandBuild&>(sample) = build_of(person.build.side, state, 1);
  std::copy(std::begin(state.joints_rad), std::end(state.joints_rad), sample.joints.begin());
  const auto& q = state.orientation_wxyz;
  std::array<Pose, hand::kHandSegments> X_DS;
  model().place(sample,
                {Vec3(state.position_m[0], state.position_m[1], state.position_m[2]), Quat(q[0], q[1], q[2], q[3])},
                X_DS);
  double worst_m = 0;
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    const std::size_t tip = hand::first_segment(f) + hand::kPhalanges - 1;
    // The shape ends half a radius of flesh beyond the bone.
    const geometry::Superquadric& shape = model().segment(sample, tip).parts[0].superquadric;
    const Vec3 end = X_DS[tip] * Vec3(shape.a.x() - 0.5 * shape.a.y(), 0, 0);
    worst_m = std::max(worst_m, (end - person.finger_D(f)[3]).norm());
  }
  return worst_m;
}

TEST(HandSizes, TipsAreWhereTheTrackerSawThem) {
  EXPECT_TRUE(rc::check([] { RC_ASSERT(worst_tip_m(any_person(0.6, 1.2, 0.85, 1.15), true) < 0.003); }));
}

TEST(HandSizes, TheyWouldNotBeWithoutAMeasureOfAChildOrOfLongFingers) {
  EXPECT_TRUE(rc::check([] {
    RC_ASSERT(worst_tip_m(any_person(0.6, 0.8, 0.9, 1.1), false) > 0.01);
    RC_ASSERT(worst_tip_m(any_person(1, 1, 1.12, 1.2), false) > 0.003);
  }));
}

}  // namespace
}  // namespace mechane::haptic
