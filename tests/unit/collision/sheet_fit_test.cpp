#include "server/collision/sheet_fit.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace mechane::collision {
namespace {

constexpr double kBlock_m = 0.01;

struct Plane {
  Vec3 n;
  double offset;  // in blocks
  [[nodiscard]] double distance_m(const Vec3& p_B) const { return kBlock_m * (n.dot(p_B) - offset); }
};

/// Samples at 5 x 5 x 5 places of a block; the plane that holds there is the nearest face.
std::vector<SheetSample> samples_of(const std::vector<Plane>& planes,
                                    const std::function<std::size_t(const Vec3&)>& holds) {
  std::vector<SheetSample> samples;
  for (int i = 0; i < 125; ++i) {
    SheetSample s;
    s.p_B = Vec3(i % 5, i / 5 % 5, i / 25) / 4;
    const Plane& plane = planes[holds(s.p_B)];
    s.distance_m = plane.distance_m(s.p_B);
    s.n_B = plane.n;
    s.tolerance_m = 1e-5;
    s.excess_m = 1e-5;
    samples.push_back(s);
  }
  return samples;
}

std::size_t larger(const std::vector<Plane>& planes, const Vec3& p_B, std::size_t a, std::size_t b) {
  return planes[a].distance_m(p_B) > planes[b].distance_m(p_B) ? a : b;
}

std::size_t lesser(const std::vector<Plane>& planes, const Vec3& p_B, std::size_t a, std::size_t b) {
  return larger(planes, p_B, a, b) == a ? b : a;
}

const std::vector<Plane> kPlanes = {{Vec3(1, 0, 0), 0.53}, {Vec3(0, 0.8, 0.6), 0.77}, {Vec3(-0.36, -0.48, 0.8), 0.11}};

void expect_told(const std::vector<SheetSample>& samples, const std::optional<Sheets>& sheets, int count) {
  ASSERT_TRUE(sheets.has_value());
  EXPECT_EQ(sheets->count, count);
  for (const SheetSample& s : samples)
    EXPECT_NEAR(distance_of(*sheets, s.p_B), s.distance_m, 1e-5) << s.p_B.transpose();
}

TEST(FitSheets, AFaceIsOne) {
  const auto samples = samples_of(kPlanes, [](const Vec3&) { return std::size_t{1}; });
  expect_told(samples, fit_sheets(samples, kBlock_m), 2);
}

TEST(FitSheets, AnEdgeIsTheLargerOfTwo) {
  const auto samples = samples_of(kPlanes, [](const Vec3& p) { return larger(kPlanes, p, 0, 1); });
  const auto sheets = fit_sheets(samples, kBlock_m);
  expect_told(samples, sheets, 2);
  EXPECT_TRUE(sheets->outer_convex);
}

TEST(FitSheets, ANookIsTheLesserOfTwo) {
  const auto samples = samples_of(kPlanes, [](const Vec3& p) { return lesser(kPlanes, p, 0, 1); });
  const auto sheets = fit_sheets(samples, kBlock_m);
  expect_told(samples, sheets, 2);
  EXPECT_FALSE(sheets->outer_convex);
}

TEST(FitSheets, ATipIsTheLargestOfThree) {
  const auto samples =
      samples_of(kPlanes, [](const Vec3& p) { return larger(kPlanes, p, larger(kPlanes, p, 0, 1), 2); });
  expect_told(samples, fit_sheets(samples, kBlock_m), 3);
}

TEST(FitSheets, ANookMayEndAtAFaceWhicheverOfTheThreeItIs) {
  for (std::size_t face = 0; face < 3; ++face) {
    const std::size_t b = (face + 1) % 3;
    const std::size_t c = (face + 2) % 3;
    const auto samples =
        samples_of(kPlanes, [&](const Vec3& p) { return larger(kPlanes, p, face, lesser(kPlanes, p, b, c)); });
    expect_told(samples, fit_sheets(samples, kBlock_m), 3);
    const auto inside_out =
        samples_of(kPlanes, [&](const Vec3& p) { return lesser(kPlanes, p, face, larger(kPlanes, p, b, c)); });
    expect_told(inside_out, fit_sheets(inside_out, kBlock_m), 3);
  }
}

TEST(FitSheets, WhatIsNoSheetIsRefused) {
  auto samples = samples_of(kPlanes, [](const Vec3& p) { return larger(kPlanes, p, 0, 1); });
  for (SheetSample& s : samples)
    s.distance_m = -kBlock_m * std::abs(std::sin(9 * s.p_B.sum()));
  EXPECT_FALSE(fit_sheets(samples, kBlock_m).has_value());
  EXPECT_FALSE(fit_sheets({}, kBlock_m).has_value());
}

TEST(FitSheets, TellsTheAirNoWiderThanAllowed) {
  // An edge: out in the air it is nearer than both planes' larger distance would have it, never farther; at an inner corner it is farther.
  auto samples = samples_of(kPlanes, [](const Vec3& p) { return lesser(kPlanes, p, 0, 1); });
  for (SheetSample& s : samples) {
    if (s.distance_m > 0) s.distance_m *= 0.5;
    s.on_face = s.distance_m <= 0;
  }
  EXPECT_FALSE(fit_sheets(samples, kBlock_m).has_value());
  for (SheetSample& s : samples)
    s.excess_m = kBlock_m;
  EXPECT_TRUE(fit_sheets(samples, kBlock_m).has_value());
}

}  // namespace
}  // namespace mechane::collision
