#include "server/haptics/smooth_normal.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/collision/superquadric_object.hpp"
#include "tests/support/floor_server.hpp"
#include "tests/support/property_draw.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/touch.hpp"

namespace mechane::haptics {
namespace {

constexpr double kBall_m = 0.05;
constexpr double kStylus_m = 0.008;

using test::built;
using test::degrees_between;

/// What the tip of a stylus feels that goes along the equator of a ball of 24 facets around, 1 mm deep (or above it, where below 0).
struct AlongTheEquator {
  double jump_deg = 0, deviation_deg = 0;
  AlongTheEquator(const std::shared_ptr<const collision::Object>& ball, double depth_m,
                  const ForceConfig& config = {}) {
    test::FloorServer server(ball, config);
    hand::HandSample above;
    above.X_WH.p = Vec3(kBall_m + kStylus_m, 0, 0);
    server.answer(above);
    for (int i = 1; i < 10; ++i) {
      above.X_WH.p.x() -= 0.1 * depth_m;
      server.answer(above);
    }
    Vec3 before = Vec3::Zero();
    for (int i = 0; i <= 500; ++i) {
      const double angle = 2e-4 * i / kBall_m;
      const Vec3 way_out(std::cos(angle), std::sin(angle), 0);
      hand::HandSample sample;
      sample.X_WH.p = (kBall_m + kStylus_m - depth_m) * way_out;
      const hand::HapticOutput& output = server.answer(sample);
      if (output.contact_count != 1) ADD_FAILURE() << output.contact_count << " contacts at step " << i;
      const Vec3 now = output.contacts[0].n_W;
      if (i > 0) jump_deg = std::max(jump_deg, degrees_between(before, now));
      deviation_deg = std::max(deviation_deg, degrees_between(way_out, now));
      before = now;
    }
  }
};

TEST(SmoothNormal, FacetsOfABallAreNotFelt) {
  const auto ball = built(test::ball(kBall_m, 24));
  ForceConfig of_contacts;
  of_contacts.normals = NormalKind::of_contacts;
  const AlongTheEquator found(ball, 1e-3, of_contacts), smooth(ball, 1e-3);
  EXPECT_GT(found.deviation_deg, 4) << "else the ball has no facets to smooth";
  EXPECT_LT(smooth.deviation_deg, 1);
  EXPECT_LT(smooth.jump_deg, 0.1 * found.jump_deg);
}

TEST(SmoothNormal, ASurfaceThatIsNearHasTheSameNormalAsOneThatIsTouched) {
  const auto ball = built(test::ball(kBall_m, 24));
  EXPECT_LT(AlongTheEquator(ball, -5e-3).deviation_deg, 1);
}

std::shared_ptr<const collision::Object> round_thing(const Vec3& half_m, double e1) {
  geometry::Superquadric shape;
  shape.a = half_m;
  shape.e1 = e1;
  shape.e2 = 1;
  return std::make_shared<const collision::Object>(collision::make_superquadric_object(shape, 0.004));
}

RC_GTEST_PROP(SmoothNormal, TellsTheCurvatureOfABall, ()) {
  static const collision::Object pad = make_pad();
  static const std::array<double, 2> radii_m{0.025, 0.1};
  static const std::array balls{round_thing(Vec3::Constant(radii_m[0]), 1), round_thing(Vec3::Constant(radii_m[1]), 1)};
  const auto which = *rc::gen::inRange<std::size_t>(0, radii_m.size());
  const double radius_m = radii_m[which];
  const Vec3 way_out = test::any_unit(), v_B = *test::between(0, 0.4) * test::any_unit();
  const Touch touch{.p_B = radius_m * way_out, .n_B = way_out, .rounds = 2, .v_B = v_B};
  const double share = smooth_surface(pad, *balls[which], touch).curvature_per_m * radius_m;
  RC_LOG() << "curvature times radius " << share;
  RC_ASSERT(share > 0.7);
  RC_ASSERT(share < 1.2);
}

RC_GTEST_PROP(SmoothNormal, TellsTheCurvatureOfABarAlongTheWay, ()) {
  static const collision::Object pad = make_pad();
  constexpr double radius_m = 0.03;
  static const auto bar = round_thing(Vec3(radius_m, radius_m, 0.3), 0.1);
  const double angle = *test::between(-kPi, kPi);
  const Vec3 way_out(std::cos(angle), std::sin(angle), 0);
  const auto share_along = [&](const Vec3& v_B) {
    const Touch touch{.p_B = radius_m * way_out, .n_B = way_out, .rounds = 2, .v_B = v_B};
    return smooth_surface(pad, *bar, touch).curvature_per_m * radius_m;
  };
  const double along = share_along(0.3 * Vec3::UnitZ()), around = share_along(0.3 * way_out.cross(Vec3::UnitZ()));
  const double at_rest = share_along(Vec3::Zero());
  RC_LOG() << along << ", " << around << ", at rest " << at_rest;
  RC_ASSERT(std::abs(along) < 0.2);
  RC_ASSERT(std::abs(around - 1) < 0.25);
  RC_ASSERT(std::abs(at_rest - 0.5) < 0.25);
}

TEST(SmoothNormal, APlateIsFlatUpToItsEdges) {
  const auto block = built(test::box(Vec3(0.05, 0.02, 0.05)));
  const collision::Object pad = make_pad();
  for (const double from_edge_m : {0.05, 0.02, 0.01, 0.005, 0.002}) {
    const Touch touch{.p_B = Vec3(0.05 - from_edge_m, 0.02, 0), .n_B = Vec3::UnitY(), .v_B = Vec3(0.2, 0, 0)};
    EXPECT_NEAR(smooth_surface(pad, *block, touch).curvature_per_m, 0, 0.2) << from_edge_m;
  }
}

TEST(SmoothNormal, AnEdgeStays) {
  const auto block = built(test::box(Vec3(0.05, 0.02, 0.05)));
  const collision::Object pad = make_pad();
  for (const double from_edge_m : {0.02, 0.005, 0.002, 0.0005}) {
    const Vec3 on_top(0.05 - from_edge_m, 0.02, 0), on_side(0.05, 0.02 - from_edge_m, 0);
    EXPECT_LT(degrees_between(smooth_surface(pad, *block, {.p_B = on_top, .n_B = Vec3::UnitY()}).n_B, Vec3::UnitY()),
              0.5)
        << from_edge_m;
    EXPECT_LT(degrees_between(smooth_surface(pad, *block, {.p_B = on_side, .n_B = Vec3::UnitX()}).n_B, Vec3::UnitX()),
              0.5)
        << from_edge_m;
  }
  const Vec3 between = Vec3(1, 1, 0).normalized();
  EXPECT_LT(degrees_between(smooth_surface(pad, *block, {.p_B = Vec3(0.05, 0.02, 0), .n_B = between}).n_B, between),
            0.5);
}

/// As of a jar, with the seams of its staves. Facets alone turn by 7.5 degrees to both sides.
TEST(SmoothNormal, FacetsOfAThinRoundWallAreNotFelt) {
  const auto jar = std::make_shared<collision::Object>(
      collision_build::build_object(test::barrel(6, kBall_m - 0.003, kBall_m, 0.05, 4), {}).value());
  EXPECT_LT(AlongTheEquator(jar, 1e-3).deviation_deg, 3.5);
}

TEST(SmoothNormal, AThinWallKeepsItsSide) {
  const collision::Object pad = make_pad();
  for (const double thickness_m : {0.002, 0.004, 0.006, 0.012}) {
    const auto plate = built(test::box(Vec3(0.05, 0.5 * thickness_m, 0.05)));
    const Touch touch{.p_B = Vec3(0, 0.5 * thickness_m, 0), .n_B = Vec3(0.05, 1, 0).normalized()};
    const Vec3 n_B = smooth_surface(pad, *plate, touch).n_B;
    EXPECT_LE(degrees_between(n_B, Vec3::UnitY()), degrees_between(touch.n_B, Vec3::UnitY()) + 1e-9) << thickness_m;
  }
}

}  // namespace
}  // namespace mechane::haptics
