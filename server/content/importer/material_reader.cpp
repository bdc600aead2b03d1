#include "server/content/importer/material_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "server/content/importer/image_file.hpp"

namespace mechane::content {
namespace {

class MaterialReader {
 public:
  MaterialReader(const aiScene& from, const FolderIo& io, ImportedScene& scene) : from_(from), io_(io), scene_(scene) {}

  Expected<void> read() {
    for (unsigned i = 0; i < from_.mNumMaterials; ++i) {
      if (auto good = read_one(*from_.mMaterials[i]); !good) return good;
    }
    if (scene_.materials.empty()) scene_.materials.emplace_back();  // every mesh has one
    return {};
  }

 private:
  Expected<void> read_one(const aiMaterial& from) {
    ImportedMaterial& to = scene_.materials.emplace_back();
    aiString text;
    if (from.Get(AI_MATKEY_NAME, text) == AI_SUCCESS) to.name = text.C_Str();
    read_factors(from, to);
    if (auto t = texture(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, to.base_colour_texture); !t) return t;
    if (auto t = texture(from, {aiTextureType_NORMALS}, to.normal_texture); !t) return t;
    if (auto t = texture(from, {aiTextureType_UNKNOWN}, to.metallic_roughness_texture); !t)
      return t;  // glTF's place for it
    if (auto t = texture(from, {aiTextureType_EMISSIVE}, to.emissive_texture); !t) return t;
    return read_occlusion(from, to);
  }

  /// Baked occlusion often has a second set of uv, which we do not read. Drawn with the first set, it would look like stains: left out.
  Expected<void> read_occlusion(const aiMaterial& from, ImportedMaterial& to) {
    constexpr aiTextureType kPlace = aiTextureType_LIGHTMAP;  // where assimp has glTF's occlusionTexture
    aiString path;
    unsigned uv = 0;
    if (from.GetTexture(kPlace, 0, &path, nullptr, &uv) != AI_SUCCESS || uv != 0) return {};
    float strength = 1;
    if (from.Get(AI_MATKEY_GLTF_TEXTURE_STRENGTH(kPlace, 0), strength) == AI_SUCCESS)
      to.occlusion_strength = std::clamp(strength, 0.0F, 1.0F);
    return texture(from, {kPlace}, to.occlusion_texture);
  }

  static void read_factors(const aiMaterial& from, ImportedMaterial& to) {
    aiColor4D colour;
    if (from.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS ||
        from.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
      to.base_colour = {colour.r, colour.g, colour.b, colour.a};
    }
    aiColor3D emissive;
    if (from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive) == AI_SUCCESS) to.emissive = {emissive.r, emissive.g, emissive.b};
    float value = 0;
    if (from.Get(AI_MATKEY_METALLIC_FACTOR, value) == AI_SUCCESS) to.metallic = value;
    if (from.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == AI_SUCCESS) {
      to.roughness = value;
    } else if (from.Get(AI_MATKEY_SHININESS, value) == AI_SUCCESS && value > 0) {
      to.roughness =
          std::clamp(std::sqrt(2.0F / (value + 2.0F)), 0.05F, 1.0F);  // Blinn-Phong's exponent as a roughness
    }
    aiString mode;
    if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS) {
      if (std::strcmp(mode.C_Str(), "BLEND") == 0) to.alpha_mode = AlphaMode::blend;
      if (std::strcmp(mode.C_Str(), "MASK") == 0) to.alpha_mode = AlphaMode::mask;
    } else if (from.Get(AI_MATKEY_OPACITY, value) == AI_SUCCESS && value < 1) {
      to.base_colour.w() = value;
      to.alpha_mode = AlphaMode::blend;
    }
    if (from.Get(AI_MATKEY_GLTF_ALPHACUTOFF, value) == AI_SUCCESS) to.alpha_cutoff = value;
    int two_sided = 0;
    if (from.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS) to.double_sided = two_sided != 0;
  }

  /// The first of the types that the material has.
  Expected<void> texture(const aiMaterial& from, std::initializer_list<aiTextureType> types,
                         std::optional<std::uint32_t>& to) {
    for (const aiTextureType type : types) {
      aiString path;
      if (from.GetTexture(type, 0, &path) != AI_SUCCESS || path.length == 0) continue;
      const auto known = known_.find(path.C_Str());
      if (known == known_.end()) {
        Expected<ImportedTexture> image = load(path);
        if (!image) return tl::unexpected<Error>(image.error());
        to = static_cast<std::uint32_t>(scene_.textures.size());
        scene_.textures.push_back(std::move(*image));
        known_[path.C_Str()] = *to;
      } else {
        to = known->second;
      }
      return {};
    }
    return {};
  }

  Expected<ImportedTexture> load(const aiString& path) const {
    const auto [embedded, index] = from_.GetEmbeddedTextureAndIndex(path.C_Str());
    if (embedded == nullptr) return texture_file(io_, path.C_Str());
    const std::string name =
        embedded->mFilename.length > 0 ? embedded->mFilename.C_Str() : fmt::format("image {}", index);
    if (embedded->mHeight > 0) return raw(*embedded, name);
    return encoded_texture(name, {reinterpret_cast<const std::byte*>(embedded->pcData), embedded->mWidth});
  }

  static ImportedTexture raw(const aiTexture& from, const std::string& name) {
    ImportedTexture to{name, TextureEncoding::rgba8, from.mWidth, from.mHeight, {}};
    for (std::size_t i = 0; i < std::size_t{from.mWidth} * from.mHeight; ++i) {
      const aiTexel& texel = from.pcData[i];
      for (const unsigned char c : {texel.r, texel.g, texel.b, texel.a})
        to.bytes.push_back(std::byte{c});
    }
    return to;
  }

  const aiScene& from_;
  const FolderIo& io_;
  ImportedScene& scene_;
  std::map<std::string, std::uint32_t> known_;
};

}  // namespace

Expected<void> read_materials(const aiScene& from, const FolderIo& io, ImportedScene& scene) {
  return MaterialReader(from, io, scene).read();
}

}  // namespace mechane::content
