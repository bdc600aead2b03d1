#include "server/geometry/solid/solid_mesh.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/support/open_meshes.hpp"

namespace mechane::geometry {
namespace {

constexpr double kSure = 0.1;  // a winding number this near to 0 or 1 leaves no doubt
constexpr double kBall_m = 0.1;

MeshQuery query_of(const SolidMesh& solid) {
  return MeshQuery(solid.mesh, Inside::by_winding_number);
}

/// Points about the mesh of which the exact winding number of `truth` leaves no doubt.
void expect_inside_of(const Mesh& truth, const SolidMesh& solid, std::uint64_t seed) {
  const MeshQuery query = query_of(solid);
  const Eigen::AlignedBox3d box = truth.bounds();
  Random random(seed);
  int inside = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 share(random.unit(), random.unit(), random.unit());
    const Vec3 p = box.center() + 0.55 * (2 * share - Vec3::Ones()).cwiseProduct(box.sizes());
    const double winding = test::exact_winding(truth, p);
    if (winding > kSure && winding < 1 - kSure) continue;
    inside += winding > 0.5 ? 1 : 0;
    EXPECT_EQ(query.contains(p), winding > 0.5) << p.transpose() << ", winding number " << winding;
  }
  EXPECT_GT(inside, 5);
}

TEST(WindingNumber, IsThatOfAllSolidAngles) {
  const Mesh mesh = test::ball_with_holes(kBall_m, 3, 0.5, 1);
  const MeshQuery query(mesh, Inside::by_winding_number);
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = 0.3 * Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
    EXPECT_NEAR(query.winding_number(p), test::exact_winding(mesh, p), 0.005) << p.transpose();
  }
}

TEST(MakeSolid, ACleanClosedMeshStaysAsItIs) {
  for (const Mesh& mesh : {test::box({0.1, 0.2, 0.3}), test::gear(), test::torus(1, 0.2)}) {
    const Mesh welded = weld(mesh);
    const SolidMesh solid = make_solid(welded, {});
    EXPECT_EQ(solid.mesh.triangles, welded.triangles);
    EXPECT_EQ(solid.turned + solid.doubled + solid.open_edges, 0U);
    EXPECT_EQ(solid.hidden_area_m2 + solid.membrane_area_m2 + solid.sheet_area_m2, 0);
  }
}

TEST(MakeSolid, HolesAreClosedWhereTheWindingNumberIsAHalf) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh open = test::ball_with_holes(kBall_m, static_cast<int>(seed), 0.7 / static_cast<double>(seed), seed, 32);
    const SolidMesh solid = make_solid(weld(open), {});
    expect_inside_of(open, solid, seed);
    int skins = 0, near_half = 0;
    for (std::size_t i = 0; i < solid.mesh.triangles.size(); i += 17) {
      if (solid.origin[i] != SurfaceOrigin::membrane) continue;
      ++skins;
      near_half += std::abs(test::exact_winding(open, test::middle_of(solid.mesh, i)) - 0.5) < 0.1 ? 1 : 0;
    }
    EXPECT_GE(near_half, 0.8 * skins) << "the others lie at a rim, where the number has all values";
    EXPECT_GT(skins, 10);
  }
}

TEST(MakeSolid, AHemisphereIsClosedByAPlane) {
  const SolidMesh solid = make_solid(weld(test::bowl(kBall_m)), {});
  const MeshQuery query = query_of(solid);
  // The ring of triangles about the equator ends below it.
  for (const double r : {0.0, 0.3, 0.6}) {
    const double depth_m = -query.signed_distance({r * kBall_m, 0, -0.02});
    EXPECT_NEAR(depth_m, std::min(0.02, kBall_m - std::hypot(r * kBall_m, 0.02)), 0.004) << r;
  }
  EXPECT_GT(solid.membrane_area_m2, 0.8 * kPi * kBall_m * kBall_m);
  EXPECT_LT(solid.membrane_area_m2, 1.1 * kPi * kBall_m * kBall_m);
}

/// Two boxes that overlap.
TEST(MakeSolid, OfPiecesThatOverlapOnlyTheOutsideIsLeft) {
  Random random(5);
  for (int round = 0; round < 8; ++round) {
    const Vec3 half(0.1, 0.06, 0.04);
    const Pose X_AB{Vec3(0.05, 0.12 * random.unit() - 0.06, 0.013),
                    Quat(Eigen::AngleAxisd(1.5 * random.unit(), Vec3(1, 2, 3).normalized()))};
    Mesh both = test::box(half);
    Mesh other = test::box(half);
    for (Vec3& v : other.vertices)
      v = X_AB * v;
    both.append(other);
    const MeshQuery query(both);
    const SolidMesh solid = make_solid(weld(both), {});
    const MeshQuery skin = query_of(solid);
    const double slack_m = 0.002 * both.bounds().diagonal().norm();
    const auto depth_in = [&](const Vec3& p) { return (half - p.cwiseAbs()).minCoeff(); };
    const auto inner_of = [&](const Vec3& p) { return std::max(depth_in(p), depth_in(X_AB.inverse() * p)); };
    for (const SurfaceSample& sample : sample_by_area(solid.mesh, 300, 1))
      EXPECT_LT(std::abs(inner_of(sample.p)), slack_m) << sample.p.transpose();
    for (const SurfaceSample& sample : sample_by_area(both, 300, 2))
      EXPECT_TRUE(inner_of(sample.p) > slack_m || skin.closest(sample.p).distance_m < slack_m);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = 0.3 * Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
      EXPECT_TRUE(skin.contains(p) == (query.winding(p) > 0) || skin.closest(p).distance_m < slack_m) << p.transpose();
    }
  }
}

TEST(MakeSolid, TurnedTrianglesAndBacksAreSeenThrough) {
  const Mesh ball = weld(test::ball(kBall_m, 24));
  expect_inside_of(ball, make_solid(test::with_turned(ball, 0.05, 1), {}), 1);
  expect_inside_of(ball, make_solid(test::two_sided(ball), {}), 2);
  const Mesh holed = test::with_gaps(ball, 0.03, 3);
  const SolidMesh scan = make_solid(weld(test::with_turned(holed, 0.05, 4)), {});
  expect_inside_of(holed, scan, 3);
  EXPECT_GT(scan.turned, 10U);
  Mesh inverted = holed;
  for (auto& t : inverted.triangles)
    std::swap(t[1], t[2]);
  expect_inside_of(holed, make_solid(inverted, {}), 4);
}

TEST(MakeSolid, BoxesThatShareAFaceOrAnEdgeAreOne) {
  for (const Vec3& at : {Vec3(0.2, 0, 0), Vec3(0.2, 0.2, 0), Vec3(0.2, 0.2, 0.2)}) {
    Mesh pair = test::box({0.1, 0.1, 0.1});
    pair.append(test::box({0.1, 0.1, 0.1}, at));
    const SolidMesh solid = make_solid(weld(pair), {});
    const MeshQuery query = query_of(solid);
    EXPECT_NEAR(query.signed_distance(Vec3::Zero()), -0.1, 0.001);
    EXPECT_NEAR(query.signed_distance(at), -0.1, 0.001);
    EXPECT_FALSE(query.contains(Vec3(-0.2, 0, 0)));
  }
}

TEST(MakeSolid, WhatEnclosesNothingIsASheet) {
  Mesh flat;
  flat.vertices = {{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.1, 0}, {0, 0.1, 0}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Mesh& mesh : {flat, test::with_turned(flat, 0.6, 1), test::two_sided(flat)}) {
    const SolidMesh solid = make_solid(weld(mesh), {});
    EXPECT_EQ(open_edges(solid.mesh), 0U);
    EXPECT_NEAR(enclosed_volume_m3(solid.mesh), 0.2 * 0.1 * 0.001, 1e-9);
    EXPECT_NEAR(query_of(solid).signed_distance({0.1, 0.05, 0}), -0.0005, 1e-9);
  }
  EXPECT_TRUE(make_solid(flat, {SolidKind::closed}).mesh.empty());
}

TEST(MakeSolid, ASheetIsWhateverTheAuthorCallsOne) {
  const SolidChoice sheet{SolidKind::sheet, 0.004};
  for (const Mesh& mesh : {test::ball(kBall_m, 48), test::bowl(kBall_m)}) {
    const SolidMesh solid = make_solid(weld(mesh), sheet);
    const MeshQuery query = query_of(solid);
    EXPECT_FALSE(query.contains(Vec3::Zero()));
    EXPECT_NEAR(query.signed_distance({0, 0, 0.05 - kBall_m}), 0.048, 5e-4);
    EXPECT_NEAR(query.signed_distance({0, 0, 0.001 - kBall_m}), -0.001, 5e-4);
    EXPECT_EQ(solid.membrane_area_m2, 0);
  }
}

RC_GTEST_PROP(SolidChoice, IsReadAsItIsWritten, ()) {
  SolidChoice choice;
  choice.kind = static_cast<SolidKind>(*rc::gen::inRange(0, 3));
  if (choice.kind == SolidKind::sheet) choice.thickness_m = 1e-4 * *rc::gen::inRange(1, 1000);
  const auto read = solid_choice_of(text_of(choice));
  RC_ASSERT(read.has_value());
  RC_ASSERT(*read == choice);
}

TEST(SolidChoice, OtherWordsAreNone) {
  EXPECT_EQ(solid_choice_of("sheet"), (SolidChoice{SolidKind::sheet, 0.001}));
  for (const char* text :
       {"", "open", "sheet ", "sheet 0", "sheet 1", "sheet -0.001", "sheet 0.001 m", "sheetx", "sheet nan", "Auto"})
    EXPECT_FALSE(solid_choice_of(text)) << text;
}

}  // namespace
}  // namespace mechane::geometry
