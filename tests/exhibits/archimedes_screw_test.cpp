// Archimedes' screw, played by its own visits; and what fails, and where, once something is broken.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

const test::Exhibit& screw() {
  static const test::Exhibit kExhibit("archimedes-screw");
  return kExhibit;
}

TEST(ArchimedesScrewVisits, TheScrewIsPutIntoItsBarrel) {
  const test::PlayedVisit visit = screw().play("assembling");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 2u) << visit;
  EXPECT_EQ(visit.quantities.at("seated"), 1) << visit;
}

TEST(ArchimedesScrewVisits, TurningRaisesWaterAndGivesOneHash) {
  const test::PlayedVisit visit = screw().play("turning");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 3u) << visit;
  EXPECT_GT(visit.quantities.at("basin"), 15) << visit;
  EXPECT_EQ(screw().play("turning").state_hash, visit.state_hash);
}

TEST(ArchimedesScrewVisits, AWholeHandKeepsTheCrankThroughAllItsTurns) {
  const test::PlayedVisit visit = screw().play_with_glove("turning");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_TRUE(std::ranges::none_of(visit.moves, test::went_wrong)) << visit;
}

TEST(ArchimedesScrewVisits, WithoutItsAxleItIsHeldButDoesNotTurn) {
  const test::PlayedVisit visit =
      screw().play_changed("turning", [](state::WorldDescription& world) { test::switch_off(world, "AXLE"); });
  EXPECT_EQ(visit.stopped_at, "turn") << visit;
}

TEST(ArchimedesScrewVisits, AScrewThatFitsNowhereIsNotSeated) {
  const test::PlayedVisit visit =
      screw().play_changed("assembling", [](state::WorldDescription& world) { test::switch_off(world, "SEAT"); });
  EXPECT_EQ(visit.stopped_at, "seat") << visit;
}

}  // namespace
}  // namespace mechane
