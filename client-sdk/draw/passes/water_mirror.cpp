#include "client-sdk/draw/passes/water_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "client-sdk/picture/box_corners.hpp"

namespace mechane::draw {
namespace {

constexpr float kLevel_m = 0.005F;

Eigen::AlignedBox3f box_of(const picture::WaterInstance& water, const GpuAssets& assets) {
  Eigen::AlignedBox3f box_W;
  for (const MeshPiece& piece : assets.pieces(water.mesh)) {
    box_W.extend(picture::moved(piece.box_M, water.X_WM));
  }
  return box_W;
}

/// Approximately the solid angle of its visible part.
float seen_share(const picture::WaterInstance& water, const GpuAssets& assets, const picture::EyeView& view) {
  const Eigen::Matrix4f PV_MC = view.P * view.V_CW * water.X_WM.matrix();
  float sum = 0;
  for (const MeshPiece& piece : assets.pieces(water.mesh)) {
    if (is_outside(PV_MC, piece.box_M)) continue;
    const Vec3f size_m = piece.box_M.sizes();
    const float away_m = std::max(distance_m(water.X_WM, piece.box_M, view.p_WE), 0.3F);
    sum += size_m.x() * size_m.z() / (away_m * away_m * away_m);
  }
  return sum;
}

}  // namespace

std::optional<float> level_m(const picture::WaterInstance& water, const GpuAssets& assets) {
  const Eigen::AlignedBox3f box_W = box_of(water, assets);
  if (box_W.isEmpty() || box_W.sizes().y() > 2 * kLevel_m) return std::nullopt;
  return box_W.center().y();
}

bool is_same_level(float a_m, float b_m) {
  return std::abs(a_m - b_m) < kLevel_m;
}

std::optional<float> mirror_level_m(const picture::RenderScene& scene, const GpuAssets& assets,
                                    const picture::EyeView& view) {
  struct Level {
    float height_m = 0;
    float share = 0;
  };
  std::vector<Level> levels;
  for (const picture::WaterInstance& water : scene.waters) {
    const std::optional<float> height_m = level_m(water, assets);
    if (!height_m || view.p_WE.y() < *height_m + 0.02F) continue;
    const float share = (view.p_WE.y() - *height_m) * seen_share(water, assets, view);
    const auto same =
        std::ranges::find_if(levels, [&](const Level& l) { return is_same_level(l.height_m, *height_m); });
    if (same == levels.end()) {
      levels.push_back({*height_m, share});
    } else {
      same->share += share;
    }
  }
  const auto most = std::ranges::max_element(levels, {}, &Level::share);
  if (most == levels.end() || most->share <= 0) return std::nullopt;
  return most->height_m;
}

picture::EyeView mirrored(const picture::EyeView& view, float level_m) {
  Eigen::Matrix4f S_WW = Eigen::Matrix4f::Identity();
  S_WW(1, 1) = -1;
  S_WW(1, 3) = 2 * level_m;
  picture::EyeView out = view;
  out.V_CW = view.V_CW * S_WW;
  out.p_WE.y() = 2 * level_m - view.p_WE.y();
  return out;
}

}  // namespace mechane::draw
