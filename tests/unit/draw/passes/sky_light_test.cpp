#include "client-sdk/draw/passes/sky_light.hpp"

#include <gtest/gtest.h>

namespace mechane::draw {
namespace {

TEST(SkyLight, an_even_sky_lights_evenly) {
  constexpr picture::PixelSize kMap{96, 48};
  const std::vector<Vec3f> map(std::size_t{kMap.width} * kMap.height, Vec3f(1, 0.5F, 0.25F));
  const SkyHarmonics sh = project_sky(map, kMap);
  for (const Vec3f& n : {Vec3f(0, 1, 0), Vec3f(0.6F, 0, 0.8F), Vec3f(0, -1, 0)}) {
    EXPECT_NEAR(irradiance(sh, n).x(), kPi, 0.02);
    EXPECT_NEAR(irradiance(sh, n).z(), kPi / 4, 0.01);
  }
}

TEST(SkyLight, light_comes_from_where_the_sky_is_bright) {
  constexpr picture::PixelSize kMap{96, 48};
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

}  // namespace
}  // namespace mechane::draw
