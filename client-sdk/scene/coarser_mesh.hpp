// Levels of detail of an imported mesh: the same vertices in fewer triangles, for where it is small in the picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/content/imported_scene.hpp"

namespace mechane::scene {

/// How far the surface of each level lies from the mesh at most, metres in the mesh's own frame. A mean over planes near
/// each vertex says so: single places may lie twice as far.
inline constexpr std::array<float, 6> kLevelErrors_m{0.0003F, 0.001F, 0.003F, 0.01F, 0.03F, 0.1F};

/// Indices of each level's triangles.
using CoarserMeshes = std::array<std::vector<std::uint32_t>, kLevelErrors_m.size()>;

/// By meshoptimizer: edges collapse in the order of their quadric error (Garland & Heckbert 1997). Open borders stay, so
/// that parts of different materials still meet, and leaves stay leaves. Takes about a second for a million triangles.
[[nodiscard]] CoarserMeshes coarser_meshes(const content::ImportedMesh& mesh);

}  // namespace mechane::scene
