// Culling: tests boxes against the edges of the picture, and cuts large meshes into pieces with a box each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// Whether no part of the box can be in the picture. PV_MC: from the mesh's frame to clip space. Conservative: a hidden
/// box across a corner may count as visible, but never the reverse. An empty box is outside.
[[nodiscard]] bool is_outside(const Eigen::Matrix4f& PV_MC, const Eigen::AlignedBox3f& box_M);

/// Distance from the eye to the box; 0 inside it.
[[nodiscard]] float distance_m(const Eigen::Affine3f& X_WM, const Eigen::AlignedBox3f& box_M, const Vec3f& p_WE);

/// What a pixel of the picture spans at this distance from the eye, metres.
[[nodiscard]] float pixel_m(const picture::EyeView& view, picture::PixelSize size, float distance_m);

/// How much a pose enlarges a mesh at most.
[[nodiscard]] float scale_of(const Eigen::Affine3f& X_WM);

/// Some triangles of a mesh that lie near each other.
struct MeshPiece {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Eigen::AlignedBox3f box_M;
};

/// A mesh's triangles reordered into pieces of at most `most` triangles. `indices`: of its own or a coarser level's.
struct PiecedIndices {
  std::vector<std::uint32_t> indices;
  std::vector<MeshPiece> pieces;
};
[[nodiscard]] PiecedIndices cut_up(const picture::MeshData& mesh, std::span<const std::uint32_t> indices,
                                   std::uint32_t most);

}  // namespace mechane::draw
