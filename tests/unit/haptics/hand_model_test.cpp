#include "server/haptics/hand_model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/collision/samples.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptics {
namespace {

using hand::HandKind;
using hand::HandSample;

const HandModel& hand() {
  static const HandModel kHand = HandModel::create(HandSize{}).value();
  return kHand;
}

HandSample glove(double flexion) {
  HandSample sample;
  sample.kind = HandKind::glove;
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    for (std::size_t k = 1; k < 4; ++k)
      sample.joints[4 * f + k] = flexion;
  }
  return sample;
}

std::array<Pose, hand::kHandSegments> placed(const HandSample& sample, const Pose& X_WH = {}) {
  std::array<Pose, hand::kHandSegments> X_WS{};
  hand().place(sample, X_WH, X_WS);
  return X_WS;
}

TEST(HandModel, AFlatHandPointsItsFingersForward) {
  const auto X_WS = placed(glove(0));
  for (std::size_t f = 1; f < 5; ++f) {
    EXPECT_GT(X_WS[1 + 3 * f + 2].p.x(), X_WS[1 + 3 * f].p.x());
    EXPECT_NEAR(X_WS[1 + 3 * f + 2].p.y(), 0, 1e-9);
  }
  EXPECT_LT(X_WS[3].p.z(), X_WS[0].p.z()) << "a right hand's thumb is on the left";
}

TEST(HandModel, BendingBringsTheFingertipsTowardsThePalm) {
  const auto flat = placed(glove(0));
  const auto bent = placed(glove(1.0));
  for (std::size_t f = 0; f < 5; ++f)
    EXPECT_LT(bent[3 + 3 * f].p.y(), flat[3 + 3 * f].p.y() - 0.01) << "finger " << f;
}

TEST(HandModel, AFistBringsThumbAndIndexTogether) {
  const auto flat = placed(glove(0));
  const auto fist = placed(glove(1.2));
  EXPECT_LT((fist[3].p - fist[6].p).norm(), (flat[3].p - flat[6].p).norm());
}

/// Of any pose and of any size that is placed as it is.
HandSample any_glove() {
  HandSample sample = glove(0);
  for (double& angle : sample.joints)
    angle = 0.01 * *rc::gen::inRange(-30, 150);
  sample.hand_scale = *test::between(0.6, 1.15);
  for (double& scale : sample.finger_scale)
    scale = *test::between(0.85, 1.2);
  return sample;
}

RC_GTEST_PROP(HandModel, PhalangesMeetAtTheirJointsInEveryPose, ()) {
  HandSample sample = any_glove();
  sample.side = *rc::gen::element(hand::HandSide::right, hand::HandSide::left);
  const auto X_WS = placed(sample);
  const HandSize size;
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t k = 0; k + 1 < 3; ++k) {
      const std::size_t s = 1 + 3 * f + k;
      const double half = 0.5 * sample.length_scale(s);
      const Vec3 end = X_WS[s] * Vec3(half * size.fingers[f].length_m[k], 0, 0);
      const Vec3 begin = X_WS[s + 1] * Vec3(-half * size.fingers[f].length_m[k + 1], 0, 0);
      RC_ASSERT((end - begin).norm() < 1e-9);
      // Shapes are made in a few sizes, and still reach over the joint.
      const auto reaches = [&](std::size_t segment) {
        return hand().segment(sample, segment).parts[0].superquadric.a.x() -
               half * size.fingers[f].length_m[segment - 1 - 3 * f];
      };
      RC_ASSERT(reaches(s) > 0 && reaches(s + 1) > 0);
    }
  }
}

RC_GTEST_PROP(HandModel, ALeftHandIsTheMirrorImageOfTheRightOne, ()) {
  HandSample sample = any_glove();
  const auto right = placed(sample);
  sample.side = hand::HandSide::left;
  const auto left = placed(sample);
  RC_ASSERT(left[1].p.z() > left[0].p.z());  // its thumb is on the right
  for (std::size_t s = 0; s < left.size(); ++s) {
    RC_ASSERT(left[s].p == hand::mirrored(right[s]).p);
    RC_ASSERT(left[s].R.coeffs() == hand::mirrored(right[s]).R.coeffs());
  }
}

RC_GTEST_PROP(HandModel, MovingTheWristMovesEverySegmentRigidly, ()) {
  Pose X_WH;
  X_WH.p = Vec3(*rc::gen::inRange(-5, 5), *rc::gen::inRange(-5, 5), *rc::gen::inRange(-5, 5));
  X_WH.R = quat_from_rotation_vector(Vec3(0.1 * *rc::gen::inRange(-9, 9), 0.2, -0.3));
  const auto at_origin = placed(glove(0.4));
  const auto moved = placed(glove(0.4), X_WH);
  for (std::size_t s = 0; s < moved.size(); ++s)
    RC_ASSERT((moved[s].p - X_WH * at_origin[s].p).norm() < 1e-9);
}

TEST(HandModel, ReachCoversEverySegment) {
  for (const double scale : {hand::kMinHandScale, 0.7, 1.0, 1.3, hand::kMaxHandScale}) {
    HandSample sample = glove(0);
    sample.hand_scale = scale;
    sample.finger_scale.fill(scale < 1 ? hand::kMinFingerScale : hand::kMaxFingerScale);
    const auto X_WS = placed(sample);
    for (std::size_t s = 0; s < X_WS.size(); ++s) {
      const auto& bound = hand().segment(sample, s).bound_O;
      EXPECT_LE((X_WS[s] * bound.center).norm() + bound.radius, hand().reach_m(sample) + 1e-9) << "segment " << s;
    }
  }
}

TEST(HandModel, ASampleOfAGrownHandHasEnoughPointsForAFingertip) {
  std::size_t points = 0;
  for (std::size_t s = 0; s < hand::kHandSegments; ++s)
    points += collision::sample_count(hand().segment(glove(0), s));
  EXPECT_GT(points, 1000u);
}

TEST(HandModel, ImpossibleSizesAreRefusedByName) {
  HandSize size;
  size.fingers[2].radius_m[1] = -1;
  const auto made = HandModel::create(size);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::invalid_value);
  EXPECT_NE(made.error().what.find("finger 2"), std::string::npos);
  EXPECT_FALSE(made.error().remedy.empty());
}

RC_GTEST_PROP(HandModel, SegmentsReachAsFarAsTheirSurfaceDoes, ()) {
  HandSample sample = glove(0);
  sample.hand_scale = *rc::gen::element(0.7, 1.0, 1.3);
  const Vec3 n_S = test::any_unit();
  for (std::size_t s = 0; s < hand::kHandSegments; ++s) {
    double farthest_m = 0;
    for (const collision::Cluster& cluster : hand().segment(sample, s).clusters) {
      for (std::size_t lane = 0; lane < cluster.count; ++lane)
        farthest_m = std::max(farthest_m, n_S.dot(cluster.sample_O(lane).cast<double>()));
    }
    const double reach_m = hand().inner_radius_m(sample, s) + hand().stands_out_m(sample, s, n_S);
    RC_ASSERT(reach_m > farthest_m - 1e-4);
    RC_ASSERT(reach_m < farthest_m + 1.5e-3);  // between samples, 4 mm apart
  }
}

}  // namespace
}  // namespace mechane::haptics
