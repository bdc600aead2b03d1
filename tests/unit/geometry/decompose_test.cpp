#include "server/geometry/pieces/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/base/random.hpp"
#include "server/geometry/mesh_check.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/pieces/piece_region.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::geometry {
namespace {

Decomposition taken_apart(const Mesh& mesh, const DecomposeConfig& config = {}) {
  auto result = decompose(mesh, config);
  EXPECT_TRUE(result) << result.error().to_string();
  return result ? *result : Decomposition{};
}

double diagonal_of(const Mesh& mesh) {
  return mesh.bounds().diagonal().norm();
}

double total_volume(const Decomposition& d) {
  return std::accumulate(d.pieces.begin(), d.pieces.end(), 0.0,
                         [](double sum, const Piece& piece) { return sum + piece.volume_m3; });
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  const Vec3 sum = std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero()));
  return sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
}

/// Each place of the surface is in one cell, or on the border of several.
void expect_partition(const Mesh& mesh, const Decomposition& d) {
  const double slack = 1e-4 * diagonal_of(mesh);
  for (const SurfaceSample& sample : sample_by_area(mesh, 3000, 77)) {
    int within = 0;
    int surely_within = 0;
    for (const Piece& piece : d.pieces) {
      within += cell_contains(piece.cell, sample.p, slack) ? 1 : 0;
      surely_within += cell_contains(piece.cell, sample.p, -slack) ? 1 : 0;
    }
    EXPECT_GE(within, 1) << sample.p.transpose();
    EXPECT_LE(surely_within, 1) << sample.p.transpose();
  }
}

/// Chords between points of one piece, by the exact distance and with points of the test's own.
void expect_quasi_convex(const Mesh& mesh, const Decomposition& d, double bound) {
  const MeshQuery query(mesh);
  Random random(5);
  for (const Piece& piece : d.pieces) {
    std::vector<Vec3> points = piece.surface_points;
    points.insert(points.end(), piece.cut_points.begin(), piece.cut_points.end());
    double deepest = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3& a = points[random.below(points.size())];
      const Vec3& b = points[random.below(points.size())];
      deepest = std::max(deepest, query.signed_distance(a + random.unit() * (b - a)));
    }
    EXPECT_LE(deepest, bound * diagonal_of(mesh));
  }
}

struct Solid {
  const char* name;
  Mesh (*mesh)();
  std::size_t fewest;
  std::size_t most;
};

class DecomposeSolid : public testing::TestWithParam<Solid> {};

TEST_P(DecomposeSolid, IsPartedWhereTheEyeDoesAndLosesNothing) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Mesh mesh = GetParam().mesh();
  const DecomposeConfig config;
  const Decomposition d = taken_apart(mesh, config);
  EXPECT_TRUE(d.met);
  EXPECT_GE(d.pieces.size(), GetParam().fewest);
  EXPECT_LE(d.pieces.size(), GetParam().most);
  expect_partition(mesh, d);
  expect_quasi_convex(mesh, d, 1.25 * config.max_concavity);  // the search sampled other chords
  EXPECT_NEAR(total_volume(d), enclosed_volume_m3(mesh), 0.01 * enclosed_volume_m3(mesh));
  for (const Piece& piece : d.pieces) {
    EXPECT_LE(piece.concavity_pct, 100 * config.max_concavity);
    EXPECT_GT(piece.surface_points.size(), 300U);
  }
}

INSTANTIATE_TEST_SUITE_P(Decompose, DecomposeSolid,
                         testing::Values(Solid{"ball", [] { return test::ball(0.5); }, 1, 1},
                                         Solid{"box",
                                               [] {
                                                 return test::box({0.5, 0.3, 0.2});
                                               },
                                               1, 1},
                                         Solid{"bumpy_ball", [] { return test::bumpy_ball(); }, 1, 3},
                                         Solid{"L", [] { return test::l_shape(); }, 2, 2},
                                         Solid{"peanut", [] { return test::peanut(); }, 2, 2},
                                         Solid{"gear_of_12", [] { return test::gear(12); }, 12, 18},
                                         Solid{"gear_of_8", [] { return test::gear(8); }, 8, 11},
                                         Solid{"barrel", [] { return test::tube(0.25, 0.3, 0.4); }, 6, 10},
                                         Solid{"torus", [] { return test::torus(0.35, 0.1); }, 6, 12},
                                         Solid{"screw", [] { return test::screw(); }, 5, 14}),
                         [](const auto& solid) { return solid.param.name; });

TEST(Decompose, PointsLieOnTheSurfaceOrOnACutInsideTheSolid) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Mesh mesh = test::gear();
  const MeshQuery query(mesh);
  const double slack = 1e-6;
  for (const Piece& piece : taken_apart(mesh).pieces) {
    for (const Vec3& p : piece.surface_points) {
      EXPECT_TRUE(cell_contains(piece.cell, p, slack));
      EXPECT_LT(query.closest(p).distance_m, slack);
    }
    for (const Vec3& p : piece.cut_points) {
      EXPECT_TRUE(cell_contains(piece.cell, p, slack));
      EXPECT_FALSE(cell_contains(piece.cell, p, -slack));
      EXPECT_LT(query.signed_distance(p), 0.002 * diagonal_of(mesh));
    }
  }
}

TEST(Decompose, AnLFallsApartInItsCorner) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Decomposition d = taken_apart(test::l_shape());
  ASSERT_EQ(d.pieces.size(), 2U);
  for (const Piece& piece : d.pieces) {
    ASSERT_EQ(piece.cell.size(), 1U);
    EXPECT_LT(std::abs(piece.cell[0].excess({0.2, 0.2, 0})), 0.01);  // through the crease
    EXPECT_LT(std::abs(piece.cell[0].n.z()), 0.05);
    EXPECT_FALSE(piece.cut_points.empty());
  }
}

TEST(Decompose, APeanutFallsApartAtItsNeck) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Decomposition d = taken_apart(test::peanut());
  ASSERT_EQ(d.pieces.size(), 2U);
  EXPECT_NEAR(d.pieces[0].volume_m3, d.pieces[1].volume_m3, 0.1 * d.pieces[0].volume_m3);
  for (const Piece& piece : d.pieces)
    EXPECT_NEAR(std::abs(mean_of(piece.surface_points).z()), 0.35, 0.07);
}

TEST(Decompose, EachToothOfAGearIsAPieceOfItsOwn) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Decomposition d = taken_apart(test::gear());
  for (int k = 0; k < 12; ++k) {
    const Vec3 tip(0.54 * std::cos(2 * kPi * k / 12), 0.54 * std::sin(2 * kPi * k / 12), 0);
    const Vec3 next(0.54 * std::cos(2 * kPi * (k + 1) / 12), 0.54 * std::sin(2 * kPi * (k + 1) / 12), 0);
    for (const Piece& piece : d.pieces)
      EXPECT_FALSE(cell_contains(piece.cell, tip, 1e-6) && cell_contains(piece.cell, next, 1e-6));
  }
}

TEST(Decompose, SeparateBodiesAreSeparatePiecesHoweverWideTheBound) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  Mesh mesh = test::box({0.2, 0.2, 0.2});
  const Mesh second = test::box({0.1, 0.1, 0.1}, {0.35, 0, 0});
  for (const auto& t : second.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
  EXPECT_EQ(taken_apart(mesh, {.max_concavity = 0.5}).pieces.size(), 2U);
}

TEST(Decompose, OverlappingPiecesAreOneSolid) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  Mesh mesh = test::box({0.3, 0.1, 0.1});
  const Mesh second = test::box({0.3, 0.1, 0.1}, {0.25, 0, 0});
  for (const auto& t : second.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
  const Decomposition d = taken_apart(mesh);
  ASSERT_EQ(d.pieces.size(), 1U);
  EXPECT_NEAR(d.pieces[0].volume_m3, 0.85 * 0.2 * 0.2, 0.05 * 0.85 * 0.04);
  for (const Vec3& p : d.pieces[0].surface_points)
    EXPECT_FALSE(std::abs(p.x() - 0.3) < 1e-9 || std::abs(p.x() + 0.05) < 1e-9) << "buried at x = " << p.x();
}

TEST(Decompose, SameSeedSameBits) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Mesh mesh = test::gear(7);
  const Decomposition once = taken_apart(mesh);
  const Decomposition again = taken_apart(mesh);
  ASSERT_EQ(once.pieces.size(), again.pieces.size());
  for (std::size_t i = 0; i < once.pieces.size(); ++i) {
    const Piece& a = once.pieces[i];
    const Piece& b = again.pieces[i];
    EXPECT_EQ(a.surface_points, b.surface_points);
    EXPECT_EQ(a.cut_points, b.cut_points);
    EXPECT_EQ(a.volume_m3, b.volume_m3);
    EXPECT_EQ(a.concavity_pct, b.concavity_pct);
    ASSERT_EQ(a.cell.size(), b.cell.size());
    for (std::size_t k = 0; k < a.cell.size(); ++k) {
      EXPECT_EQ(a.cell[k].n, b.cell[k].n);
      EXPECT_EQ(a.cell[k].d, b.cell[k].d);
    }
  }
}

TEST(Decompose, TheBudgetIsKeptAndAMissOfTheBoundIsSaid) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Mesh mesh = test::gear();
  for (const std::size_t parts : {1, 5}) {
    const Decomposition d = taken_apart(mesh, {.max_parts = parts});
    EXPECT_LE(d.pieces.size(), parts);
    EXPECT_FALSE(d.met);
    EXPECT_NEAR(total_volume(d), enclosed_volume_m3(mesh), 0.01 * enclosed_volume_m3(mesh));
    expect_partition(mesh, d);
  }
}

TEST(Decompose, ProgressRisesToOne) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  double last = 0;
  const auto heard = [&](double share) {
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1);
    last = share;
  };
  ASSERT_TRUE(decompose(test::peanut(), {}, heard));
  EXPECT_EQ(last, 1);
}

TEST(Decompose, ASheetIsOnePieceThatMeetsNothing) {
  const Mesh two{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Decomposition d = taken_apart(two);
  ASSERT_EQ(d.pieces.size(), 1U);
  EXPECT_FALSE(d.met);
  EXPECT_TRUE(d.pieces[0].cell.empty());
  EXPECT_FALSE(d.pieces[0].surface_points.empty());
  EXPECT_EQ(d.pieces[0].concavity_pct, 100);
}

TEST(Decompose, WhatCannotBeTakenApartIsNamed) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  using mechane::test::is_error;
  const auto error_of = [](const Mesh& mesh, const DecomposeConfig& config = {}) {
    const auto d = decompose(mesh, config);
    return d ? Error{} : d.error();
  };
  EXPECT_THAT(error_of({}), is_error(ErrorCode::missing, 0));
  Mesh mesh = test::box({1, 1, 1});
  mesh.vertices[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(mesh), is_error(ErrorCode::invalid_value, 0, {"vertex 2"}));
  mesh = test::box({1, 1, 1});
  for (auto& t : mesh.triangles)
    std::swap(t[0], t[1]);
  EXPECT_THAT(error_of(mesh), is_error(ErrorCode::invalid_value, 0, {"inside out"}));
  const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(error_of(sheet), is_error(ErrorCode::invalid_value, 0, {"volume"}));
  const Mesh point{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}};
  EXPECT_THAT(error_of(point), is_error(ErrorCode::invalid_value, 0, {"micrometre"}));
  const Mesh line{{{1, 1, 1}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}}};
  EXPECT_THAT(error_of(line), is_error(ErrorCode::invalid_value, 0, {"area"}));
  EXPECT_THAT(error_of(test::ball(1), {.max_concavity = 0}), is_error(ErrorCode::invalid_value, 0, {"max_concavity"}));
  EXPECT_THAT(error_of(test::ball(1), {.max_parts = 0}), is_error(ErrorCode::invalid_value, 0, {"max_parts"}));
  EXPECT_THAT(error_of(test::ball(1), {.grid_cells = 1000}), is_error(ErrorCode::invalid_value, 0, {"grid_cells"}));
}

/// Whatever triangles between a few points: a result or an Error, in a moment.
RC_GTEST_PROP(Decompose, AnyTrianglesGiveAResultOrAnError, (std::uint64_t seed)) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  Random random(seed);
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(random.unit(), random.unit(), random.below(2) != 0 ? random.unit() : 0.5);
  const auto tetrahedra = 1 + random.below(3);
  for (std::size_t k = 0; k < tetrahedra;
       ++k) {  // closed, but folded through itself, doubled, flat or inside out as it comes
    const auto v = [&] { return static_cast<std::uint32_t>(random.below(8)); };
    const std::uint32_t a = v(), b = v(), c = v(), d = v();
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}});
  }
  if (random.below(4) == 0) mesh.triangles.pop_back();
  const auto d = decompose(mesh, {.max_parts = 6, .grid_cells = 16});
  if (!d) {
    RC_ASSERT(!d.error().what.empty() && !d.error().remedy.empty());
    return;
  }
  RC_ASSERT(!d->pieces.empty() && d->pieces.size() <= 6U);
  for (const Piece& piece : d->pieces) {
    RC_ASSERT(std::isfinite(piece.volume_m3) && std::isfinite(piece.concavity_pct));
    for (const Vec3& p : piece.surface_points)
      RC_ASSERT(p.allFinite());
  }
}

}  // namespace
}  // namespace mechane::geometry
