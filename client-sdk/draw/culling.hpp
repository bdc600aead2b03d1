// What of a scene can be in a picture at all: boxes against the picture's edges, and large meshes cut into pieces that have a box each.
#pragma once

#include <cstdint>
#include <vector>

#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// Whether no part of the box can be within the picture. PV_MC: from the mesh's frame to clip space. Boxes across a corner may be taken for
/// seen; one that is seen is never taken for hidden. An empty box is outside.
[[nodiscard]] bool is_outside(const Eigen::Matrix4f& PV_MC, const Eigen::AlignedBox3f& box_M);

/// How far the box is from the eye; 0 within it.
[[nodiscard]] float distance_m(const Eigen::Affine3f& X_WM, const Eigen::AlignedBox3f& box_M, const Vec3f& p_WE);

/// Some triangles of a mesh that lie near each other.
struct MeshPiece {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  Eigen::AlignedBox3f box_M;
};

/// The mesh's triangles in another order, piece after piece; each of at most `most` triangles.
struct PiecedIndices {
  std::vector<std::uint32_t> indices;
  std::vector<MeshPiece> pieces;
};
[[nodiscard]] PiecedIndices cut_up(const picture::MeshData& mesh, std::uint32_t most);

}  // namespace mechane::draw
