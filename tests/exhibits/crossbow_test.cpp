// The crossbow with its winch, played by its own visits; the law of bow, winch and flight; and what fails, and where, once something
// is broken.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/exhibit_play.hpp"

namespace mechane {
namespace {

const test::Exhibit& crossbow() {
  static const test::Exhibit kExhibit("crossbow");
  return kExhibit;
}

TEST(CrossbowVisits, TheArrowSticksInTheTargetAndTwiceTheSame) {
  const test::PlayedVisit visit = crossbow().play("shooting");
  EXPECT_TRUE(visit.done) << visit;
  EXPECT_EQ(visit.steps.size(), 5u) << visit;
  for (const test::PlayedStep& step : visit.steps)
    EXPECT_LT(step.seconds, 20) << step.name;
  std::cout << visit;
  EXPECT_EQ(crossbow().play("shooting").state_hash, visit.state_hash);
}

}  // namespace
}  // namespace mechane
