#include "client-sdk/scene/prepared_file.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "client-sdk/picture/image_file.hpp"
#include "server/log/log.hpp"

namespace mechane::scene {
namespace {

/// A material with this name is land: see MaterialData::land.
constexpr std::string_view kLandMaterial = "earth";

std::optional<picture::ImageData> decode(const content::ImportedTexture& texture, bool srgb, const std::string& where) {
  if (texture.encoding == content::TextureEncoding::rgba8) {
    if (texture.bytes.size() != std::size_t{4} * texture.width * texture.height || texture.bytes.empty()) return {};
    picture::ImageData image{texture.width, texture.height, {}, srgb};
    image.rgba.resize(texture.bytes.size());
    std::ranges::transform(texture.bytes, image.rgba.begin(), [](std::byte b) { return static_cast<std::uint8_t>(b); });
    return image;
  }
  Expected<picture::ImageData> image = picture::decode_image(texture.bytes, where);
  if (!image) {
    log::warning(image.error().to_string());
    return {};
  }
  image->srgb = srgb;
  return std::move(*image);
}

bool is_clear(const picture::ImageData& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] < 255) return true;
  }
  return false;
}

}  // namespace

PreparedFile prepare(content::ImportedScene scene, const std::string& uri) {
  PreparedFile out;
  // One image may be used as colour in one material and as numbers in another, so each use gets its own copy.
  std::map<std::pair<std::uint32_t, bool>, std::optional<std::uint32_t>> images;
  const auto image = [&](std::optional<std::uint32_t> texture, bool srgb) -> std::optional<std::uint32_t> {
    if (!texture || *texture >= scene.textures.size()) return {};
    const auto [entry, is_new] = images.try_emplace({*texture, srgb});
    if (is_new) {
      const content::ImportedTexture& from = scene.textures[*texture];
      const std::string name = uri + ", texture " + from.name;
      if (auto decoded = decode(from, srgb, name)) {
        decoded->name = name;
        entry->second = static_cast<std::uint32_t>(out.images.size());
        out.images.push_back(std::move(*decoded));
      }
    }
    return entry->second;
  };
  for (const content::ImportedMaterial& from : scene.materials) {
    picture::MaterialData& to = out.materials.emplace_back();
    to.base_colour = from.base_colour;
    to.emissive = from.emissive;
    to.metallic = from.metallic;
    to.roughness = from.roughness;
    to.alpha_cutoff = from.alpha_mode == content::AlphaMode::mask ? from.alpha_cutoff : 0.0F;
    to.double_sided = from.double_sided;
    to.land = from.name.starts_with(kLandMaterial);
    to.base_colour_image = image(from.base_colour_texture, true);
    to.normal_image = image(from.normal_texture, false);
    to.metallic_roughness_image = image(from.metallic_roughness_texture, false);
    to.emissive_image = image(from.emissive_texture, true);
    to.occlusion_image = image(from.occlusion_texture, false);
    to.occlusion_strength = from.occlusion_strength;
    // Many tools write BLEND for opaque materials; treating those as transparent would cost sorting time and their
    // shadows.
    const bool clear_image = to.base_colour_image && is_clear(out.images[*to.base_colour_image]);
    to.clear = from.alpha_mode == content::AlphaMode::blend && (from.base_colour.w() < 1 || clear_image);
  }
  std::ranges::transform(scene.meshes, std::back_inserter(out.coarser), coarser_meshes);
  scene.textures.clear();
  out.scene = std::move(scene);
  return out;
}

}  // namespace mechane::scene
