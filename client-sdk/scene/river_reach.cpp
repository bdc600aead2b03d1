#include "client-sdk/scene/river_reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mechane::scene {
namespace {

constexpr float kReach_m = 240;  // beyond it, haze hides everything
constexpr int kRows = 64;
/// The modelled water is wider than what is visible between its banks.
constexpr float kSeenShare = 0.86F;
constexpr float kBend_m = 7;
constexpr float kBendLength_m = 27;

/// The river's sideways offset after this distance; it is straight at first.
float bend_m(float along_m) {
  const float begun = std::min(along_m / (2 * kBendLength_m), 1.0F);
  return kBend_m * begun * begun *
         (std::sin(along_m / kBendLength_m) + 0.5F * std::sin(along_m / (2.3F * kBendLength_m) + 1));
}

}  // namespace

RiverReach river_reach(const picture::MeshData& water_M, const Eigen::Affine3f& X_WM, const Vec3f& direction_W) {
  RiverReach out;
  const Vec3f along_W = Vec3f(direction_W.x(), 0, direction_W.z()).normalized();
  const Vec3f across_W = along_W.cross(Vec3f::UnitY());
  float first = std::numeric_limits<float>::max();
  float last = -first;
  for (const Vec3f& p_M : water_M.positions) {
    const float s = along_W.dot(X_WM * p_M);
    first = std::min(first, s);
    last = std::max(last, s);
  }
  // The border where the mesh ends, however slanted its rows are.
  const float within = std::max(0.04F * (last - first), 1e-3F);
  Eigen::AlignedBox3f border;  // along, height, across
  for (const Vec3f& p_M : water_M.positions) {
    const Vec3f p_W = X_WM * p_M;
    if (along_W.dot(p_W) > last - within) border.extend(Vec3f(along_W.dot(p_W), p_W.y(), across_W.dot(p_W)));
  }
  if (border.isEmpty() || border.sizes().z() < 0.05F) return out;
  out.width_m = kSeenShare * border.sizes().z();
  const float begin = border.min().x();
  for (int row = 0; row <= kRows; ++row) {
    const float share = static_cast<float>(row) / kRows;
    const float along_m = kReach_m * share * share;
    const float middle = border.center().z() + bend_m(along_m);
    for (const float side : {0.0F, 1.0F}) {
      Vec3f p_W = (begin + along_m) * along_W + (middle + (side - 0.5F) * out.width_m) * across_W;
      p_W.y() = border.center().y();
      out.mesh_W.positions.push_back(p_W);
      out.mesh_W.normals.push_back(Vec3f::UnitY());
      out.mesh_W.uv.emplace_back(side, along_m);
    }
    if (row == 0) continue;
    const auto k = static_cast<std::uint32_t>(2 * row);
    out.mesh_W.indices.insert(out.mesh_W.indices.end(), {k - 2, k - 1, k, k, k - 1, k + 1});
  }
  return out;
}

}  // namespace mechane::scene
