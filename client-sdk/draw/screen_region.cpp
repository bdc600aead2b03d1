#include "client-sdk/draw/screen_region.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::draw {
namespace {

/// Shadows that are longer than three times their thing's height have no useful bound.
constexpr float kLowestSun = 0.3F;
constexpr float kNearestW = 1e-3F;
/// The side of a cell, pixels.
constexpr int kCell = 32;

bool overlap(const ScreenRegion& a, const ScreenRegion& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

ScreenRegion around(const ScreenRegion& a, const ScreenRegion& b) {
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right), std::max(a.top, b.top)};
}

}  // namespace

ScreenRegion whole_region(picture::PixelSize size) {
  return {0, 0, static_cast<int>(size.width), static_cast<int>(size.height)};
}

ScreenRegion region_of(const Eigen::Matrix4f& PV, std::span<const Vec3f> points_W, picture::PixelSize size) {
  const ScreenRegion whole = whole_region(size);
  Eigen::AlignedBox2f box;
  for (const Vec3f& p_W : points_W) {
    const Eigen::Vector4f clip = PV * p_W.homogeneous();
    if (clip.w() < kNearestW) return whole;
    box.extend(Eigen::Vector2f(clip.head<2>() / clip.w()));
  }
  if (box.isEmpty()) return {};
  const Eigen::Array2f pixels(static_cast<float>(size.width), static_cast<float>(size.height));
  // Cut off first: far beyond the picture, pixels would not fit into an int.
  const Eigen::Array2f low = (box.min().array().max(-1.5F).min(1.5F) * 0.5F + 0.5F) * pixels;
  const Eigen::Array2f high = (box.max().array().max(-1.5F).min(1.5F) * 0.5F + 0.5F) * pixels;
  return {std::clamp(static_cast<int>(std::floor(low.x())) - 1, 0, whole.right),
          std::clamp(static_cast<int>(std::floor(low.y())) - 1, 0, whole.top),
          std::clamp(static_cast<int>(std::ceil(high.x())) + 1, 0, whole.right),
          std::clamp(static_cast<int>(std::ceil(high.y())) + 1, 0, whole.top)};
}

std::vector<Vec3f> corners_with_shadow(const Eigen::AlignedBox3f& box_W, const Vec3f& to_sun_W, float floor_m) {
  std::vector<Vec3f> out;
  if (box_W.isEmpty() || to_sun_W.y() < kLowestSun) return out;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p_W = box_W.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
    out.push_back(p_W);
    out.emplace_back(p_W - to_sun_W * (std::max(p_W.y() - floor_m, 0.0F) / to_sun_W.y()));
  }
  return out;
}

std::vector<ScreenRegion> merged(std::vector<ScreenRegion> regions) {
  std::vector<ScreenRegion> out;
  while (!regions.empty()) {
    ScreenRegion one = regions.back();
    regions.pop_back();
    if (one.empty()) continue;
    const auto other = std::ranges::find_if(out, [&](const ScreenRegion& r) { return overlap(r, one); });
    if (other == out.end()) {
      out.push_back(one);
    } else {
      regions.push_back(around(*other, one));  // may now overlap a third one
      out.erase(other);
    }
  }
  return out;
}

std::vector<ScreenRegion> covered(std::span<const ScreenRegion> regions, picture::PixelSize size) {
  const ScreenRegion whole = whole_region(size);
  const auto columns = static_cast<std::size_t>((whole.right + kCell - 1) / kCell);
  const auto rows = static_cast<std::size_t>((whole.top + kCell - 1) / kCell);
  std::vector<std::vector<bool>> cells(rows, std::vector<bool>(columns));
  for (const ScreenRegion& region : regions) {
    if (region.empty()) continue;
    for (int row = region.bottom / kCell; row * kCell < region.top; ++row)
      for (int column = region.left / kCell; column * kCell < region.right; ++column)
        cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = true;
  }
  std::vector<ScreenRegion> out;
  std::vector<ScreenRegion> below;  // of the last row: equal runs of cells become one region
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<ScreenRegion> runs;
    const int bottom = static_cast<int>(row) * kCell;
    for (std::size_t column = 0; column < columns; ++column) {
      if (!cells[row][column]) continue;
      const int left = static_cast<int>(column) * kCell;
      const bool goes_on = !runs.empty() && runs.back().right == left;
      if (!goes_on) runs.push_back({left, bottom, left, std::min(bottom + kCell, whole.top)});
      runs.back().right = std::min(left + kCell, whole.right);
    }
    for (ScreenRegion& run : runs) {
      const auto same = std::ranges::find_if(
          below, [&run](const ScreenRegion& r) { return r.left == run.left && r.right == run.right; });
      if (same == below.end()) continue;
      run.bottom = same->bottom;
      below.erase(same);
    }
    out.insert(out.end(), below.begin(), below.end());
    below = std::move(runs);
  }
  out.insert(out.end(), below.begin(), below.end());
  return out;
}

Eigen::Matrix4f crop_to(const ScreenRegion& region, picture::PixelSize size) {
  const auto width = static_cast<float>(size.width);
  const auto height = static_cast<float>(size.height);
  Eigen::Matrix4f out = Eigen::Matrix4f::Identity();
  out(0, 0) = width / static_cast<float>(region.right - region.left);
  out(1, 1) = height / static_cast<float>(region.top - region.bottom);
  out(0, 3) = (width - static_cast<float>(region.left + region.right)) / static_cast<float>(region.right - region.left);
  out(1, 3) =
      (height - static_cast<float>(region.bottom + region.top)) / static_cast<float>(region.top - region.bottom);
  return out;
}

}  // namespace mechane::draw
