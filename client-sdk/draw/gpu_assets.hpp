// Meshes, materials and images on the graphics card. Grows with SceneAssets; nothing is removed before the renderer
// ends.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "client-sdk/draw/culling.hpp"
#include "client-sdk/draw/gl_object.hpp"
#include "client-sdk/draw/instance_runs.hpp"
#include "client-sdk/draw/shader.hpp"
#include "client-sdk/picture/scene_parts.hpp"

namespace mechane::draw {

/// One float vertex as the shaders read it: position 3, normal 3, tangent 4, uv 2.
inline constexpr int kVertexFloats = 12;

/// Describes the vertex format to the bound vertex array, from the bound array buffer.
void describe_vertices();

/// Interleaved vertices of a mesh; missing attributes get defaults.
[[nodiscard]] std::vector<float> interleave(const picture::MeshData& mesh);

/// A mesh that is made for each frame.
class StreamedMesh {
 public:
  /// Needs a current context, as all here does.
  [[nodiscard]] static StreamedMesh create();
  void upload(const picture::MeshData& mesh);
  [[nodiscard]] bool empty() const { return index_count_ == 0; }
  /// Like GpuAssets::draw.
  void draw() const;

 private:
  VertexArrayName vertex_array_;
  BufferName vertices_;
  BufferName indices_;
  std::int32_t index_count_ = 0;
};

class GpuAssets {
 public:
  /// Uploads what was added to `assets` since the last call. The earlier part must be unchanged. What does not fit on
  /// the card is logged; such a mesh is replaced by a plain box, such an image is left out of its materials.
  void upload(const picture::SceneAssets& assets);
  /// Names of the meshes and images that did not fit on the card.
  [[nodiscard]] const std::set<std::string>& refused() const { return refused_; }
  /// Draws the triangles; the program, with its uniforms, must be in use.
  void draw(std::uint32_t mesh) const;
  /// A level of detail: a mesh's pieces from `first` up to, but without, `end`.
  struct Level {
    float error_m = 0;
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };
  /// The coarsest level of which no point is farther from the mesh, in its own frame; with 0, the mesh itself.
  [[nodiscard]] Level level(std::uint32_t mesh, float error_m = 0) const;
  /// The pieces of all levels, for culling.
  [[nodiscard]] const std::vector<MeshPiece>& pieces(std::uint32_t mesh) const;
  /// The mesh in its own frame.
  [[nodiscard]] const Eigen::AlignedBox3f& box(std::uint32_t mesh) const;
  /// Draws a run's instances, and sets the uniforms of set_model(). The program must be in use.
  void draw(const InstanceRun& run, const Program& program) const;
  /// Draws some of the triangles, in the given order.
  void draw_triangles(std::uint32_t mesh, std::span<const std::uint32_t> triangles) const;
  [[nodiscard]] bool is_clear(std::uint32_t material) const;
  /// The centroid of each triangle, in the mesh's frame.
  [[nodiscard]] const std::vector<Vec3f>& triangle_middles(std::uint32_t mesh) const;
  /// Whether the material has all images that the plain needs.
  [[nodiscard]] bool is_land(std::uint32_t material) const;
  /// Sets uniforms and texture units of material.glsl, and face culling.
  void use_material(std::uint32_t material, const Program& program) const;

 private:
  struct GpuMesh {
    VertexArrayName vertex_array;
    BufferName vertices;
    BufferName indices;
    std::int32_t index_count = 0;
    std::vector<MeshPiece> pieces;
    std::vector<Level> levels;  ///< the mesh itself, then coarser ones
    Eigen::AlignedBox3f box_M;
    std::vector<Vec3f> middles_M;  ///< of the triangles
  };
  [[nodiscard]] static GpuMesh upload_mesh(const picture::MeshData& mesh);
  [[nodiscard]] GpuMesh mesh_or_placeholder(const picture::MeshData& mesh);
  [[nodiscard]] TextureName image_or_none(const picture::ImageData& image);
  void refuse(const std::string& name, const std::string& what, std::uint32_t error, const std::string& instead);

  std::vector<GpuMesh> meshes_;
  std::vector<TextureName> images_;  ///< empty name: it did not fit on the card
  std::vector<picture::MaterialData> materials_;
  std::set<std::string> refused_;
};

/// Says which texture units GpuAssets::use_material fills. The program must be in use.
void set_material_units(const Program& program);

/// Sets X_WM and N_WM of mesh.vert (or depth.vert).
void set_model(const Program& program, const Eigen::Affine3f& X_WM);

}  // namespace mechane::draw
