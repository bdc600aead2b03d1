// A light in the dark, and where geometry says that it is seen.
#pragma once

#include <cmath>

#include "client-sdk/draw/text/overlay_layout.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"
#include "client-sdk/picture/render_scene.hpp"

namespace mechane::draw {

/// Pixels from the picture's upper left corner, of a point seen by a camera at the origin that looks along -z, with the eye `e` metres
/// to the right and a screen at distance D: by similar triangles, not by the renderer's matrices.
inline Eigen::Vector2d seen_at(const Vec3& p, double e, double D, double fov, double width, double height) {
  const double scale = 0.5 * height / (D * std::tan(fov / 2));
  const double x = e + (p.x() - e) * D / -p.z();
  const double y = p.y() * D / -p.z();
  return {0.5 * width + x * scale, 0.5 * height - y * scale};
}

struct Blob {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double weight = 0;
};

/// Centre of the light in a part of the picture, counted from the part's corner; of every `step`th row; channel 0 red .. 2 blue.
inline Blob blob(const picture::ImageData& image, const PixelRectangle& part, std::uint32_t step = 1,
                 std::size_t channel = 0) {
  Blob out;
  for (std::uint32_t y = 0; y < part.height; y += step) {
    for (std::uint32_t x = 0; x < part.width; ++x) {
      const double w = image.rgba[4 * (std::size_t{part.y + y} * image.width + part.x + x) + channel];
      out.middle += w * Eigen::Vector2d(x + 0.5, y + 0.5);
      out.weight += w;
    }
  }
  if (out.weight > 0) out.middle /= out.weight;
  return out;
}

/// A small glowing sphere in the dark.
struct Lamp {
  picture::SceneAssets assets;
  picture::RenderScene scene;

  explicit Lamp(const Vec3& p_W) {
    assets.meshes.push_back(picture::sphere_mesh(0.02, 24, 32));
    picture::MaterialData glow;
    glow.base_colour = Eigen::Vector4f(0, 0, 0, 1);
    // As bright as a screen shows: what is brighter has a glow about it.
    glow.emissive = Vec3f::Constant(1.2F);
    assets.materials.push_back(glow);
    picture::Instance lamp;
    lamp.X_WM.translation() = p_W.cast<float>();
    scene.instances.push_back(lamp);
    scene.sky = false;
    scene.sun.irradiance = Vec3f::Zero();
    scene.shadow_box_W = Eigen::AlignedBox3f(Vec3f(-1, -1, -4), Vec3f(1, 1, 0));
    scene.camera.p_WC = Vec3::Zero();
    scene.camera.p_WT = Vec3(0, 0, -1.5);
    scene.camera.eye_distance_m = 0.10;
  }
};

}  // namespace mechane::draw
