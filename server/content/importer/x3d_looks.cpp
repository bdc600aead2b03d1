#include "server/content/importer/x3d_looks.hpp"

#include <algorithm>
#include <cmath>

#include "server/content/importer/image_file.hpp"
#include "server/content/importer/x3d_geometry.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::content {
namespace {

/// The colours of Material were always chosen on screens: sRGB to linear. PhysicalMaterial's are linear, as glTF's.
Vec3f linear_of_screen(const Vec3& srgb) {
  return srgb.unaryExpr([](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); })
      .cast<float>();
}

void take_alpha(const x3d::NodeFields& appearance, double transparency, ImportedMaterial& to) {
  to.base_colour.w() = static_cast<float>(1 - transparency);
  to.alpha_cutoff = static_cast<float>(appearance.number("alphaCutoff"));
  const std::string mode = appearance.text("alphaMode");
  const bool blends = mode == "BLEND" || (mode == "AUTO" && transparency > 0);
  to.alpha_mode = blends ? AlphaMode::blend : mode == "MASK" ? AlphaMode::mask : AlphaMode::opaque;
}

/// Phong's exponent as a roughness, as for materials that assimp reads.
float roughness_of(double shininess) {
  return static_cast<float>(std::clamp(std::sqrt(2 / (128 * shininess + 2)), 0.05, 1.0));
}

}  // namespace

Expected<std::uint32_t> X3dLooks::material(const x3d::Document& document, x3d::NodeId appearance, bool both_sides) {
  const auto key = std::tuple(&document, appearance, both_sides);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  ImportedMaterial made;
  made.double_sided = both_sides;
  if (appearance && document[appearance].name == "Appearance") {
    const x3d::NodeFields fields(document, appearance);
    const std::string* def = document[appearance].attribute("DEF");
    if (def != nullptr) made.name = *def;
    if (auto good = read_material(document, appearance, made); !good) return tl::unexpected(good.error());
    if (auto good = read_textures(document, appearance, made); !good) return tl::unexpected(good.error());
  }
  scene_.materials.push_back(std::move(made));
  const auto index = static_cast<std::uint32_t>(scene_.materials.size() - 1);
  known_[key] = index;
  return index;
}

Expected<void> X3dLooks::read_material(const x3d::Document& document, x3d::NodeId id, ImportedMaterial& to) {
  const x3d::NodeFields appearance(document, id);
  const x3d::NodeId material = appearance.node("material");
  if (!material) return {};
  const x3d::NodeFields fields(document, material);
  if (fields.type() == "Material") {
    to.base_colour.head<3>() = linear_of_screen(fields.vector("diffuseColor"));
    to.emissive = linear_of_screen(fields.vector("emissiveColor"));
    to.roughness = roughness_of(fields.number("shininess"));
    take_alpha(appearance, fields.number("transparency"), to);
    return read_texture(document, fields.node("diffuseTexture"), to.base_colour_texture);
  }
  if (fields.type() != "PhysicalMaterial") return {};
  to.base_colour.head<3>() = fields.vector("baseColor").cast<float>();
  to.emissive = fields.vector("emissiveColor").cast<float>();
  to.metallic = static_cast<float>(fields.number("metallic"));
  to.roughness = static_cast<float>(fields.number("roughness"));
  take_alpha(appearance, fields.number("transparency"), to);
  if (auto good = read_texture(document, fields.node("baseTexture"), to.base_colour_texture); !good) return good;
  if (auto good = read_texture(document, fields.node("emissiveTexture"), to.emissive_texture); !good) return good;
  return read_texture(document, fields.node("metallicRoughnessTexture"), to.metallic_roughness_texture);
}

/// Appearance.texture is that of the base colour, where the material has none of its own.
Expected<void> X3dLooks::read_textures(const x3d::Document& document, x3d::NodeId appearance, ImportedMaterial& to) {
  if (to.base_colour_texture) return {};
  return read_texture(document, x3d::NodeFields(document, appearance).node("texture"), to.base_colour_texture);
}

Expected<void> X3dLooks::read_texture(const x3d::Document& document, x3d::NodeId id, Slot& to) {
  if (!id || document[id].name != "ImageTexture") return {};
  const std::filesystem::path folder = document.path().parent_path();
  const std::vector<std::string> urls = x3d::NodeFields(document, id).strings("url");
  // A url may be given in several ways; the first that is a file here is taken.
  std::string path;
  for (const std::string& url : urls) {
    if (path.empty() && x3d::is_relative_path(url) && io_.allowed(folder / url)) path = (folder / url).string();
  }
  if (path.empty()) {
    return fail_at(document, id, ErrorCode::not_found, "none of its images is in the file's folder",
                   "copy a PNG or JPEG file there, and write its name in url");
  }
  if (const auto known = textures_.find(path); known != textures_.end()) {
    to = known->second;
    return {};
  }
  Expected<ImportedTexture> image = texture_file(io_, path);
  if (!image) return fail_at(document, id, image.error().code, image.error().what, image.error().remedy);
  image->name = std::filesystem::path(path).filename().string();
  scene_.textures.push_back(std::move(*image));
  to = static_cast<std::uint32_t>(scene_.textures.size() - 1);
  textures_[path] = *to;
  return {};
}

}  // namespace mechane::content
