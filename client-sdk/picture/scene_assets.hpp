// Meshes, materials and images that scenes are drawn with. `SceneAssets` only ever grows. M is a mesh's own frame;
// colours are linear unless stated otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::picture {

/// A mesh in fewer triangles, of its own vertices.
struct CoarserMesh {
  float error_m = 0;  ///< its surface lies no farther from the mesh
  std::vector<std::uint32_t> indices;
};

/// Triangles for one draw call. `normals` is as long as `positions`; `tangents` and `uv` may be empty.
struct MeshData {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;             ///< unit
  std::vector<Eigen::Vector4f> tangents;  ///< xyz along +u; w is the sign of the bitangent
  std::vector<Eigen::Vector2f> uv;        ///< (0, 0) is the image's upper left corner
  std::vector<std::uint32_t> indices;     ///< three a triangle, counter-clockwise seen from outside
  std::string name{};                     ///< for messages: "machine.glb#WHEEL"; empty: made by the display itself
  std::vector<CoarserMesh> coarser{};     ///< the finest first
};

/// Eight bits a channel, upper row first.
struct ImageData {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
  bool srgb = true;    ///< colour; false: numbers such as normals
  std::string name{};  ///< for messages: "machine.glb, texture oak"; empty: made by the display itself
};

/// Metallic-roughness, as glTF has it. Textures index SceneAssets::images.
struct MaterialData {
  Eigen::Vector4f base_colour = Eigen::Vector4f::Ones();
  Vec3f emissive = Vec3f::Zero();
  float metallic = 0;
  float roughness = 0.8F;
  float occlusion_strength = 1;  ///< how much of its occlusion image counts, 0..1
  float alpha_cutoff = 0;        ///< above 0: fragments with less opacity are not drawn
  bool clear = false;            ///< transparent by base_colour's opacity, drawn last and sorted; casts no shadow
  bool double_sided = false;
  bool land =
      false;  ///< earth: looks like the surrounding plain, whatever its own colours; its images give the texture
  std::optional<std::uint32_t> base_colour_image;
  std::optional<std::uint32_t> normal_image;
  std::optional<std::uint32_t> metallic_roughness_image;
  std::optional<std::uint32_t> emissive_image;
  std::optional<std::uint32_t> occlusion_image;  ///< red: share of the sky's light that arrives
};

struct SceneAssets {
  std::vector<MeshData> meshes;
  std::vector<MaterialData> materials;
  std::vector<ImageData> images;
};

}  // namespace mechane::picture
