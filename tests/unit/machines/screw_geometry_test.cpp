// What a screw holds, against Rorres' published optima and Vitruvius' proportions.
#include "server/machines/screw_geometry.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/base/math.hpp"

namespace mechane::machines {
namespace {

ScrewShape vitruvius(double outer_radius_m) {
  return {outer_radius_m, outer_radius_m / 2, 2 * kPi * outer_radius_m / 2, 8, std::atan(0.75)};
}

TEST(VolumeRatio, MatchesRorresTableOfOptimalScrews) {
  // Rorres 2000, Table 1: blades, core ratio rho, pitch ratio lambda (pitch tan(slope) / 2 pi Ro), volume ratio nu.
  struct Row {
    int blades;
    double rho, lambda, nu;
  };
  const double slope = kPi / 6;
  for (const Row& row :
       {Row{1, 0.5358, 0.1285, 0.2811}, Row{2, 0.5369, 0.1863, 0.2747}, Row{3, 0.5357, 0.2217, 0.2697},
        Row{4, 0.5353, 0.2456, 0.2667}, Row{5, 0.5352, 0.2630, 0.2647}, Row{8, 0.5354, 0.2957, 0.2609}}) {
    const ScrewShape shape{1, row.rho, row.lambda * 2 * kPi / std::tan(slope), row.blades, slope};
    EXPECT_NEAR(volume_ratio(shape), row.nu, 3e-4) << row.blades << " blades";
  }
}

TEST(VolumeRatio, OfVitruviusScrewIsAboutASixth) {
  EXPECT_NEAR(volume_ratio(vitruvius(0.15)), 0.17, 0.002);
}

RC_GTEST_PROP(VolumeRatio, DependsOnProportionsAloneAndStaysBelowTheSpace, ()) {
  const double rho = 0.2 + 0.01 * *rc::gen::inRange(0, 60);
  const double lambda = rho * 0.01 * *rc::gen::inRange(5, 100);
  const double slope = 0.01 * *rc::gen::inRange(10, 140);
  const int blades = *rc::gen::inRange(1, 12);
  const double size = 0.01 * *rc::gen::inRange(5, 300);
  const auto screw = [&](double outer, double at_slope) {
    return ScrewShape{outer, rho * outer, lambda * 2 * kPi * outer / std::tan(at_slope), blades, at_slope};
  };
  const double nu = volume_ratio(screw(size, slope));
  RC_ASSERT(std::abs(nu - volume_ratio(screw(1, 0.6))) < 1e-3);
  RC_ASSERT(nu > 0 && nu < 1 - rho * rho);
}

TEST(VolumeRatio, ATooSteepScrewHoldsNothing) {
  ScrewShape shape = vitruvius(0.15);
  EXPECT_TRUE(holds_water(shape));
  shape.slope_rad = std::atan(1.01);
  EXPECT_FALSE(holds_water(shape));
}

TEST(Muysken, LimitOfAScrewOfOneMetreIsFiftyTurnsAMinute) {
  EXPECT_NEAR(muysken_limit_rad_s(1), 50 * 2 * kPi / 60, 1e-9);
  EXPECT_NEAR(muysken_limit_rad_s(8), 12.5 * 2 * kPi / 60, 1e-9);
}

}  // namespace
}  // namespace mechane::machines
