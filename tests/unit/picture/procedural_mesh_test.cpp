#include "client-sdk/picture/procedural_mesh.hpp"

#include <gtest/gtest.h>

namespace mechane::picture {
namespace {

TEST(ProceduralMesh, faces_and_normals_look_outwards) {
  for (const MeshData& mesh : {sphere_mesh(0.1, 12, 16), box_mesh(Vec3(0.1, 0.2, 0.3)), phalanx_mesh(0.05, 0.01, 0.2),
                               superquadric_mesh(Vec3(0.05, 0.014, 0.04), 0.5, 0.6, 16, 16)}) {
    double volume = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Vec3f& a = mesh.positions[mesh.indices[i]];
      const Vec3f& b = mesh.positions[mesh.indices[i + 1]];
      const Vec3f& c = mesh.positions[mesh.indices[i + 2]];
      volume += static_cast<double>(a.dot(b.cross(c))) / 6;
    }
    EXPECT_GT(volume, 1e-7) << "closed, and wound counter-clockwise from outside";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_NEAR(mesh.normals[i].norm(), 1.0F, 1e-4F);
      EXPECT_GT(mesh.normals[i].dot(mesh.positions[i]), 0.0F);
    }
  }
}

TEST(ProceduralMesh, falling_water_lands_where_a_stone_would) {
  WaterStream stream;
  stream.p_WS = Vec3f(0, 1.2F, 0);
  stream.v_W = Vec3f(0.5F, 0, 0);
  stream.landing_height_m = 0.5F;
  stream.width_m = 0.04F;
  const MeshData mesh = stream_mesh(stream);
  Vec3f end = Vec3f::Zero();
  constexpr std::size_t kLastRing = 13;
  for (std::size_t i = mesh.positions.size() - kLastRing; i + 1 < mesh.positions.size(); ++i)
    end += mesh.positions[i] / 12.0F;
  const float flight_s = std::sqrt(2 * 0.7F / 9.81F);
  EXPECT_NEAR(end.x(), 0.5F * flight_s, 2e-3F);
  EXPECT_NEAR(end.y(), 0.5F, 2e-3F);
}

}  // namespace
}  // namespace mechane::picture
