// From the bytes of a browser in a headset to the samples of a hand. Joints are those of Mechane's own hand in a pose, so that its angles
// are known.
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "client-sdk/gateway/browsers/tracked_message.hpp"
#include "client-sdk/gateway/browsers/tracked_motion.hpp"
#include "client-sdk/haptic/seen_hand.hpp"

namespace mechane::gateway {
namespace {

using namespace std::chrono_literals;
using haptic::SeenHand;

class Bytes {
 public:
  explicit Bytes(std::uint8_t hands) { (*this)(2)(1)(hands)(0); }
  Bytes& operator()(std::uint8_t value) {
    bytes_.push_back(std::byte{value});
    return *this;
  }
  Bytes& f32(double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (int shift = 0; shift < 32; shift += 8)
      (*this)(static_cast<std::uint8_t>(bits >> shift));
    return *this;
  }
  Bytes& point(const Vec3& p) { return f32(p.x()).f32(p.y()).f32(p.z()); }
  /// With joints within the palm, as WebXR has them, halfway between wrist and knuckle.
  Bytes& hand(const SeenHand& seen, double pinch = -1) {
    (*this)(seen.left() ? 1 : 0)(1)(1)(0).f32(pinch).point(seen.in_D(Vec3::Zero()));
    for (std::size_t f = 0; f < hand::kFingers; ++f) {
      const auto joints = seen.finger_D(f);
      if (f > 0) point((seen.in_D(Vec3::Zero()) + joints[0]) / 2);
      for (const Vec3& joint : joints)
        point(joint);
    }
    return *this;
  }
  [[nodiscard]] std::vector<std::byte> get() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

TrackedHand seen_by_browser(const SeenHand& hand, double pinch = -1) {
  const auto hands = parse_tracked_message(Bytes(1).hand(hand, pinch).get());
  EXPECT_TRUE(hands.has_value());
  return hands ? hands->at(0) : TrackedHand{};
}

SeenHand bent_hand(bool left) {
  SeenHand hand;
  hand.build.side = left ? hand::HandSide::left : hand::HandSide::right;
  hand.build.hand_scale = 1.1;
  hand.X_DH = {Vec3(0.3, 1.2, -0.4), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))};
  for (std::size_t j = 0; j < hand::kHandJoints; ++j)
    hand.joints_rad[j] = j % hand::kFingerJoints == 0 ? 0.05 : 0.1 + 0.02 * static_cast<double>(j);
  return hand;
}

class BothSides : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(TrackedHand, BothSides, testing::Bool());

TEST_P(BothSides, AnglesPlaceAndSizeAreRecovered) {
  const SeenHand hand = bent_hand(GetParam());
  TrackedMotion motion;
  const TimePoint now{1s};
  // Straight fingers are measured first; bent ones are not.
  SeenHand flat = hand;
  flat.joints_rad = {};
  motion.take(seen_by_browser(flat), now);
  motion.take(seen_by_browser(hand), now + 11ms);
  const auto sample = motion.at(now + 30ms);
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->kind, hand::HandKind::glove);
  EXPECT_EQ(sample->side, hand.build.side);
  EXPECT_NEAR(sample->hand_scale, 1.1, 0.02);
  EXPECT_NEAR(sample->finger_scale[1], 1, 0.02);
  EXPECT_LT((sample->X_WH.p - hand.X_DH.p).norm(), 1e-5);
  EXPECT_LT(sample->X_WH.R.angularDistance(hand.X_DH.R), 0.02);
  for (std::size_t j = 0; j < hand::kHandJoints; ++j)
    EXPECT_NEAR(sample->joints[j], hand.joints_rad[j], 0.03) << "joint " << j;
}

TEST(TrackedHand, APinchOfTheHeadsetCloses) {
  TrackedMotion motion;
  motion.take(seen_by_browser(bent_hand(false), 1), TimePoint{1s});
  EXPECT_DOUBLE_EQ(motion.at(TimePoint{1s + 20ms})->grasp_intent, 1);
}

TEST(TrackedHand, GoesEvenlyFromPictureToPicture) {
  SeenHand hand = bent_hand(false);
  TrackedMotion motion;
  const TimePoint now{1s};
  const Vec3 p = hand.X_DH.p;
  motion.take(seen_by_browser(hand), now);
  hand.X_DH.p += Vec3(0.01, 0, 0);
  motion.take(seen_by_browser(hand), now + 10ms);
  EXPECT_NEAR(motion.at(now + 10ms)->X_WH.p.x() - p.x(), 0, 1e-6);
  EXPECT_NEAR(motion.at(now + 15ms)->X_WH.p.x() - p.x(), 0.005, 1e-5);
  EXPECT_NEAR(motion.at(now + 15ms)->V_WH.v.x(), 1, 1e-3);
  EXPECT_NEAR(motion.at(now + 25ms)->X_WH.p.x() - p.x(), 0.01, 1e-5);
  EXPECT_EQ(motion.at(now + 25ms)->V_WH.v, Vec3::Zero());
}

TEST(TrackedHand, AJumpIsNotMadeIntoAFastMovement) {
  SeenHand hand = bent_hand(false);
  TrackedMotion motion;
  motion.take(seen_by_browser(hand), TimePoint{1s});
  hand.X_DH.p.x() += 0.5;
  motion.take(seen_by_browser(hand), TimePoint{1s + 10ms});
  EXPECT_NEAR(motion.at(TimePoint{1s + 10ms})->X_WH.p.x(), hand.X_DH.p.x(), 1e-5);
  EXPECT_EQ(motion.at(TimePoint{1s + 10ms})->V_WH.v, Vec3::Zero());
}

TEST(TrackedHand, OneThatIsLostFallsSilent) {
  TrackedMotion motion;
  EXPECT_FALSE(motion.at(TimePoint{1s}).has_value());
  motion.take(seen_by_browser(bent_hand(false)), TimePoint{1s});
  TrackedHand lost;
  for (const auto after : {50ms, 350ms, 550ms})
    motion.take(lost, TimePoint{1s + after});
  EXPECT_TRUE(motion.at(TimePoint{1s + 499ms}).has_value());
  EXPECT_FALSE(motion.at(TimePoint{1s + 501ms}).has_value());
}

TEST(TrackedHand, PointsOfNoHandChangeNothing) {
  TrackedMotion motion;
  TrackedHand wrong;
  wrong.tracked = true;  // all its joints in one place
  motion.take(wrong, TimePoint{1s});
  EXPECT_FALSE(motion.at(TimePoint{1s}).has_value());
}

TEST(TrackedMessage, AControllerIsAPoint) {
  Bytes bytes(1);
  bytes(1)(0)(1)(0).f32(0.75).point({1, 2, 3}).f32(0).f32(0).f32(0).f32(1);
  const auto hands = parse_tracked_message(bytes.get());
  ASSERT_TRUE(hands.has_value());
  TrackedMotion motion;
  motion.take(hands->at(0), TimePoint{1s});
  const auto sample = motion.at(TimePoint{1s});
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->kind, hand::HandKind::one_point);
  EXPECT_EQ(sample->X_WH.p, Vec3(1, 2, 3));
  EXPECT_DOUBLE_EQ(sample->grasp_intent, 0.75);
}

TEST(TrackedMessage, NumbersThatAreNonePlacesAreRefused) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  for (const double bad : {kNone, kInfinite, 101.0}) {
    SeenHand hand = bent_hand(false);
    hand.X_DH.p.y() = bad;
    const auto read = parse_tracked_message(Bytes(1).hand(hand).get());
    ASSERT_FALSE(read.has_value()) << bad;
    EXPECT_EQ(read.error().code, ErrorCode::invalid_value);
  }
  EXPECT_FALSE(parse_tracked_message(Bytes(1).hand(bent_hand(false), kNone).get()).has_value());
  Bytes twisted(1);
  twisted(0)(0)(1)(0).f32(0).point({0, 1, 0}).f32(0).f32(0).f32(0).f32(0.5);
  EXPECT_FALSE(parse_tracked_message(twisted.get()).has_value());
}

TEST(TrackedMessage, TheLengthIsThatOfItsHands) {
  const auto whole = Bytes(2).hand(bent_hand(false)).hand(bent_hand(true)).get();
  ASSERT_TRUE(parse_tracked_message(whole).has_value());
  EXPECT_EQ(whole.size(), 4 + 2 * (8 + 12 * kXrJoints));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(parse_tracked_message(std::span(whole).first(size)).has_value()) << size;
  auto more = whole;
  more.push_back(std::byte{0});
  EXPECT_FALSE(parse_tracked_message(more).has_value());
}

TEST(TrackedMessage, OfTheFormThatThereIs) {
  EXPECT_TRUE(parse_tracked_message(Bytes(0).get())->empty());
  EXPECT_FALSE(parse_tracked_message(Bytes(3).get()).has_value());
  EXPECT_FALSE(parse_tracked_message(Bytes(2).hand(bent_hand(true)).hand(bent_hand(true)).get()).has_value());
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{5}}) {  // type, version, side, kind
    auto bytes = Bytes(1).hand(bent_hand(false)).get();
    bytes[at] = std::byte{9};
    EXPECT_FALSE(parse_tracked_message(bytes).has_value()) << at;
  }
}

}  // namespace
}  // namespace mechane::gateway
