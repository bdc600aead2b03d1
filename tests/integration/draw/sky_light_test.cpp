// The sky as rough things mirror it, held against sums over the whole sphere.
#include "client-sdk/draw/passes/sky_light.hpp"

#include <cmath>
#include <span>
#include <vector>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/sky_cube.hpp"
#include "tests/integration/draw/drawn_picture.hpp"

namespace mechane::draw {
namespace {

using Texels = std::vector<Vec3f>;

constexpr std::size_t kFaceTexels = std::size_t{kSkyFace} * kSkyFace;

/// With all smaller copies, as draw_sky_cube() makes one.
TextureName cube_of(const Texels& texels) {
  TextureName cube = make_texture();
  glBindTexture(GL_TEXTURE_CUBE_MAP, cube.get());
  for (GLuint face = 0; face < 6; ++face)
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA16F, kSkyFace, kSkyFace, 0, GL_RGB, GL_FLOAT,
                 texels.data() + face * kFaceTexels);
  glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
  return cube;
}

Vec3f direction_of(std::size_t texel, std::uint32_t size) {
  const auto within = static_cast<std::uint32_t>(texel % (std::size_t{size} * size));
  return cube_direction(static_cast<std::uint32_t>(texel / (std::size_t{size} * size)), within % size, within / size,
                        size);
}

struct SharpTexel {
  Vec3 l;              // from the cube's centre to the texel
  double solid_angle;  // up to a factor
  Vec3 radiance;
};

/// Made once for all that `seen_by_mirror` is asked of a sky.
std::vector<SharpTexel> sharp_texels(const Texels& sharp) {
  std::vector<SharpTexel> texels;
  texels.reserve(sharp.size());
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    const Vec3f l = direction_of(i, kSkyFace);
    const double largest = l.cwiseAbs().maxCoeff();
    texels.push_back({l.cast<double>(), largest * largest * largest, sharp[i].cast<double>()});
  }
  return texels;
}

/// What a mirror of this roughness sees straight on: radiance weighed by GGX and by its slant, over all texels of a sharp cube.
Vec3f seen_by_mirror(std::span<const SharpTexel> sharp, const Vec3f& n, double roughness) {
  const double a2 = std::pow(roughness, 4);
  const double nx = n.x(), ny = n.y(), nz = n.z();
  double sum_r = 0, sum_g = 0, sum_b = 0;  // plain numbers: a sanitizer makes vectors five times slower here
  double weights = 0;
  for (const SharpTexel& texel : sharp) {
    const double* l = texel.l.data();
    const double nl = nx * l[0] + ny * l[1] + nz * l[2];
    if (nl <= 0) continue;
    const double d = (1 + nl) / 2 * (a2 - 1) + 1;
    const double weight = nl * a2 / (d * d) * texel.solid_angle;
    const double* radiance = texel.radiance.data();
    sum_r += weight * radiance[0];
    sum_g += weight * radiance[1];
    sum_b += weight * radiance[2];
    weights += weight;
  }
  return (Vec3(sum_r, sum_g, sum_b) / weights).cast<float>();
}

double greatest_error(const Vec3f& found, const Vec3f& right) {
  return ((found - right).array() / right.array()).abs().maxCoeff();
}

/// A map by longitude and latitude, between its four nearest pixels.
Vec3f looked_up(const Texels& map, picture::PixelSize size, const Vec3f& d) {
  const auto width = static_cast<int>(size.width);
  const auto height = static_cast<int>(size.height);
  const float x = (std::atan2(d.x(), -d.z()) / (2 * static_cast<float>(kPi)) + 0.5F) * static_cast<float>(width) - 0.5F;
  const float y =
      std::acos(std::clamp(d.y(), -1.0F, 1.0F)) / static_cast<float>(kPi) * static_cast<float>(height) - 0.5F;
  const auto column = static_cast<int>(std::floor(x));
  const auto row = static_cast<int>(std::floor(y));
  const auto pixel = [&](int c, int r) {
    return map[static_cast<std::size_t>(std::clamp(r, 0, height - 1) * width + (c + width) % width)];
  };
  const float u = x - static_cast<float>(column);
  const float v = y - static_cast<float>(row);
  return (1 - v) * ((1 - u) * pixel(column, row) + u * pixel(column + 1, row)) +
         v * ((1 - u) * pixel(column, row + 1) + u * pixel(column + 1, row + 1));
}

/// Skylight on level ground is measured as daylight of 10,000 to 15,000 K; linear sRGB of CIE's daylight has this much more blue than red there.
constexpr float kBlueOverRed10000K = 1.70F;
constexpr float kBlueOverRed15000K = 2.29F;

class SkyLightColour : public DrawnPicture {};

TEST_F(SkyLightColour, is_that_of_measured_skylight) {
  const auto light = bake_sky(picture::Sun{});
  ASSERT_TRUE(light.has_value());
  const Vec3f level = irradiance(light->harmonics, Vec3f::UnitY());
  EXPECT_LT(level.z() / level.x(), kBlueOverRed15000K) << level.transpose();
  EXPECT_GT(level.z() / level.x(), kBlueOverRed10000K) << level.transpose();
}

class SkyCube : public DrawnPicture {
 protected:
  static Texels level(const TextureName& cube, int k) { return read_cube(cube, k); }
  static float roughness_of(int k) { return static_cast<float>(k) / (kSkyLevels - 1); }
};

TEST_F(SkyCube, a_smooth_mirror_sees_the_sky_itself) {
  const picture::Sun sun;
  constexpr picture::PixelSize kMap{1024, 512};
  const auto map = draw_sky_map(sun, kMap, Clouds::none);
  ASSERT_TRUE(map.has_value());
  const auto light = bake_sky(sun);
  ASSERT_TRUE(light.has_value());
  const Texels smooth = level(light->cube, 0);
  double worst = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i)
    worst = std::max(worst, greatest_error(smooth[i], looked_up(*map, kMap, direction_of(i, kSkyFace))));
  EXPECT_LT(worst, 0.03);
}

TEST_F(SkyCube, a_rough_mirror_sees_ggx_average_of_the_sky) {
  for (const Vec3f& to_sun : {picture::Sun{}.to_sun_W, Vec3f(-0.9F, 0.2F, -0.3F)}) {
    picture::Sun sun;
    sun.to_sun_W = to_sun;
    const auto sharp = draw_sky_cube(sun);
    ASSERT_TRUE(sharp.has_value());
    const auto rough = prefilter_sky(*sharp);
    ASSERT_TRUE(rough.has_value());
    const std::vector<SharpTexel> sky = sharp_texels(level(*sharp, 0));
    for (int k = 1; k < kSkyLevels; ++k) {
      const Texels blurred = level(*rough, k);
      const std::uint32_t size = kSkyFace >> k;
      // One in seventeen: of all faces, middle and rim; and where the sun's glow is.
      for (std::size_t i = 0; i < blurred.size(); i += 1 + blurred.size() / 97) {
        const Vec3f n = direction_of(i, size);
        EXPECT_LT(greatest_error(blurred[i], seen_by_mirror(sky, n, roughness_of(k))), 0.03)
            << "level " << k << " at " << n.transpose();
      }
    }
  }
}

TEST_F(SkyCube, an_even_sky_stays_even_at_each_level) {
  const Vec3f white(0.7F, 0.7F, 0.7F);
  const TextureName sharp = cube_of(Texels(6 * kFaceTexels, white));
  const auto rough = prefilter_sky(sharp);
  ASSERT_TRUE(rough.has_value());
  for (int k = 0; k < kSkyLevels; ++k) {
    for (const Vec3f& texel : level(*rough, k))
      ASSERT_LT(greatest_error(texel, white), 0.002) << "level " << k;
  }
}

TEST_F(SkyCube, something_small_and_bright_leaves_no_specks) {
  Texels sky(6 * kFaceTexels, Vec3f::Constant(0.3F));
  const std::size_t lamp = 4 * kFaceTexels + 31 * kSkyFace + 31;  // in the middle of +z
  for (const std::size_t i : {lamp, lamp + 1, lamp + kSkyFace, lamp + kSkyFace + 1})
    sky[i] = Vec3f::Constant(300);
  const auto rough = prefilter_sky(cube_of(sky));
  ASSERT_TRUE(rough.has_value());
  const std::vector<SharpTexel> texels = sharp_texels(sky);
  for (int k = 2; k < kSkyLevels; ++k) {
    const Texels blurred = level(*rough, k);
    const std::uint32_t size = kSkyFace >> k;
    for (std::size_t i = 0; i < blurred.size(); ++i) {
      const Vec3f right = seen_by_mirror(texels, direction_of(i, size), roughness_of(k));
      ASSERT_LT(greatest_error(blurred[i], right), 0.35) << "level " << k << " texel " << i;
    }
  }
}

/// A metal ball under a sky without sun: how sharply the horizon is seen in it.
TEST_F(SkyCube, the_rougher_the_metal_the_softer_is_what_it_mirrors) {
  picture::SceneAssets assets;
  assets.meshes.push_back(picture::sphere_mesh(0.5, 64, 96));
  picture::MaterialData metal;
  metal.metallic = 1;
  picture::RenderScene scene;
  for (std::uint32_t k = 0; k < 4; ++k) {
    metal.roughness = 0.05F + 0.3F * static_cast<float>(k);
    assets.materials.push_back(metal);
  }
  scene.sun.irradiance = Vec3f::Zero();
  scene.camera.p_WC = Vec3(0, 0, 3);
  scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-1, -1, -1), Vec3f(1, 1, 1));
  double sharper = 256;
  for (std::uint32_t k = 0; k < 4; ++k) {
    scene.instances.clear();
    add_instance(scene, 0, k, Vec3f::Zero());
    const picture::ImageData image = draw(assets, scene);
    double steepest = 0;
    for (double y = -0.35; y < 0.35; y += 0.01) {
      const auto brightness_at = [&](double height) {
        const Eigen::Vector2d at = pixel_of(scene, Vec3(0, height, std::sqrt(0.25 - height * height)));
        return mean(image, at.x(), at.y(), 1);
      };
      steepest = std::max(steepest, brightness_at(y + 0.03) - brightness_at(y));
    }
    EXPECT_LT(steepest, 0.85 * sharper) << "roughness " << assets.materials[k].roughness;
    sharper = steepest;
  }
  EXPECT_GT(sharper, 1) << "even the roughest has an above and a below";
}

}  // namespace
}  // namespace mechane::draw
