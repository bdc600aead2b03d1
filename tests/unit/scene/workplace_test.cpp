#include "client-sdk/scene/workplace.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace mechane::scene {
namespace {

using client::Affordance;
using Box = Eigen::AlignedBox3d;

constexpr std::uint32_t kCrank = 0;
constexpr std::uint32_t kBeam = 1;

/// A crank of 20 cm that turns about the world's z, and a beam of two metres 3 m away that belongs on top of a post.
std::vector<Affordance> affordances() {
  const auto made = [](Affordance::Kind kind, std::uint32_t object, const char* agent) {
    Affordance out;
    out.kind = kind;
    out.object = object;
    out.agent = agent;
    return out;
  };
  std::vector<Affordance> out{
      made(Affordance::Kind::taken, kCrank, "take_crank"), made(Affordance::Kind::turns, kCrank, "axle"),
      made(Affordance::Kind::taken, kBeam, "take_beam"), made(Affordance::Kind::placed, kBeam, "post")};
  out[3].X_AJ.p = Vec3(0, 2, 0);
  return out;
}

StandingObject standing(std::uint32_t object) {
  if (object == kCrank) return {Pose{}, Box(Vec3(-0.2, -0.02, 0), Vec3(0.2, 0.02, 0.1))};
  return {Pose{Vec3(3, 0, 0), Quat::Identity()}, Box(Vec3(-1, -0.1, -0.1), Vec3(1, 0.1, 0.1))};
}

WorkingHand hand_near(const Vec3& p_WH, bool holding) {
  return {Box(p_WH - Vec3::Constant(0.05), p_WH + Vec3::Constant(0.05)), holding};
}

Box seen(const std::vector<WorkingHand>& hands, const std::vector<std::string>& enabled) {
  return workplace(hands, affordances(), enabled, standing);
}

TEST(Workplace, AStepInWhichNothingCanBeTakenHasNone) {
  EXPECT_TRUE(seen({}, {}).isEmpty());
  EXPECT_TRUE(seen({hand_near(Vec3(0.2, 0, 0), true)}, {"axle", "post"}).isEmpty());
}

TEST(Workplace, WithoutAHandItIsAllThatCanBeTakenAndWhereItBelongs) {
  const Box crank = seen({}, {"take_crank"});
  EXPECT_TRUE(crank.isApprox(standing(kCrank).box_B));
  const Box beam = seen({}, {"take_beam", "post"});
  EXPECT_TRUE(beam.contains(Vec3(2, -0.1, 0)) && beam.contains(Vec3(4, 0.1, 0)) && beam.contains(Vec3(0, 2, 0)));
}

TEST(Workplace, AFreeHandNeedsTheNearestPlaceOfEachThing) {
  const Box box = seen({hand_near(Vec3(1, 0, 0), false)}, {"take_crank", "take_beam", "post"});
  EXPECT_TRUE(box.contains(Vec3(0.2, 0, 0)) && box.contains(Vec3(2, 0, 0)) && box.contains(Vec3(1.05, 0.05, 0.05)));
  EXPECT_LT(box.max().x(), 2.01) << "not all of the beam";
  EXPECT_LT(box.max().y(), 0.1) << "nothing is carried to the post yet";
}

TEST(Workplace, AHandThatHoldsSomethingNeedsWhereItBelongsAndNothingElse) {
  const Box box = seen({hand_near(Vec3(2.1, 0, 0), true)}, {"take_crank", "take_beam", "post"});
  EXPECT_TRUE(box.contains(Vec3(0, 2, 0)));
  EXPECT_LT(box.max().x(), 2.2);
}

TEST(Workplace, ATurnedThingNeedsTheHandsArc) {
  const Box still = seen({hand_near(Vec3(0.2, 0, 0.05), true)}, {"take_crank"});
  EXPECT_GT(still.min().x(), 0.1);
  const Box turned = seen({hand_near(Vec3(0.2, 0, 0.05), true)}, {"take_crank", "axle"});
  EXPECT_TRUE(turned.isApprox(Box(Vec3(-0.05, -0.25, 0), Vec3(0.25, 0.25, 0.1)), 1e-9));
}

std::vector<picture::SeenThing> things(const std::vector<WorkingHand>& hands, const std::vector<std::string>& enabled) {
  return things_at_work(hands, affordances(), enabled, standing);
}

TEST(ThingsAtWork, AHeldThingAndItsGoalComeFirst) {
  EXPECT_TRUE(things({}, {}).empty());
  const std::vector<std::string> all{"take_crank", "take_beam", "post"};
  const auto held = things({hand_near(Vec3(2.1, 0, 0), true), hand_near(Vec3(0, 0.2, 0), false)}, all);
  ASSERT_EQ(held.size(), 4U) << "the beam, the post; crank and beam for the free hand";
  EXPECT_EQ(held[0].points_W.size(), 8U);
  ASSERT_TRUE(held[0].about_W);
  EXPECT_NEAR(held[0].about_W->x(), 2.1, 1e-5) << "where it is held";
  ASSERT_EQ(held[1].points_W.size(), 1U);
  EXPECT_TRUE(held[1].points_W[0].isApprox(Vec3f(0, 2, 0)));
  EXPECT_GT(held[1].around_m, 0);
}

TEST(ThingsAtWork, WithoutAHandItIsAllThatCanBeTakenAndWhereItBelongs) {
  const auto seen = things({}, {"take_crank", "take_beam", "post"});
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_TRUE(seen[1].about_W->isApprox(Vec3f(3, 0, 0)));
}

}  // namespace
}  // namespace mechane::scene
