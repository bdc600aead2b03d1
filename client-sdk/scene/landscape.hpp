// The landscape around an exhibit that brings none of its own: olives in loose groves, some cypresses, brush. It gives the eye
// something between the machine and the hills, in stereo most of all. Scenery: nobody touches it, and it throws no shadows but its own.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client-sdk/picture/render_scene.hpp"
#include "client-sdk/scene/asset_library.hpp"

namespace mechane::scene {

struct Plant {
  enum class Kind : std::uint8_t { olive, cypress, brush };
  Kind kind = Kind::olive;
  Vec3f p_W = Vec3f::Zero();
  float height_m = 1;
  std::uint32_t seed = 0;  ///< of its shape
};

/// Where things may grow.
struct LandscapePlan {
  Vec3f middle_W = Vec3f::Zero();  ///< on the ground, amid scenery and viewpoint
  float clearing_m = 0;            ///< about the middle, nothing grows: there people stand, stones fly
  Vec3f to_sun_W = Vec3f::UnitY();
  std::uint32_t seed = 0;                        ///< another number, other trees
  std::vector<std::array<Vec3f, 3>> waters_W{};  ///< triangles: nothing grows in them, nor on their banks
};

/// Adds the triangles of a water's mesh, of some hundreds: each place is held against each.
void add_water(const picture::MeshData& mesh_M, const Eigen::Affine3f& X_WM, LandscapePlan& plan);

/// The same plan has the same plants, the nearest not always first.
[[nodiscard]] std::vector<Plant> plants_of(const LandscapePlan& plan);

/// Meshes of plants, one a material, in W.
struct PlantMeshes {
  picture::MeshData bark, pale, dark, cypress;
  picture::MeshData shade;  ///< on the ground
};

/// The farther a plant is from the middle, the fewer and larger are its leaves. Slow; any thread.
[[nodiscard]] PlantMeshes grow(const LandscapePlan& plan, const std::vector<Plant>& plants);

/// Adds the meshes to the library, each with its material.
[[nodiscard]] std::vector<picture::Instance> add_plants(PlantMeshes meshes, AssetLibrary& library);

}  // namespace mechane::scene
