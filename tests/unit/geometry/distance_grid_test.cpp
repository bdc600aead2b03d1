#include "server/geometry/distance_grid.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::geometry {
namespace {

TEST(DistanceGrid, AgreesWithTheMeshOnBothSidesOfASurface) {
  const Mesh mesh = test::torus(0.35, 0.1);
  const MeshQuery query(mesh);
  const DistanceGrid grid(mesh, query, 48);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p(0.9 * (random.unit() - 0.5), 0.9 * (random.unit() - 0.5), 0.2 * (random.unit() - 0.5));
    // Half a cell at the middle of the tube, where the distance has a kink.
    EXPECT_NEAR(grid.at(p), query.signed_distance(p), 0.5 * grid.cell_m()) << p.transpose();
  }
}

TEST(DistanceGrid, IsNeverLessThanTheDistanceAtANode) {
  const Mesh mesh = test::gear();
  const MeshQuery query(mesh);
  const DistanceGrid grid(mesh, query, 24);
  for (std::size_t node = 0; node < grid.nodes(); node += 7) {
    const double exact = query.signed_distance(grid.position(node));
    EXPECT_EQ(grid.distance_m(node) < 0, exact < 0);
    EXPECT_GE(std::abs(grid.distance_m(node)), std::abs(exact) - 1e-6);
    EXPECT_LE(std::abs(grid.distance_m(node)), std::abs(exact) + 0.3 * grid.cell_m());
  }
}

TEST(DistanceGrid, SharesOfCubesSumToTheVolume) {
  const Mesh mesh = test::box({0.31, 0.22, 0.13}, {0.5, 0.5, 0.5});
  const MeshQuery query(mesh);
  const DistanceGrid grid(mesh, query, 40);
  double volume = 0;
  for (std::size_t node = 0; node < grid.nodes(); ++node)
    volume += grid.inside_share(node) * std::pow(grid.cell_m(), 3);
  EXPECT_NEAR(volume, 0.62 * 0.44 * 0.26, 0.01 * volume);
  EXPECT_FALSE(grid.overlaps());
}

TEST(DistanceGrid, OverlappingPiecesAreInsideOnce) {
  Mesh mesh = test::box({0.3, 0.2, 0.1});
  const Mesh second = test::box({0.3, 0.2, 0.1}, {0.2, 0.05, 0.02});
  for (const auto& t : second.triangles)
    mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices.insert(mesh.vertices.end(), second.vertices.begin(), second.vertices.end());
  const MeshQuery query(mesh);
  const DistanceGrid grid(mesh, query, 32);
  EXPECT_TRUE(grid.overlaps());
  EXPECT_LT(grid.at({0.1, 0, 0}), 0);
  EXPECT_LT(grid.at({-0.25, 0, 0}), 0);
  EXPECT_GT(grid.at({-0.25, 0.22, 0.11}), 0);
}

}  // namespace
}  // namespace mechane::geometry
