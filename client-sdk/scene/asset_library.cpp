#include "client-sdk/scene/asset_library.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "client-sdk/picture/procedural_mesh.hpp"
#include "server/log/log.hpp"

namespace mechane::scene {
namespace {

constexpr std::string_view kWaterPrefix = "WATER_";

void append_triangles(const std::vector<std::uint32_t>& indices, std::uint32_t first_vertex, bool mirrored,
                      std::vector<std::uint32_t>& out) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    out.push_back(first_vertex + indices[i]);
    out.push_back(first_vertex + indices[i + (mirrored ? 2 : 1)]);
    out.push_back(first_vertex + indices[i + (mirrored ? 1 : 2)]);
  }
}

/// Appends the mesh with its levels of detail to `into`, transformed by X_BM.
void merge(picture::MeshData& into, const content::ImportedMesh& mesh, const CoarserMeshes& coarser,
           const Eigen::Affine3d& X_BM) {
  const auto first = static_cast<std::uint32_t>(into.positions.size());
  const Eigen::Affine3f X = X_BM.cast<float>();
  const Eigen::Matrix3f linear = X.linear();
  const Eigen::Matrix3f normal = linear.inverse().transpose();
  for (const Vec3f& p : mesh.positions)
    into.positions.push_back(X * p);
  for (const Vec3f& n : mesh.normals)
    into.normals.push_back((normal * n).normalized());
  // A zero normal marks those that the file lacks: they are computed from the triangles afterwards.
  into.normals.resize(into.positions.size(), Vec3f::Zero());
  for (const Eigen::Vector4f& t : mesh.tangents) {
    const Vec3f moved = (linear * t.head<3>()).normalized();
    into.tangents.emplace_back(moved.x(), moved.y(), moved.z(), t.w());
  }
  into.tangents.resize(into.positions.size(), Eigen::Vector4f(1, 0, 0, 1));
  into.uv.insert(into.uv.end(), mesh.uv.begin(), mesh.uv.end());
  into.uv.resize(into.positions.size(), Eigen::Vector2f::Zero());
  const bool mirrored = linear.determinant() < 0;
  append_triangles(mesh.indices, first, mirrored, into.indices);
  const float scale = linear.colwise().norm().maxCoeff();
  into.coarser.resize(coarser.size());
  for (std::size_t level = 0; level < coarser.size(); ++level) {
    into.coarser[level].error_m = std::max(into.coarser[level].error_m, scale * kLevelErrors_m[level]);
    append_triangles(coarser[level], first, mirrored, into.coarser[level].indices);
  }
}

/// A level that saves little is not worth its memory.
void drop_similar_levels(picture::MeshData& mesh) {
  std::size_t finer = mesh.indices.size();
  std::erase_if(mesh.coarser, [&finer](const picture::CoarserMesh& level) {
    const bool similar = level.indices.size() * 4 > finer * 3;
    if (!similar) finer = level.indices.size();
    return similar;
  });
}

/// Gives vertices without a normal the mean of their triangles', by area.
void fill_normals(picture::MeshData& mesh) {
  std::vector<Vec3f> sums(mesh.positions.size(), Vec3f::Zero());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3f& a = mesh.positions[mesh.indices[i]];
    const Vec3f n = (mesh.positions[mesh.indices[i + 1]] - a).cross(mesh.positions[mesh.indices[i + 2]] - a);
    for (std::size_t k = 0; k < 3; ++k)
      sums[mesh.indices[i + k]] += n;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (mesh.normals[i].squaredNorm() > 0.25F) continue;
    mesh.normals[i] = sums[i].squaredNorm() > 0 ? Vec3f(sums[i].normalized()) : Vec3f(Vec3f::UnitY());
  }
}

bool is_water(const content::ImportedScene& scene, std::uint32_t node) {
  for (std::optional<std::uint32_t> at = node; at; at = scene.nodes[*at].parent) {
    if (scene.nodes[*at].name.starts_with(kWaterPrefix)) return true;
  }
  return false;
}

/// The name of a file's node, or of the whole file.
std::string model_name(const std::string& uri, const std::string& node) {
  return node.empty() ? uri : uri + "#" + node;
}

}  // namespace

AssetLibrary::AssetLibrary(FileSource source) : source_(std::move(source)) {}

AssetLibrary::AssetLibrary(Loader loader)
    : source_([loader = std::move(loader)](const std::string& uri) {
        return loader(uri).map([&](content::ImportedScene scene) { return prepare(std::move(scene), uri); });
      }) {}

std::uint32_t AssetLibrary::add_mesh(picture::MeshData mesh) {
  assets_.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(assets_.meshes.size() - 1);
}

std::uint32_t AssetLibrary::add_image(picture::ImageData image) {
  assets_.images.push_back(std::move(image));
  return static_cast<std::uint32_t>(assets_.images.size() - 1);
}

std::uint32_t AssetLibrary::add_material(const picture::MaterialData& material) {
  assets_.materials.push_back(material);
  return static_cast<std::uint32_t>(assets_.materials.size() - 1);
}

const content::ImportedScene* AssetLibrary::file(const std::string& uri) {
  return load(uri).scene.get();
}

const ObjectModel& AssetLibrary::model(const std::string& uri, const std::string& node) {
  const std::string key = model_name(uri, node);
  const auto found = models_.find(key);
  if (found != models_.end()) return found->second;
  return models_.emplace(key, build(uri, node)).first->second;
}

bool AssetLibrary::load_again(const std::string& uri) {
  const auto file = files_.find(uri);
  if (file == files_.end() || file->second.scene) return false;
  files_.erase(file);
  missing_.erase(uri);
  for (auto& [key, model] : models_) {
    if (key == uri) model = build(uri, "");
    if (key.starts_with(uri + "#")) model = build(uri, key.substr(uri.size() + 1));
  }
  return true;
}

AssetLibrary::File& AssetLibrary::load(const std::string& uri) {
  const auto found = files_.find(uri);
  if (found != files_.end()) return found->second;
  File file;
  Expected<PreparedFile> prepared = source_(uri);
  if (prepared) {
    file.first_material = add_materials(std::move(prepared->materials), std::move(prepared->images));
    file.coarser = std::move(prepared->coarser);
    file.scene = std::make_unique<content::ImportedScene>(std::move(prepared->scene));
  } else {
    missing_.insert(uri);
    log::warning(prepared.error().to_string() + "; a plain box is shown in its place");
  }
  return files_.emplace(uri, std::move(file)).first->second;
}

/// Returns the index of the first one.
std::uint32_t AssetLibrary::add_materials(std::vector<picture::MaterialData> materials,
                                          std::vector<picture::ImageData> images) {
  const auto first_material = static_cast<std::uint32_t>(assets_.materials.size());
  const auto first_image = static_cast<std::uint32_t>(assets_.images.size());
  for (picture::ImageData& image : images)
    add_image(std::move(image));
  for (picture::MaterialData& material : materials) {
    for (auto* image : {&material.base_colour_image, &material.normal_image, &material.metallic_roughness_image,
                        &material.emissive_image, &material.occlusion_image}) {
      if (*image) **image += first_image;
    }
    add_material(material);
  }
  return first_material;
}

ObjectModel AssetLibrary::build(const std::string& uri, const std::string& node) {
  const File& file = load(uri);
  if (!file.scene) return placeholder(uri, "");
  const content::ImportedScene& scene = *file.scene;
  std::optional<std::uint32_t> top;
  if (!node.empty()) {
    top = content::find_node(scene, node);
    if (!top) return placeholder(uri + "#" + node, "the file has no node of this name");
  }
  const std::string name = model_name(uri, node);
  // Meshes that move together and have the same material become one draw call.
  std::map<std::pair<bool, std::uint32_t>, picture::MeshData> merged;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].meshes.empty() || (top && !content::is_under(scene, n, *top))) continue;
    const Eigen::Affine3d X_BN = content::pose_in(scene, n, top);
    const bool water = is_water(scene, n);
    for (const std::uint32_t m : scene.nodes[n].meshes) {
      merge(merged[{water, water ? 0 : scene.meshes[m].material}], scene.meshes[m], file.coarser[m], X_BN);
    }
  }
  ObjectModel model;
  for (auto& [key, mesh] : merged) {
    fill_normals(mesh);
    drop_similar_levels(mesh);
    mesh.name = name;
    for (const Vec3f& p : mesh.positions)
      model.box_B.extend(p);
    model.parts.push_back({add_mesh(std::move(mesh)), file.first_material + key.second, key.first});
  }
  if (model.parts.empty()) return placeholder(uri + "#" + node, "there are no triangles at or below the node");
  return model;
}

ObjectModel AssetLibrary::placeholder(const std::string& name, const std::string& why) {
  if (!why.empty()) {
    missing_.insert(name);
    log::warning(fmt::format("{}: {}; a plain box is shown in its place", name, why));
  }
  picture::MaterialData material;
  material.base_colour = Eigen::Vector4f(0.62F, 0.55F, 0.44F, 1);
  material.roughness = 0.9F;
  ObjectModel model;
  model.missing = true;
  model.parts.push_back({add_mesh(picture::placeholder_mesh()), add_material(material), false});
  model.box_B =
      Eigen::AlignedBox3f(Vec3f::Constant(-picture::kPlaceholderHalf_m), Vec3f::Constant(picture::kPlaceholderHalf_m));
  return model;
}

}  // namespace mechane::scene
