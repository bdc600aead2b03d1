#include "client-sdk/studio/view/shapes_glb.hpp"

#include <bit>

#include <nlohmann/json.hpp>

#include "server/base/byte_order.hpp"

namespace mechane::studio {
namespace {

using GlbJson = nlohmann::json;
using content::ImportedMesh;
using content::ImportedScene;

static_assert(std::endian::native == std::endian::little, "glTF's numbers are copied as they lie in memory");

// glTF 2.0, 3.6.2.2, 4.4: component types, chunk types.
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr std::uint32_t kMagic = 0x46546C67, kGlbVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

/// Collects the numbers of all meshes, and describes where each stands.
class GlbBuffer {
 public:
  template <class T>
  int add(const std::vector<T>& values, int component, const char* type) {
    views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
    accessors_.push_back(
        {{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", values.size()}, {"type", type}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return static_cast<int>(accessors_.size()) - 1;
  }
  int add_positions(const std::vector<Vec3f>& positions) {
    const int index = add(positions, kFloat, "VEC3");
    Vec3f least = positions.front(), most = positions.front();
    for (const Vec3f& p : positions) {
      least = least.cwiseMin(p);
      most = most.cwiseMax(p);
    }
    accessors_.back()["min"] = {least.x(), least.y(), least.z()};
    accessors_.back()["max"] = {most.x(), most.y(), most.z()};
    return index;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }
  [[nodiscard]] const GlbJson& views() const { return views_; }
  [[nodiscard]] const GlbJson& accessors() const { return accessors_; }

 private:
  std::string bytes_;
  GlbJson views_ = GlbJson::array();
  GlbJson accessors_ = GlbJson::array();
};

GlbJson primitive_of(const ImportedMesh& mesh, GlbBuffer& buffer) {
  GlbJson attributes{{"POSITION", buffer.add_positions(mesh.positions)}};
  if (!mesh.normals.empty()) attributes["NORMAL"] = buffer.add(mesh.normals, kFloat, "VEC3");
  return {{"attributes", std::move(attributes)},
          {"indices", buffer.add(mesh.indices, kUnsignedInt, "SCALAR")},
          {"material", mesh.material}};
}

GlbJson material_of(const content::ImportedMaterial& material) {
  const Eigen::Vector4f& colour = material.base_colour;
  GlbJson out{{"name", material.name},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {colour.x(), colour.y(), colour.z(), colour.w()}},
                {"metallicFactor", material.metallic},
                {"roughnessFactor", material.roughness}}},
              {"emissiveFactor", {material.emissive.x(), material.emissive.y(), material.emissive.z()}},
              {"doubleSided", material.double_sided}};
  if (material.alpha_mode == content::AlphaMode::blend) out["alphaMode"] = "BLEND";
  return out;
}

bool is_drawable(const ImportedMesh& mesh) {
  return !mesh.positions.empty() && !mesh.indices.empty();
}

/// A glTF mesh for each node that has any: its triangles of all materials.
GlbJson nodes_of(const ImportedScene& scene, const std::vector<GlbJson>& primitives, GlbJson& meshes, GlbJson& roots) {
  std::vector<GlbJson> children(scene.nodes.size(), GlbJson::array());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].parent)
      children[*scene.nodes[i].parent].push_back(i);
    else
      roots.push_back(i);
  }
  GlbJson nodes = GlbJson::array();
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const content::ImportedNode& node = scene.nodes[i];
    const Eigen::Matrix4d X = node.X_PN.matrix();
    GlbJson out{{"name", node.name}, {"matrix", std::vector<double>(X.data(), X.data() + X.size())}};
    if (!children[i].empty()) out["children"] = children[i];
    GlbJson own = GlbJson::array();
    for (const std::uint32_t mesh : node.meshes)
      if (is_drawable(scene.meshes[mesh])) own.push_back(primitives[mesh]);
    if (!own.empty()) {
      meshes.push_back({{"primitives", std::move(own)}});
      out["mesh"] = meshes.size() - 1;
    }
    nodes.push_back(std::move(out));
  }
  return nodes;
}

void put_chunk(std::string& out, std::uint32_t type, std::string bytes, char filling) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filling);
  StringSink sink(out);
  put(sink, static_cast<std::uint32_t>(bytes.size()));
  put(sink, type);
  out += bytes;
}

}  // namespace

std::string glb_of(const ImportedScene& scene) {
  GlbBuffer buffer;
  std::vector<GlbJson> primitives;
  for (const ImportedMesh& mesh : scene.meshes)
    primitives.push_back(is_drawable(mesh) ? primitive_of(mesh, buffer) : GlbJson());
  GlbJson meshes = GlbJson::array(), roots = GlbJson::array(), materials = GlbJson::array();
  GlbJson nodes = nodes_of(scene, primitives, meshes, roots);
  for (const content::ImportedMaterial& material : scene.materials)
    materials.push_back(material_of(material));
  GlbJson json{{"asset", {{"version", "2.0"}, {"generator", "Mechane"}}},
               {"scene", 0},
               {"scenes", GlbJson::array({{{"nodes", std::move(roots)}}})},
               {"nodes", std::move(nodes)}};
  // glTF allows no empty lists.
  if (!meshes.empty()) {
    json["meshes"] = std::move(meshes);
    json["materials"] = std::move(materials);
    json["accessors"] = buffer.accessors();
    json["bufferViews"] = buffer.views();
    json["buffers"] = GlbJson::array({{{"byteLength", buffer.bytes().size()}}});
  }
  std::string chunks;
  put_chunk(chunks, kJsonChunk, json.dump(-1, ' ', false, GlbJson::error_handler_t::replace), ' ');
  if (!buffer.bytes().empty()) put_chunk(chunks, kBinaryChunk, buffer.bytes(), '\0');
  std::string out;
  StringSink sink(out);
  put(sink, kMagic);
  put(sink, kGlbVersion);
  put(sink, static_cast<std::uint32_t>(12 + chunks.size()));
  return out + chunks;
}

}  // namespace mechane::studio
