#include "server/content/importer/assimp_reader.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

#include <assimp/BaseImporter.h>
#include <assimp/GltfMaterial.h>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "server/base/utf8.hpp"
#include "server/content/importer/folder_io.hpp"
#include "server/content/importer/gltf_counts.hpp"
#include "server/content/importer/material_reader.hpp"

namespace mechane::content {
namespace {

constexpr std::array kRead{".glb", ".gltf", ".obj", ".stl", ".ply"};
constexpr std::array kLoaders{"glTF2 Importer", "Wavefront Object Importer", "Stereolithography (STL) Importer",
                              "Stanford Polygon Library (PLY) Importer"};

/// Assimp has loaders of some fifty formats. A file cannot attack a loader that was removed.
void keep_our_loaders(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* loader = importer.GetImporter(i);
    const std::string_view name = loader->GetInfo()->mName;
    if (std::find(kLoaders.begin(), kLoaders.end(), name) == kLoaders.end()) {
      importer.UnregisterLoader(loader);
      delete loader;  // unregistered loaders belong to the caller
    }
  }
}

Eigen::Vector3f vector(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

/// `v` at unit length, or `otherwise` where it has no length, as beside a degenerate triangle.
Vec3f unit_or(const Vec3f& v, const Vec3f& otherwise) {
  const float length = v.norm();
  return std::isfinite(length) && length > 1e-12F ? Vec3f(v / length) : otherwise;
}

/// Where uv are degenerate, the tangent is NaN: any vector in the surface takes its place.
Eigen::Vector4f tangent(const aiMesh& mesh, unsigned i, const Vec3f& normal) {
  const Vec3f raw = vector(mesh.mTangents[i]);
  const Vec3f t = unit_or(raw - normal * normal.dot(raw), normal.unitOrthogonal());
  const float side = normal.cross(t).dot(vector(mesh.mBitangents[i]));
  return {t.x(), t.y(), t.z(), side > 0 ? -1.0F : 1.0F};  // assimp's bitangent runs along v, which is downwards
}

ImportedMesh convert(const aiMesh& from) {
  ImportedMesh mesh;
  mesh.name = from.mName.C_Str();
  mesh.material = from.mMaterialIndex;
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    mesh.positions.push_back(vector(from.mVertices[i]));
    if (from.HasNormals()) mesh.normals.push_back(unit_or(vector(from.mNormals[i]), Vec3f::UnitY()));
    if (from.HasTextureCoords(0)) mesh.uv.emplace_back(from.mTextureCoords[0][i].x, from.mTextureCoords[0][i].y);
    if (from.HasTangentsAndBitangents() && from.HasNormals())
      mesh.tangents.push_back(tangent(from, i, mesh.normals.back()));
  }
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices == 3) mesh.indices.insert(mesh.indices.end(), face.mIndices, face.mIndices + 3);
  }
  return mesh;
}

Eigen::Affine3d convert(const aiMatrix4x4& m) {
  Eigen::Affine3d X;
  X.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0, 0, 0, 1;
  return X;
}

/// Parents before children, without recursion: a file may be nested deeper than a stack.
void convert_nodes(const aiNode& root, ImportedScene& scene, std::size_t most) {
  std::vector<std::pair<const aiNode*, std::optional<std::uint32_t>>> waiting{{&root, std::nullopt}};
  while (!waiting.empty() && scene.nodes.size() <= most) {
    const auto [from, parent] = waiting.back();
    waiting.pop_back();
    ImportedNode& node = scene.nodes.emplace_back();
    node.name = from->mName.C_Str();
    node.parent = parent;
    node.X_PN = convert(from->mTransformation);
    node.meshes.assign(from->mMeshes, from->mMeshes + from->mNumMeshes);
    const auto self = static_cast<std::uint32_t>(scene.nodes.size() - 1);
    for (unsigned i = from->mNumChildren; i-- > 0;)
      waiting.emplace_back(from->mChildren[i], self);
  }
}

void configure(Assimp::Importer& importer) {
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 40.0F);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(aiComponent_COLORS) | aiComponent_BONEWEIGHTS |
                                                          aiComponent_ANIMATIONS | aiComponent_LIGHTS |
                                                          aiComponent_CAMERAS);
}

/// To be called before assimp's steps: joining vertices takes a NaN to be equal to its neighbour, and drops the triangles around it.
Expected<void> check_numbers(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      if (vector(mesh.mVertices[i]).allFinite()) continue;
      const std::string name = mesh.mName.length > 0 ? mesh.mName.C_Str() : std::to_string(m + 1);
      return fail(ErrorCode::invalid_value,
                  fmt::format("corner {} has a coordinate that is not a finite number", i + 1), "mesh " + name,
                  "look for broken modifiers or a scale of zero in the model, and export it again");
    }
  }
  return {};
}

/// Why assimp read nothing. Throws std::bad_alloc again, which assimp turns into a text: only the caller knows the limit of memory.
std::string why_not(const Assimp::Importer& importer) {
  if (importer.GetException()) {
    try {
      std::rethrow_exception(importer.GetException());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {  // GetErrorString() has its text
    }
  }
  std::string why = importer.GetErrorString();
  std::replace(why.begin(), why.end(), '\n', ' ');
  return why.empty() ? "no scene in it" : why;
}

}  // namespace

Expected<ImportedScene> read_with_assimp(const std::filesystem::path& file, const ImportLimits& limits) {
  const std::string extension = lower_case(file.extension().string());
  if (std::find(kRead.begin(), kRead.end(), extension) == kRead.end()) {
    return fail(ErrorCode::not_supported, fmt::format("files of the format '{}' cannot be read", extension), {},
                "export the model as .glb, .gltf, .obj, .stl or .ply, or write it as .x3d");
  }
  if (extension == ".glb" || extension == ".gltf") {
    if (auto counts = check_gltf_counts(file, limits); !counts) return tl::unexpected<Error>(counts.error());
  }
  FolderIo io(file.parent_path(), limits.file_bytes);
  Assimp::Importer importer;
  keep_our_loaders(importer);
  configure(importer);
  importer.SetIOHandler(&io);
  constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_RemoveComponent |
                              aiProcess_GenSmoothNormals | aiProcess_CalcTangentSpace |
                              aiProcess_JoinIdenticalVertices | aiProcess_FlipUVs;
  const aiScene* from = importer.ReadFile(file.string(), 0);
  const Expected<void> numbers = from != nullptr ? check_numbers(*from) : Expected<void>();
  if (from != nullptr && numbers) from = importer.ApplyPostProcessing(kSteps);
  importer.SetIOHandler(nullptr);  // `io` is ours; assimp would delete it
  if (!numbers) return tl::unexpected<Error>(numbers.error());
  if (from == nullptr || from->mRootNode == nullptr) {
    return fail(ErrorCode::damaged, "the model cannot be read: " + why_not(importer), {},
                "open the file in a modelling program and export it again, best as .glb");
  }
  ImportedScene scene;
  for (unsigned i = 0; i < from->mNumMeshes; ++i)
    scene.meshes.push_back(convert(*from->mMeshes[i]));
  convert_nodes(*from->mRootNode, scene, limits.nodes);
  if (auto looks = read_materials(*from, io, scene); !looks) return tl::unexpected<Error>(looks.error());
  return scene;
}

}  // namespace mechane::content
