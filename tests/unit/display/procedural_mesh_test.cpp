#include "client-sdk/display/procedural_mesh.hpp"

#include <gtest/gtest.h>

#include "client-sdk/display/display_app.hpp"
#include "client-sdk/display/sky_light.hpp"

namespace mechane::display {
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

TEST(SkyLight, an_even_sky_lights_evenly) {
  constexpr PixelSize kMap{96, 48};
  const std::vector<Vec3f> map(std::size_t{kMap.width} * kMap.height, Vec3f(1, 0.5F, 0.25F));
  const SkyHarmonics sh = project_sky(map, kMap);
  for (const Vec3f& n : {Vec3f(0, 1, 0), Vec3f(0.6F, 0, 0.8F), Vec3f(0, -1, 0)}) {
    EXPECT_NEAR(irradiance(sh, n).x(), kPi, 0.02);
    EXPECT_NEAR(irradiance(sh, n).z(), kPi / 4, 0.01);
  }
}

TEST(SkyLight, light_comes_from_where_the_sky_is_bright) {
  constexpr PixelSize kMap{96, 48};
  std::vector<Vec3f> map;
  for (std::uint32_t row = 0; row < kMap.height; ++row) {
    for (std::uint32_t column = 0; column < kMap.width; ++column) {
      // A clamped cosine about +x: its irradiance there is 2 pi / 3.
      map.push_back(Vec3f::Constant(std::max(0.0F, sky_map_direction(column, row, kMap).x())));
    }
  }
  const SkyHarmonics sh = project_sky(map, kMap);
  EXPECT_NEAR(irradiance(sh, Vec3f(1, 0, 0)).x(), 2 * kPi / 3, 0.06);
  EXPECT_LT(irradiance(sh, Vec3f(-1, 0, 0)).x(), 0.15F);
}

TEST(ParseSize, takes_sizes_and_tells_what_is_none) {
  EXPECT_EQ(parse_size("1280x720").value(), (PixelSize{1280, 720}));
  for (const char* bad : {"", "x", "1280", "1280x", "x720", "1280x720x", "-5x10", "99999x10", "12 x 9", "0x0"}) {
    const auto size = parse_size(bad);
    ASSERT_FALSE(size.has_value()) << bad;
    EXPECT_FALSE(size.error().remedy.empty());
  }
}

}  // namespace
}  // namespace mechane::display
