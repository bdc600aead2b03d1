#include "client-sdk/fit/surface.hpp"

#include <gtest/gtest.h>

#include "client-sdk/fit/summary.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/unit/fit/fitted_things.hpp"

namespace mechane::fit {
namespace {

constexpr double kShift_m = 0.001;

/// The places of a box's faces x = +-0.05, away from its edges.
template <class Check>
void at_inner_places(const Surface& surface, const Check& check) {
  std::size_t seen = 0;
  for (const auto& sample : geometry::sample_by_area(surface.mesh(), 600, 5)) {
    const Vec3 p = sample.p.cwiseAbs();
    const int near_edges =
        static_cast<int>(p.x() > 0.044) + static_cast<int>(p.y() > 0.034) + static_cast<int>(p.z() > 0.024);
    if (near_edges != 1) continue;
    ++seen;
    const auto error = surface.error_at(sample.p, sample.triangle);
    ASSERT_TRUE(error.has_value());
    check(sample.p, *error);
  }
  EXPECT_GT(seen, 100U);
}

TEST(Surface, ATrueMapIsFeltWhereTheMeshIs) {
  const FittedObject& box = fitted_box();
  at_inner_places(Surface(box), [](const Vec3&, const SurfaceError& error) {
    EXPECT_TRUE(error.felt);
    EXPECT_LT(error.error_m, 1e-5);
  });
}

TEST(Surface, AShiftedMapIsOffByTheShiftBeforeAndBehind) {
  FittedObject box = fitted_box();
  box.object.parts[0].X_OQ.p.x() += kShift_m;
  at_inner_places(Surface(box), [](const Vec3& p, const SurfaceError& error) {
    EXPECT_TRUE(error.felt);
    EXPECT_NEAR(error.error_m, std::abs(p.x()) > 0.0499 ? kShift_m : 0, 2e-5);
  });
}

TEST(Surface, WhatNoMapHoldsIsNotFeltAndTheVerdictSaysSo) {
  FittedObject box = fitted_box();
  EXPECT_EQ(verdict(summarise(box, Surface(box))).find("of this surface is not felt"), std::string::npos);
  box.object.parts[0].X_OQ.p.x() += 1;
  box.object.parts[0].bound_O.center.x() += 1;
  box.object.bound_O.center.x() += 1;
  const Surface surface(box);
  at_inner_places(surface, [](const Vec3&, const SurfaceError& error) { EXPECT_FALSE(error.felt); });
  const Summary summary = summarise(box, surface);
  EXPECT_EQ(summary.not_felt_share, 1);
  EXPECT_NE(verdict(summary).find("100.0 % of this surface is not felt"), std::string::npos);
}

TEST(Surface, TheVerdictNamesALittleThatIsNotFelt) {
  const FittedObject& box = fitted_box();
  Summary summary = summarise(box, Surface(box));
  summary.not_felt_share = 0.0013;
  EXPECT_NE(verdict(summary).find("feel right: the 0.13 % that is not felt is too little"), std::string::npos)
      << verdict(summary);
}

TEST(Surface, WhatAFingertipMaySlipThroughIsNotSaidToFeelRight) {
  FittedObject box = fitted_box();
  EXPECT_NE(verdict(summarise(box, Surface(box))).find("feel right"), std::string::npos);
  box.config.sample_spacing_m = box.report.parts.front().spacing_m / 2;  // more was asked for than there is
  const Summary sparse = summarise(box, Surface(box));
  ASSERT_FALSE(sparse.notes.empty());
  EXPECT_NE(sparse.notes.back().find("slip between"), std::string::npos);
  EXPECT_EQ(verdict(sparse).find("feel right"), std::string::npos) << verdict(sparse);
  EXPECT_NE(verdict(sparse).find("--max-samples"), std::string::npos) << "the remedy";
}

TEST(Surface, SeamsBetweenPartsAreNoSurface) {
  const FittedObject& crank = fitted_crank();
  const Surface surface(crank);
  EXPECT_EQ(surface.triangles_of_parts(), (std::vector<std::size_t>{96, 12, 96}));
  // The shaft's upper end lies inside the arm.
  const Vec3 n_up = Vec3::UnitZ();
  std::size_t hidden = 0;
  for (std::uint32_t t = 0; t < 96; ++t) {
    const auto& v = surface.mesh().triangles[t];
    const Vec3 a = surface.mesh().vertices[v[0]];
    const Vec3 n = (surface.mesh().vertices[v[1]] - a).cross(surface.mesh().vertices[v[2]] - a).normalized();
    if (n.dot(n_up) > 0.9 && !surface.error_at(a, t)) ++hidden;
  }
  EXPECT_GT(hidden, 0U);
}

TEST(Summary, MeshesThatWillDisappointAreNamed) {
  geometry::Mesh open = test::box({0.05, 0.05, 0.05});
  open.triangles.pop_back();
  geometry::Mesh inverted = test::box({0.05, 0.05, 0.05}, {0.3, 0, 0});
  for (auto& t : inverted.triangles)
    std::swap(t[0], t[1]);
  const FittedObject pair = fitted({{"lid", open}, {"turned", inverted}});
  const Summary summary = summarise(pair, Surface(pair));
  std::string notes;
  for (const std::string& note : summary.notes)
    notes += note + "\n";
  EXPECT_NE(notes.find("part 'lid': open, with 3 edges without a neighbour; its holes are closed"), std::string::npos)
      << notes;
  EXPECT_NE(notes.find("part 'turned': inside out"), std::string::npos) << notes;
}

}  // namespace
}  // namespace mechane::fit
