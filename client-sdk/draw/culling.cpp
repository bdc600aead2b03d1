#include "client-sdk/draw/culling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace mechane::draw {
namespace {

/// Halves the triangles along the longest side of their centroids' box, until pieces are small enough.
void halve(const picture::MeshData& mesh, std::span<const std::uint32_t> indices, const std::vector<Vec3f>& middles,
           std::span<std::uint32_t> triangles, std::uint32_t most, PiecedIndices& out) {
  if (triangles.size() <= most) {
    // Within a piece, the file's order is kept.
    std::ranges::sort(triangles);
    MeshPiece piece{
        static_cast<std::uint32_t>(out.indices.size()), static_cast<std::uint32_t>(3 * triangles.size()), {}};
    for (const std::uint32_t triangle : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = indices[std::size_t{3} * triangle + k];
        out.indices.push_back(vertex);
        piece.box_M.extend(mesh.positions[vertex]);
      }
    }
    out.pieces.push_back(piece);
    return;
  }
  Eigen::AlignedBox3f box;
  for (const std::uint32_t triangle : triangles)
    box.extend(middles[triangle]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t half = triangles.size() / 2;
  std::ranges::nth_element(triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](std::uint32_t triangle) { return middles[triangle](axis); });
  halve(mesh, indices, middles, triangles.first(half), most, out);
  halve(mesh, indices, middles, triangles.subspan(half), most, out);
}

}  // namespace

bool is_outside(const Eigen::Matrix4f& PV_MC, const Eigen::AlignedBox3f& box_M) {
  if (box_M.isEmpty()) return true;
  // For each of the six sides of clip space: is every corner beyond it?
  std::array<int, 6> beyond{};
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector4f c = PV_MC * box_M.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)).homogeneous();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float at = c(static_cast<Eigen::Index>(axis));
      beyond[2 * axis] += at > c.w() ? 1 : 0;
      beyond[2 * axis + 1] += at < -c.w() ? 1 : 0;
    }
  }
  return std::ranges::find(beyond, 8) != beyond.end();
}

float distance_m(const Eigen::Affine3f& X_WM, const Eigen::AlignedBox3f& box_M, const Vec3f& p_WE) {
  Eigen::AlignedBox3f box_W;
  for (int i = 0; i < 8; ++i)
    box_W.extend(X_WM * box_M.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)));
  return box_W.exteriorDistance(p_WE);
}

float pixel_m(const picture::EyeView& view, picture::PixelSize size, float distance_m) {
  return 2 * distance_m / (std::abs(view.P(1, 1)) * static_cast<float>(size.height));
}

float scale_of(const Eigen::Affine3f& X_WM) {
  return X_WM.linear().colwise().norm().maxCoeff();
}

PiecedIndices cut_up(const picture::MeshData& mesh, std::span<const std::uint32_t> indices, std::uint32_t most) {
  PiecedIndices out;
  const std::size_t count = indices.size() / 3;
  if (count == 0) return out;
  std::vector<Vec3f> middles;
  middles.reserve(count);
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    middles.emplace_back(
        (mesh.positions[indices[i]] + mesh.positions[indices[i + 1]] + mesh.positions[indices[i + 2]]) / 3.0F);
  }
  std::vector<std::uint32_t> triangles(count);
  std::iota(triangles.begin(), triangles.end(), 0U);
  out.indices.reserve(3 * count);
  halve(mesh, indices, middles, triangles, std::max(most, 1U), out);
  return out;
}

}  // namespace mechane::draw
