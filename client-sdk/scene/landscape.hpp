// The landscape around an exhibit without one of its own: olives in loose groves, some cypresses, brush. It fills the
// distance between the machine and the hills, especially in stereo. It cannot be touched, and casts only its own simple
// shadows.
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

/// Where plants may grow.
struct LandscapePlan {
  Vec3f middle_W = Vec3f::Zero();  ///< on the ground, in the middle of scenery and viewpoint
  float clearing_m = 0;            ///< radius without plants, where people stand and stones fly
  Vec3f to_sun_W = Vec3f::UnitY();
  std::uint32_t seed = 0;                        ///< another seed gives other trees
  std::vector<std::array<Vec3f, 3>> waters_W{};  ///< triangles: nothing grows in them, nor on their banks
};

/// Adds the triangles of a water's mesh; at most some hundreds, because each plant is tested against all.
void add_water(const picture::MeshData& mesh_M, const Eigen::Affine3f& X_WM, LandscapePlan& plan);

/// The plants of a plan: always the same, in no particular order.
[[nodiscard]] std::vector<Plant> plants_of(const LandscapePlan& plan);

/// Meshes of plants, one per material, in W.
struct PlantMeshes {
  picture::MeshData bark, pale, dark, cypress;
  picture::MeshData shade;  ///< on the ground
};

/// Plants farther from the middle have fewer and larger leaves. Slow; any thread.
[[nodiscard]] PlantMeshes grow(const LandscapePlan& plan, const std::vector<Plant>& plants);

/// Adds the meshes to the library, each with its material.
[[nodiscard]] std::vector<picture::Instance> add_plants(PlantMeshes meshes, AssetLibrary& library);

}  // namespace mechane::scene
