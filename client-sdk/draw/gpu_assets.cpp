#include "client-sdk/draw/gpu_assets.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "client-sdk/picture/procedural_mesh.hpp"
#include "server/base/assert.hpp"
#include "server/log/log.hpp"

namespace mechane::draw {
namespace {

/// Triangles per piece: smaller pieces are culled more finely, but need more calls.
constexpr std::uint32_t kPiece = 1000;
/// Texture units of material.glsl's images, in the order of their bits; the units in between are for lighting.
constexpr std::array<std::uint8_t, 5> kImageUnits{0, 1, 2, 3, 8};

/// The first OpenGL error since the last call, or GL_NO_ERROR.
GLenum first_error() {
  GLenum first = GL_NO_ERROR;
  // A lost context may return errors without end.
  for (int i = 0; i < 8; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (first == GL_NO_ERROR) first = error;
  }
  return first;
}

TextureName upload_image(const picture::ImageData& image) {
  TextureName texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, image.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, static_cast<GLsizei>(image.width),
               static_cast<GLsizei>(image.height), 0, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

std::vector<Vec3f> middles_of(const picture::MeshData& mesh, const std::vector<std::uint32_t>& indices) {
  // In the order of the pieces, not of the file.
  std::vector<Vec3f> out;
  out.reserve(indices.size() / 3);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    out.emplace_back((mesh.positions[indices[i]] + mesh.positions[indices[i + 1]] + mesh.positions[indices[i + 2]]) /
                     3.0F);
  }
  return out;
}

void append(PiecedIndices more, PiecedIndices& to) {
  const auto first = static_cast<std::uint32_t>(to.indices.size());
  for (MeshPiece& piece : more.pieces) {
    piece.first_index += first;
    to.pieces.push_back(piece);
  }
  to.indices.insert(to.indices.end(), more.indices.begin(), more.indices.end());
}

const void* place_of(const MeshPiece& range) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): where a buffer is bound, OpenGL takes an offset for a pointer
  return reinterpret_cast<const void*>(std::size_t{range.first_index} * sizeof(std::uint32_t));
}

/// Draws parts of the index buffer, in the order given.
void draw_ranges(const VertexArrayName& vertex_array, const std::vector<MeshPiece>& ranges) {
  std::vector<GLsizei> counts;
  std::vector<const void*> places;
  for (const MeshPiece& range : ranges) {
    counts.push_back(static_cast<GLsizei>(range.index_count));
    places.push_back(place_of(range));
  }
  glBindVertexArray(vertex_array.get());
  glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, places.data(), static_cast<GLsizei>(counts.size()));
}

void draw_ranges(const VertexArrayName& vertex_array, const std::vector<MeshPiece>& ranges, GLsizei instances) {
  glBindVertexArray(vertex_array.get());
  for (const MeshPiece& range : ranges)
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT, place_of(range),
                            instances);
}

/// The array size in mesh.vert and depth.vert, for which every driver has room.
constexpr std::size_t kMostInstances = 32;

void set_models(const Program& program, std::span<const Eigen::Affine3f> X_WM) {
  std::vector<Eigen::Matrix4f> models;
  std::vector<Eigen::Matrix3f> normals;
  for (const Eigen::Affine3f& X : X_WM) {
    models.emplace_back(X.matrix());
    // A mesh that is scaled flat has no inverse; its normals are not transformed then.
    const Eigen::Matrix3f linear = X.linear();
    normals.emplace_back(std::abs(linear.determinant()) > 1e-12F ? Eigen::Matrix3f(linear.inverse().transpose())
                                                                 : Eigen::Matrix3f(Eigen::Matrix3f::Identity()));
  }
  program.set("X_WM", models);
  program.set("N_WM", normals);
}

}  // namespace

void describe_vertices() {
  constexpr std::array<int, 4> kSizes{3, 3, 4, 2};
  describe_floats(kSizes, kVertexFloats * sizeof(float));
}

std::vector<float> interleave(const picture::MeshData& mesh) {
  MECHANE_ASSERT(mesh.normals.size() == mesh.positions.size());
  std::vector<float> out;
  out.reserve(mesh.positions.size() * kVertexFloats);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector4f t = i < mesh.tangents.size() ? mesh.tangents[i] : Eigen::Vector4f(1, 0, 0, 1);
    const Eigen::Vector2f uv = i < mesh.uv.size() ? mesh.uv[i] : Eigen::Vector2f::Zero();
    out.insert(out.end(), mesh.positions[i].begin(), mesh.positions[i].end());
    out.insert(out.end(), mesh.normals[i].begin(), mesh.normals[i].end());
    out.insert(out.end(), t.begin(), t.end());
    out.insert(out.end(), uv.begin(), uv.end());
  }
  return out;
}

StreamedMesh StreamedMesh::create() {
  StreamedMesh mesh;
  mesh.vertex_array_ = make_vertex_array();
  mesh.vertices_ = make_buffer();
  mesh.indices_ = make_buffer();
  glBindVertexArray(mesh.vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, mesh.vertices_.get());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.indices_.get());
  describe_vertices();
  return mesh;
}

void StreamedMesh::upload(const picture::MeshData& mesh) {
  index_count_ = static_cast<std::int32_t>(mesh.indices.size());
  if (mesh.indices.empty()) return;
  const std::vector<float> vertices = interleave(mesh);
  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
               GL_STREAM_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
               mesh.indices.data(), GL_STREAM_DRAW);
}

void StreamedMesh::draw() const {
  if (empty()) return;
  glBindVertexArray(vertex_array_.get());
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void GpuAssets::upload(const picture::SceneAssets& assets) {
  while (images_.size() < assets.images.size())
    images_.push_back(image_or_none(assets.images[images_.size()]));
  while (materials_.size() < assets.materials.size())
    materials_.push_back(assets.materials[materials_.size()]);
  while (meshes_.size() < assets.meshes.size())
    meshes_.push_back(mesh_or_placeholder(assets.meshes[meshes_.size()]));
}

TextureName GpuAssets::image_or_none(const picture::ImageData& image) {
  (void)first_error();  // earlier errors do not concern this image
  TextureName texture = upload_image(image);
  const GLenum error = first_error();
  if (error == GL_NO_ERROR) return texture;
  refuse(image.name, fmt::format("an image of {} x {} pixels", image.width, image.height), error,
         "its material is shown without it");
  return {};
}

GpuAssets::GpuMesh GpuAssets::mesh_or_placeholder(const picture::MeshData& mesh) {
  (void)first_error();
  GpuMesh gpu = upload_mesh(mesh);
  const GLenum error = first_error();
  if (error == GL_NO_ERROR) return gpu;
  refuse(mesh.name, fmt::format("a mesh of {} triangles", mesh.indices.size() / 3), error,
         "a plain box is shown in its place");
  gpu = upload_mesh(picture::placeholder_mesh());
  // If there is no room for a box either, nothing is drawn there.
  return first_error() == GL_NO_ERROR ? std::move(gpu) : upload_mesh({});
}

GpuAssets::GpuMesh GpuAssets::upload_mesh(const picture::MeshData& mesh) {
  const std::vector<float> vertices = interleave(mesh);
  PiecedIndices cut = cut_up(mesh, mesh.indices, kPiece);
  GpuMesh gpu{make_vertex_array(),
              make_buffer(),
              make_buffer(),
              static_cast<std::int32_t>(cut.indices.size()),
              {},
              {{0, 0, static_cast<std::uint32_t>(cut.pieces.size())}},
              {},
              middles_of(mesh, cut.indices)};
  for (const MeshPiece& piece : cut.pieces)
    gpu.box_M.extend(piece.box_M);
  for (const picture::CoarserMesh& coarser : mesh.coarser) {
    append(cut_up(mesh, coarser.indices, kPiece), cut);
    gpu.levels.push_back({coarser.error_m, gpu.levels.back().end, static_cast<std::uint32_t>(cut.pieces.size())});
  }
  gpu.pieces = std::move(cut.pieces);
  glBindVertexArray(gpu.vertex_array.get());
  glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.get());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(cut.indices.size() * sizeof(std::uint32_t)),
               cut.indices.data(), GL_STATIC_DRAW);
  describe_vertices();
  return gpu;
}

void GpuAssets::refuse(const std::string& name, const std::string& what, std::uint32_t error,
                       const std::string& instead) {
  const std::string whose = name.empty() ? "the display's own " + what : name;
  const bool no_room = error == GL_OUT_OF_MEMORY;
  const Error said{ErrorCode::too_large,
                   fmt::format("the graphics card {} {}", no_room ? "has no room for" : "cannot hold", what), whose,
                   no_room
                       ? "simplify the model or make its images smaller, or give the display a card with more memory"
                       : "make it smaller"};
  log::warning(said.to_string() + "; " + instead);
  refused_.insert(whose);
}

void GpuAssets::draw(std::uint32_t mesh) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  glBindVertexArray(meshes_[mesh].vertex_array.get());
  glDrawElements(GL_TRIANGLES, meshes_[mesh].index_count, GL_UNSIGNED_INT, nullptr);
}

const std::vector<MeshPiece>& GpuAssets::pieces(std::uint32_t mesh) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  return meshes_[mesh].pieces;
}

GpuAssets::Level GpuAssets::level(std::uint32_t mesh, float error_m) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  const std::vector<Level>& levels = meshes_[mesh].levels;
  return *std::prev(std::ranges::upper_bound(levels, error_m, {}, &Level::error_m));
}

const Eigen::AlignedBox3f& GpuAssets::box(std::uint32_t mesh) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  return meshes_[mesh].box_M;
}

void GpuAssets::draw(const InstanceRun& run, const Program& program) const {
  MECHANE_ASSERT(run.mesh < meshes_.size());
  const GpuMesh& mesh = meshes_[run.mesh];
  std::vector<MeshPiece> ranges;
  for (const std::uint32_t k : run.pieces) {
    const MeshPiece& piece = mesh.pieces[k];
    if (!ranges.empty() && ranges.back().first_index + ranges.back().index_count == piece.first_index) {
      ranges.back().index_count += piece.index_count;
    } else {
      ranges.push_back(piece);
    }
  }
  // One call draws one range for many instances, or many ranges of one instance.
  const std::size_t together = ranges.size() < run.X_WM.size() ? kMostInstances : 1;
  for (std::size_t first = 0; first < run.X_WM.size(); first += together) {
    const std::span some = std::span(run.X_WM).subspan(first, std::min(together, run.X_WM.size() - first));
    set_models(program, some);
    if (some.size() == 1) {
      draw_ranges(mesh.vertex_array, ranges);
    } else {
      draw_ranges(mesh.vertex_array, ranges, static_cast<GLsizei>(some.size()));
    }
  }
}

void GpuAssets::draw_triangles(std::uint32_t mesh, std::span<const std::uint32_t> triangles) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  std::vector<MeshPiece> ranges;
  for (const std::uint32_t triangle : triangles)
    ranges.push_back({3 * triangle, 3, {}});
  draw_ranges(meshes_[mesh].vertex_array, ranges);
}

bool GpuAssets::is_clear(std::uint32_t material) const {
  MECHANE_ASSERT(material < materials_.size());
  return materials_[material].clear;
}

bool GpuAssets::is_land(std::uint32_t material) const {
  MECHANE_ASSERT(material < materials_.size());
  const picture::MaterialData& m = materials_[material];
  return m.land && m.base_colour_image && m.normal_image && images_[*m.base_colour_image] && images_[*m.normal_image];
}

const std::vector<Vec3f>& GpuAssets::triangle_middles(std::uint32_t mesh) const {
  MECHANE_ASSERT(mesh < meshes_.size());
  return meshes_[mesh].middles_M;
}

void GpuAssets::use_material(std::uint32_t material, const Program& program) const {
  MECHANE_ASSERT(material < materials_.size());
  const picture::MaterialData& m = materials_[material];
  program.set("base_colour", m.base_colour);
  program.set("emissive", m.emissive);
  program.set("metallic", m.metallic);
  program.set("roughness", m.roughness);
  program.set("alpha_cutoff", m.alpha_cutoff);
  program.set("occlusion_strength", m.occlusion_strength);
  const std::array<std::optional<std::uint32_t>, kImageUnits.size()> images{
      m.base_colour_image, m.normal_image, m.metallic_roughness_image, m.emissive_image, m.occlusion_image};
  int bits = 0;
  for (std::uint32_t k = 0; k < images.size(); ++k) {
    if (!images[k]) continue;
    MECHANE_ASSERT(*images[k] < images_.size());
    if (!images_[*images[k]]) continue;
    bits |= 1 << k;
    glActiveTexture(GL_TEXTURE0 + kImageUnits[k]);
    glBindTexture(GL_TEXTURE_2D, images_[*images[k]].get());
  }
  program.set("images", bits);
  if (m.double_sided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

void set_material_units(const Program& program) {
  constexpr std::array<const char*, kImageUnits.size()> kNames{"base_image", "normal_image", "metallic_roughness_image",
                                                               "emissive_image", "occlusion_image"};
  for (std::size_t k = 0; k < kNames.size(); ++k)
    program.set(kNames[k], static_cast<int>(kImageUnits[k]));
}

void set_model(const Program& program, const Eigen::Affine3f& X_WM) {
  set_models(program, {&X_WM, 1});
}

}  // namespace mechane::draw
