#include "server/geometry/solid/mesh_orient.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "server/geometry/mesh_check.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::geometry {
namespace {

Mesh inside_out(Mesh mesh) {
  for (auto& t : mesh.triangles)
    std::swap(t[1], t[2]);
  return mesh;
}

Mesh both(Mesh a, const Mesh& b) {
  a.append(b);
  return a;
}

const Mesh kLarge = test::box({0.3, 0.3, 0.3});
const Mesh kSmall = test::box({0.1, 0.1, 0.1});
const Mesh kAside = test::box({0.1, 0.1, 0.1}, {1, 0, 0});

TEST(TurnOutwards, AShellThatLiesInsideOutIsTurned) {
  Mesh mesh = inside_out(kSmall);
  EXPECT_EQ(turn_outwards(mesh), 1U);
  EXPECT_NEAR(enclosed_volume_m3(mesh), 0.008, 1e-12);
  mesh = both(kLarge, inside_out(kAside));
  EXPECT_EQ(turn_outwards(mesh), 1U);
  EXPECT_NEAR(enclosed_volume_m3(mesh), 0.216 + 0.008, 1e-12);
}

TEST(TurnOutwards, TheWallOfAHollowStays) {
  Mesh hollow = both(kLarge, inside_out(kSmall));
  EXPECT_EQ(turn_outwards(hollow), 0U);
  EXPECT_NEAR(enclosed_volume_m3(hollow), 0.216 - 0.008, 1e-12);
  hollow = inside_out(hollow);
  EXPECT_EQ(turn_outwards(hollow), 2U);
  EXPECT_NEAR(enclosed_volume_m3(hollow), 0.216 - 0.008, 1e-12);
}

TEST(TurnOutwards, AnOpenMeshIsLeftAlone) {
  Mesh open = inside_out(kSmall);
  open.triangles.pop_back();
  const auto before = open.triangles;
  EXPECT_EQ(turn_outwards(open), 0U);
  EXPECT_EQ(open.triangles, before);
}

TEST(Weld, OneIsLeftOfEqualTriangles) {
  Mesh doubled = both(kSmall, kSmall);
  EXPECT_EQ(weld(doubled, 1e-6).triangles.size(), 12U);
  doubled.triangles.push_back(doubled.triangles.front());
  EXPECT_EQ(open_edges(weld(doubled, 1e-6)), 0U);
}

}  // namespace
}  // namespace mechane::geometry
