#include "server/content/scene_check.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace mechane::content {
namespace {

constexpr const char* kExportAgain =
    "export the model again; if that does not help, open it in a modelling program and repair it there";

template <class Vectors>
bool all_finite(const Vectors& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const auto& v) { return v.allFinite(); });
}

Expected<void> check_counts(const ImportedScene& scene, const ImportLimits& limits) {
  const auto sum = [](const auto& items, auto size_of) {
    return std::accumulate(items.begin(), items.end(), std::uint64_t{0},
                           [&](std::uint64_t total, const auto& item) { return total + size_of(item); });
  };
  const std::uint64_t vertices = sum(scene.meshes, [](const ImportedMesh& m) { return m.positions.size(); });
  const std::uint64_t triangles = sum(scene.meshes, [](const ImportedMesh& m) { return m.indices.size() / 3; });
  const std::uint64_t texels = sum(scene.textures, [](const ImportedTexture& t) { return t.bytes.size(); });
  struct Count {
    const char* of;
    std::uint64_t is, most;
  };
  const Count counts[] = {{"nodes", scene.nodes.size(), limits.nodes},
                          {"meshes", scene.meshes.size(), limits.meshes},
                          {"materials", scene.materials.size(), limits.materials},
                          {"textures", scene.textures.size(), limits.textures},
                          {"vertices", vertices, limits.vertices},
                          {"triangles", triangles, limits.triangles},
                          {"bytes of textures", texels, limits.texture_bytes}};
  for (const Count& count : counts) {
    if (count.is > count.most) {
      return fail(ErrorCode::too_large, fmt::format("{} {}; the limit is {}", count.is, count.of, count.most), {},
                  "simplify the model");
    }
  }
  if (triangles == 0) return fail(ErrorCode::missing, "no triangles", {}, "export the model with its faces");
  return {};
}

Expected<void> check_mesh(const ImportedMesh& mesh, std::size_t materials) {
  const std::size_t count = mesh.positions.size();
  const auto fits = [count](const auto& attribute) { return attribute.empty() || attribute.size() == count; };
  const std::string where = "mesh " + mesh.name;
  if (!fits(mesh.normals) || !fits(mesh.tangents) || !fits(mesh.uv)) {
    return fail(ErrorCode::damaged, "there are more or fewer normals, tangents or uv than vertices", where,
                kExportAgain);
  }
  if (!all_finite(mesh.positions) || !all_finite(mesh.normals) || !all_finite(mesh.tangents) || !all_finite(mesh.uv)) {
    return fail(ErrorCode::invalid_value, "a vertex has a number that is not finite", where, kExportAgain);
  }
  if (mesh.indices.size() % 3 != 0)
    return fail(ErrorCode::damaged, "the last triangle is incomplete", where, kExportAgain);
  if (std::any_of(mesh.indices.begin(), mesh.indices.end(), [count](std::uint32_t i) { return i >= count; })) {
    return fail(ErrorCode::damaged, "a triangle names a vertex that does not exist", where, kExportAgain);
  }
  if (mesh.material >= materials)
    return fail(ErrorCode::damaged, "names a material that does not exist", where, kExportAgain);
  return {};
}

Expected<void> check_nodes(const ImportedScene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const ImportedNode& node = scene.nodes[i];
    const std::string where = "node " + node.name;
    if (node.parent && *node.parent >= i)
      return fail(ErrorCode::damaged, "comes before its parent", where, kExportAgain);
    if (!node.X_PN.matrix().allFinite()) {
      return fail(ErrorCode::invalid_value, "its transform has a number that is not finite", where, kExportAgain);
    }
    for (const std::uint32_t mesh : node.meshes) {
      if (mesh >= scene.meshes.size())
        return fail(ErrorCode::damaged, "names a mesh that does not exist", where, kExportAgain);
    }
  }
  return {};
}

Expected<void> check_looks(const ImportedScene& scene) {
  for (const ImportedMaterial& material : scene.materials) {
    const std::string where = "material " + material.name;
    for (const auto& texture :
         {material.base_colour_texture, material.normal_texture, material.metallic_roughness_texture,
          material.emissive_texture, material.occlusion_texture}) {
      if (texture && *texture >= scene.textures.size())
        return fail(ErrorCode::damaged, "names a texture that does not exist", where, kExportAgain);
    }
    const Eigen::Vector4f factors(material.metallic, material.roughness, material.alpha_cutoff,
                                  material.occlusion_strength);
    if (!material.base_colour.allFinite() || !material.emissive.allFinite() || !factors.allFinite()) {
      return fail(ErrorCode::invalid_value, "has a number that is not finite", where, kExportAgain);
    }
  }
  for (const ImportedTexture& texture : scene.textures) {
    const std::uint64_t expected = std::uint64_t{4} * texture.width * texture.height;
    if (texture.encoding == TextureEncoding::rgba8 && (expected == 0 || texture.bytes.size() != expected)) {
      return fail(ErrorCode::damaged, "it has more or fewer pixels than its size says", "texture " + texture.name,
                  kExportAgain);
    }
  }
  return {};
}

/// How far the placed model reaches. Only nodes with meshes count: an empty frame may lie anywhere.
Expected<void> check_extent(const ImportedScene& scene, const ImportLimits& limits) {
  std::vector<Eigen::AlignedBox3d> boxes(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    for (const Vec3f& p : scene.meshes[i].positions)
      boxes[i].extend(p.cast<double>());
  }
  std::vector<Eigen::Affine3d> X_FN(scene.nodes.size());
  Eigen::AlignedBox3d all;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const ImportedNode& node = scene.nodes[i];
    X_FN[i] = node.parent ? X_FN[*node.parent] * node.X_PN : node.X_PN;
    for (const std::uint32_t mesh : node.meshes) {
      if (!boxes[mesh].isEmpty()) all.extend(boxes[mesh].transformed(X_FN[i]));
    }
  }
  if (all.isEmpty()) {
    return fail(ErrorCode::missing, "no node shows a mesh", {},
                "export the model with its objects, not the mesh data alone");
  }
  const double across = all.sizes().maxCoeff();
  if (!(across <= limits.largest_m) || !(across >= limits.smallest_m) || !(all.center().norm() <= limits.largest_m)) {
    return fail(ErrorCode::invalid_value,
                fmt::format("the model is {:.4g} m across, {:.4g} m from its origin", across, all.center().norm()), {},
                fmt::format("export it in metres, near its origin ({} m to {} m across are read)", limits.smallest_m,
                            limits.largest_m));
  }
  return {};
}

}  // namespace

Expected<void> check_scene(const ImportedScene& scene, const ImportLimits& limits) {
  if (auto counts = check_counts(scene, limits); !counts) return counts;
  for (const ImportedMesh& mesh : scene.meshes) {
    if (auto good = check_mesh(mesh, scene.materials.size()); !good) return good;
  }
  if (auto nodes = check_nodes(scene); !nodes) return nodes;
  if (auto looks = check_looks(scene); !looks) return looks;
  return check_extent(scene, limits);
}

}  // namespace mechane::content
