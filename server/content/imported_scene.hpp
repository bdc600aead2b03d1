// What a mesh file holds, in our own terms: read by the collision builder (parts) and by the display (everything).
// Comes from import_mesh (mesh_import.hpp); nothing here knows assimp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::content {

/// A frame of the file's tree. P is the parent's frame, N the node's own. Scales are allowed: not every file is rigid.
struct ImportedNode {
  std::string name;
  std::optional<std::uint32_t>
      parent;  ///< into ImportedScene::nodes, always smaller than the node's own index; none for a root
  Eigen::Affine3d X_PN = Eigen::Affine3d::Identity();
  std::vector<std::uint32_t> meshes;  ///< into ImportedScene::meshes
};

/// Triangles with one material, vertices split where normals or uv differ (as a GPU wants them). Metres, in the node's
/// frame. `normals`, `tangents` and `uv` are empty or as long as `positions`.
struct ImportedMesh {
  std::string name;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;             ///< unit
  std::vector<Eigen::Vector4f> tangents;  ///< xyz unit along +u; w = +1 or -1: w * normal x tangent points to the
                                          ///< image's upper edge
  std::vector<Eigen::Vector2f> uv;        ///< (0, 0) is the upper left corner of the image, as in glTF
  std::vector<std::uint32_t> indices;     ///< three a triangle, counter-clockwise seen from outside
  std::uint32_t material = 0;             ///< into ImportedScene::materials
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Metallic-roughness, as in glTF 2.0. Colours are linear; factors multiply the textures. Textures index
/// ImportedScene::textures.
struct ImportedMaterial {
  std::string name;
  Eigen::Vector4f base_colour = Eigen::Vector4f::Ones();
  Vec3f emissive = Vec3f::Zero();
  float metallic = 0;
  float roughness = 0.8F;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;  ///< for AlphaMode::mask
  bool double_sided = false;
  float occlusion_strength = 1;                             ///< how much of the occlusion image counts, 0..1
  std::optional<std::uint32_t> base_colour_texture;         ///< sRGB, alpha is opacity
  std::optional<std::uint32_t> normal_texture;              ///< tangent space, linear
  std::optional<std::uint32_t> metallic_roughness_texture;  ///< green is roughness, blue is metallic, linear
  std::optional<std::uint32_t> emissive_texture;            ///< sRGB
  std::optional<std::uint32_t> occlusion_texture;           ///< red: share of the light from all around, linear
};

enum class TextureEncoding : std::uint8_t { png, jpeg, rgba8 };

/// An image. `png` and `jpeg` hold the file's own bytes, not decoded; `rgba8` holds width * height * 4 bytes, upper row
/// first.
struct ImportedTexture {
  std::string name;
  TextureEncoding encoding = TextureEncoding::png;
  std::uint32_t width = 0;   ///< 0 unless rgba8
  std::uint32_t height = 0;  ///< 0 unless rgba8
  std::vector<std::byte> bytes;
};

/// One mesh file. Import and decode guarantee: every index is in range, every number finite, parents come before
/// children.
struct ImportedScene {
  std::vector<ImportedNode> nodes;
  std::vector<ImportedMesh> meshes;
  std::vector<ImportedMaterial> materials;  ///< at least one when there is a mesh
  std::vector<ImportedTexture> textures;
};

/// The first node of that name.
[[nodiscard]] std::optional<std::uint32_t> find_node(const ImportedScene& scene, const std::string& name);

/// True if `node` is `ancestor` or lies below it.
[[nodiscard]] bool is_under(const ImportedScene& scene, std::uint32_t node, std::uint32_t ancestor);

/// The pose of `node` in the frame of `ancestor` (which must be the node itself or lie above it), or in the file's
/// frame F when `ancestor` is absent.
[[nodiscard]] Eigen::Affine3d pose_in(const ImportedScene& scene, std::uint32_t node,
                                      std::optional<std::uint32_t> ancestor);

/// The meshes to be touched, in the frame of `node` (of the file when `node` is empty): every node at or below it whose
/// name starts with "part_", meshes of nodes below a part included in it; when none is so named, every node with a mesh
/// is a part. Vertices at the same place are welded (a file splits them where normals differ), so that a closed surface
/// comes out closed; triangles that collapse are dropped. Fails when the node does not exist, nothing is left to touch, or
/// there are more triangles than ImportLimits{}.triangles, counted wherever a mesh is placed.
[[nodiscard]] Expected<std::vector<geometry::NamedMesh>> collision_parts(const ImportedScene& scene,
                                                                         const std::string& node);

}  // namespace mechane::content
