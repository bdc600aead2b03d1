#include "server/geometry/mesh_query.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::geometry {
namespace {

double exact_box_distance(const Vec3& half, const Vec3& p) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(MeshQuery, DistanceToABoxIsTheClosedForm) {
  const Vec3 half(0.3, 0.2, 0.1);
  const MeshQuery query(test::box(half));
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
    EXPECT_NEAR(query.signed_distance(p), exact_box_distance(half, p), 1e-12);
  }
}

TEST(MeshQuery, TheTreeFindsWhatAllTrianglesWould) {
  Superquadric s;
  s.a = {0.3, 0.2, 0.1};
  s.e1 = 0.4;
  const Mesh mesh = tessellate(s, 10);
  const MeshQuery query(mesh);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
    double best = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh.triangles) {
      const Mesh one{{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, {{0, 1, 2}}};
      best = std::min(best, MeshQuery(one).closest(p).distance_m);
    }
    EXPECT_DOUBLE_EQ(query.closest(p).distance_m, best);
  }
}

/// A ball of faces beside round coordinates, where corners and edges are equally near to many triangles; far from the origin, where floats
/// are coarse.
Mesh ball_far_away() {
  Mesh mesh = test::bumpy_ball(60);
  for (Vec3& v : mesh.vertices)
    v = (v * 64).array().round().matrix() / 64 + Vec3(100, -3, 7);
  return weld(mesh);
}

TEST(MeshQuery, AnAnswerNearbyChangesNoAnswer) {
  const Mesh mesh = ball_far_away();
  const MeshQuery query(mesh);
  const Eigen::AlignedBox3d box = mesh.bounds();
  Random random(11);
  SurfacePoint near;
  for (int i = 0; i < 3000; ++i) {
    // On a lattice, so that many places lie right above corners and edges.
    const Vec3 share(random.unit(), random.unit(), random.unit());
    const Vec3 p = box.min() + (share * 40).array().round().matrix().cwiseProduct(box.sizes()) / 40;
    const SurfacePoint alone = query.closest(p);
    near = query.closest(p, near);
    ASSERT_EQ(near.triangle, alone.triangle);
    ASSERT_EQ(near.p, alone.p);
    ASSERT_EQ(near.distance_m, alone.distance_m);
  }
}

TEST(MeshQuery, NoRayMissesWhatATriangleByItselfIsHitBy) {
  const Mesh mesh = ball_far_away();
  const MeshQuery query(mesh);
  std::vector<MeshQuery> alone;
  for (const auto& t : mesh.triangles)
    alone.emplace_back(Mesh{{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, {{0, 1, 2}}});
  Random random(13);
  std::vector<RayHit> hits;
  std::vector<RayHit> hit;
  for (int i = 0; i < 60; ++i) {
    const Vec3 from =
        mesh.bounds().center() + 0.7 * Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
    const Vec3 way =
        i % 3 == 0 ? Vec3(Vec3::Unit(i / 3 % 3)) : Vec3(mesh.vertices[random.below(mesh.vertices.size())] - from);
    query.cast(from, way, hits);
    std::size_t count = 0;
    for (const MeshQuery& one : alone) {
      one.cast(from, way, hit);
      count += hit.size();
    }
    ASSERT_EQ(hits.size(), count);
  }
}

TEST(MeshQuery, RaysEnterAndLeaveInTurnAlsoThroughEdgesAndVertices) {
  const Mesh mesh = tessellate(Superquadric{}, 8);
  const MeshQuery query(mesh);
  std::vector<RayHit> hits;
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from = 3 * Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalized();
    query.cast(from, -from, hits);
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_TRUE(hits[0].entering);
    EXPECT_FALSE(hits[1].entering);
    EXPECT_NEAR(hits[0].t, 2.0 / 3, 0.02);
  }
  for (const Vec3& v : mesh.vertices) {  // straight at a vertex: no ray slips through
    query.cast(3 * v, -v, hits);
    EXPECT_GE(hits.size(), 2U);
  }
}

TEST(MeshQuery, OverlappingPiecesAreOneSolid) {
  Mesh mesh = test::box({1, 1, 1});
  const Mesh second = test::box({1, 1, 1}, {1, 0, 0});
  for (const auto& t : second.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
  const MeshQuery query(mesh);
  EXPECT_EQ(query.winding({0.5, 0.1, 0.2}), 2);
  EXPECT_EQ(query.winding({-0.5, 0.1, 0.2}), 1);
  EXPECT_EQ(query.winding({2.5, 0.1, 0.2}), 0);
}

TEST(MeshCheck, WeldingClosesWhatAnExporterSplit) {
  const Mesh whole = test::box({1, 2, 3});
  Mesh split;
  for (const auto& t : whole.triangles) {
    const auto base = static_cast<std::uint32_t>(split.vertices.size());
    for (const std::uint32_t v : t)
      split.vertices.push_back(whole.vertices[v] + Vec3::Constant(1e-9 * base));
    split.triangles.push_back({base, base + 1, base + 2});
  }
  EXPECT_GT(open_edges(split), 0U);
  const Mesh welded = weld(split, 1e-6);
  EXPECT_EQ(welded.vertices.size(), 8U);
  EXPECT_EQ(open_edges(welded), 0U);
}

TEST(MeshCheck, BadMeshesAreNamed) {
  EXPECT_EQ(check_mesh({}, "lid").error().where, "lid");
  EXPECT_EQ(check_mesh({}, "lid").error().code, ErrorCode::missing);
  Mesh nan = test::box({1, 1, 1});
  nan.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_mesh(nan, "lid").error().code, ErrorCode::invalid_value);
  EXPECT_NE(check_mesh(nan, "lid").error().what.find("vertex 3"), std::string::npos);
  Mesh index = test::box({1, 1, 1});
  index.triangles[2][1] = 8;
  EXPECT_EQ(check_mesh(index, "lid").error().code, ErrorCode::damaged);
  EXPECT_NE(check_mesh(index, "lid").error().what.find("triangle 2"), std::string::npos);
  EXPECT_FALSE(check_mesh(index, "lid").error().remedy.empty());
  EXPECT_TRUE(check_mesh(test::box({1, 1, 1}), "lid").has_value());
}

}  // namespace
}  // namespace mechane::geometry
