#include "client-sdk/haptic/virtual_hand.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using client::HandKind;

TEST(VirtualHand, WithoutOptionsIsAPhantomInAHand) {
  const auto choice = read_virtual_options("");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->hand, HandKind::one_point);
  EXPECT_TRUE(choice->stylus.hand);
  EXPECT_EQ(choice->stylus.delay, 0u);
  EXPECT_GE(choice->stylus.mass_kg, 0.05);
  EXPECT_LE(choice->stylus.mass_kg, 0.1);
  EXPECT_LT(choice->stylus.viscous_ns_per_m, 1);
  EXPECT_GT(choice->stylus.resolution_m, 0);
}

TEST(VirtualHand, TakesItsOptions) {
  const auto stylus = read_virtual_options("kind=phantom,delay=20,hand=off,resolution=0.0005,continuous=0.88");
  ASSERT_TRUE(stylus);
  EXPECT_EQ(stylus->hand, HandKind::one_point);
  EXPECT_EQ(stylus->stylus.delay, 20u);
  EXPECT_FALSE(stylus->stylus.hand);
  EXPECT_EQ(stylus->stylus.resolution_m, 0.0005);
  EXPECT_EQ(make_virtual_device(*stylus, Vec3::Zero())->continuous_force_n(), 0.88);
  const auto glove = read_virtual_options("kind=glove");
  ASSERT_TRUE(glove);
  EXPECT_EQ(glove->hand, HandKind::glove);
  EXPECT_FALSE(glove->tracked);
  EXPECT_EQ(glove->side, client::HandSide::right);
  const auto tracked = read_virtual_options("kind=tracked");
  ASSERT_TRUE(tracked);
  EXPECT_EQ(tracked->hand, HandKind::glove);
  EXPECT_TRUE(tracked->tracked);
  for (const char* options : {"kind=glove,hand=left", "kind=tracked,hand=left"}) {
    const auto left = read_virtual_options(options);
    ASSERT_TRUE(left) << options;
    const auto device = make_virtual_device(*left, Vec3::Zero());
    client::HandSample sample;
    for (int ms = 0; ms < 100; ++ms)
      sample = device->read(kTickPeriod);
    EXPECT_EQ(sample.side, client::HandSide::left) << options;
  }
}

TEST(VirtualHand, RefusesWhatItDoesNotKnowAndValuesOutOfRange) {
  for (const char* options : {"kind=pen", "mass=1", "delay=21", "delay=-1", "delay=0.5", "hand=yes", "resolution=0.1",
                              "continuous=4", "resolution=nan", "kind=glove,delay=1", "kind=tracked,hand=off",
                              "kind=phantom,hand=left", "phantom", "kind=phantom,kind=phantom"}) {
    const auto choice = read_virtual_options(options);
    ASSERT_FALSE(choice) << options;
    EXPECT_EQ(choice.error().code, ErrorCode::invalid_value) << options;
    EXPECT_NE(choice.error().where.find(options), std::string::npos) << options;
    EXPECT_FALSE(choice.error().remedy.empty()) << options;
  }
}

TEST(VirtualHand, ADeviceBeginsWhereItIsPutAndIsOfItsKind) {
  const Vec3 p_WH(0.2, 0.7, 0.1);
  for (const HandKind kind : {HandKind::one_point, HandKind::glove}) {
    VirtualChoice choice;
    choice.hand = kind;
    const auto device = make_virtual_device(choice, p_WH);
    device->intend(stroke(kind, p_WH, 0, 2));
    client::HandSample sample;
    for (int i = 0; i < 10; ++i)
      sample = device->read(kTickPeriod);
    EXPECT_EQ(sample.kind, kind);
    EXPECT_LT((sample.X_WH.p - p_WH).norm(), 1e-4) << "it did not fly there";
  }
}

TEST(VirtualHand, ALetGoPhantomMovesByItsForceAlone) {
  VirtualChoice choice;
  choice.stylus.hand.reset();
  const auto device = make_virtual_device(choice, Vec3::Zero());
  device->intend(stroke(HandKind::one_point, Vec3(1, 1, 1), 0.1, 0));
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(device->read(kTickPeriod).X_WH.p, Vec3::Zero());
  hand::HandForce force;
  force.force_W.f.x() = 1;
  device->write(force);
  for (int i = 0; i < 100; ++i)
    (void)device->read(kTickPeriod);
  EXPECT_GT(device->read(kTickPeriod).X_WH.p.x(), 0.01);
}

TEST(VirtualHand, AGloveClosesAndOpensWhileItStrokes) {
  const Vec3 center(0, 1, 0);
  const HandIntent open = stroke(HandKind::glove, center, 0.1, 0), closed = stroke(HandKind::glove, center, 0.1, 2);
  EXPECT_NEAR((open.X_WH.p - closed.X_WH.p).norm(), 0.2, 1e-9);
  EXPECT_EQ(std::ranges::max(open.joints), 0);
  EXPECT_EQ(open.grasp_intent, 0);
  EXPECT_EQ(closed.grasp_intent, 1);
  for (std::size_t joint = 0; joint < closed.joints.size(); ++joint)
    EXPECT_EQ(closed.joints[joint] > 1, joint % hand::kFingerJoints != 0) << joint;
  EXPECT_EQ(stroke(HandKind::one_point, center, 0.1, 2).grasp_intent, 0);
}

}  // namespace
}  // namespace mechane::haptic
