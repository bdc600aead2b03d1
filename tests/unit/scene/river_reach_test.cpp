#include "client-sdk/scene/river_reach.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mechane::scene {
namespace {

/// A river along z, from z = -3 to 3, 2 m wide about x = 1, at y = -0.1 once it stands in its place.
picture::MeshData modelled_river() {
  picture::MeshData mesh;
  for (int row = 0; row <= 6; ++row) {
    for (const float x : {0.0F, 2.0F})
      mesh.positions.emplace_back(x, 0, static_cast<float>(row) - 3);
  }
  return mesh;
}

TEST(RiverReach, goes_on_from_the_border_to_where_haze_has_it) {
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  X_WM.translation() = Vec3f(0, -0.1F, 0);
  for (const float way : {-0.4F, 0.4F}) {
    const RiverReach reach = river_reach(modelled_river(), X_WM, Vec3f(0, 0, way));
    ASSERT_FALSE(reach.mesh_W.positions.empty());
    EXPECT_GT(reach.width_m, 1.5F);
    EXPECT_LE(reach.width_m, 2.0F) << "no wider than what it goes on from";
    const float sign = way > 0 ? 1.0F : -1.0F;
    const Vec3f middle = 0.5F * (reach.mesh_W.positions[0] + reach.mesh_W.positions[1]);
    EXPECT_LT((middle - Vec3f(1, -0.1F, 3 * sign)).norm(), 1e-4F);
    float farthest = 0;
    for (const Vec3f& p_W : reach.mesh_W.positions) {
      EXPECT_FLOAT_EQ(p_W.y(), -0.1F);
      EXPECT_GE(sign * p_W.z(), 3 - 1e-4F) << "not over what was modelled";
      farthest = std::max(farthest, sign * p_W.z());
    }
    EXPECT_GT(farthest, 200);
    // It leaves straight on, and its triangles look up.
    const Vec3f next = 0.5F * (reach.mesh_W.positions[6] + reach.mesh_W.positions[7]);
    EXPECT_LT(std::abs(next.x() - 1), 0.05F);
    for (std::size_t i = 0; i + 2 < reach.mesh_W.indices.size(); i += 3) {
      const Vec3f& a = reach.mesh_W.positions[reach.mesh_W.indices[i]];
      const Vec3f& b = reach.mesh_W.positions[reach.mesh_W.indices[i + 1]];
      const Vec3f& c = reach.mesh_W.positions[reach.mesh_W.indices[i + 2]];
      EXPECT_GT((b - a).cross(c - a).y(), 0);
    }
  }
}

TEST(RiverReach, what_has_no_width_has_no_reach) {
  picture::MeshData line;
  line.positions = {{0, 0, -1}, {0, 0, 1}};
  EXPECT_TRUE(river_reach(line, Eigen::Affine3f::Identity(), Vec3f::UnitZ()).mesh_W.indices.empty());
  EXPECT_TRUE(river_reach({}, Eigen::Affine3f::Identity(), Vec3f::UnitZ()).mesh_W.indices.empty());
}

}  // namespace
}  // namespace mechane::scene
