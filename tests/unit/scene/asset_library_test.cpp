#include "client-sdk/scene/asset_library.hpp"

#include <gtest/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::scene {
namespace {

/// One box for each material, each in a node of its own.
content::ImportedScene file_with(const std::vector<content::ImportedMaterial>& materials) {
  content::ImportedScene scene;
  scene.materials = materials;
  const picture::MeshData box = picture::box_mesh(Vec3(0.1, 0.1, 0.1));
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    content::ImportedMesh mesh;
    mesh.positions = box.positions;
    mesh.normals = box.normals;
    mesh.indices = box.indices;
    mesh.material = i;
    scene.meshes.push_back(mesh);
    content::ImportedNode node;
    node.name = "N" + std::to_string(i);
    node.meshes = {i};
    scene.nodes.push_back(node);
  }
  return scene;
}

content::ImportedMaterial material_of(content::AlphaMode mode, float opacity) {
  content::ImportedMaterial material;
  material.alpha_mode = mode;
  material.alpha_cutoff = 0.3F;
  material.base_colour = Eigen::Vector4f(1, 1, 1, opacity);
  return material;
}

TEST(AssetLibrary, what_a_file_blends_is_clear_and_nothing_of_it_is_left_out) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    using enum content::AlphaMode;
    return file_with(
        {material_of(blend, 0.14F), material_of(blend, 1), material_of(mask, 0.5F), material_of(opaque, 0.5F)});
  });
  (void)library.model("glass.glb", "N0");
  const std::vector<picture::MaterialData>& materials = library.assets().materials;
  ASSERT_EQ(materials.size(), 4U);
  EXPECT_TRUE(materials[0].clear);
  EXPECT_EQ(materials[0].alpha_cutoff, 0) << "a pane is drawn, not dropped";
  EXPECT_FALSE(materials[1].clear) << "BLEND that nobody can see through";
  EXPECT_FALSE(materials[2].clear);
  EXPECT_FLOAT_EQ(materials[2].alpha_cutoff, 0.3F);
  EXPECT_FALSE(materials[3].clear) << "glTF: OPAQUE leaves opacity out of account";
  EXPECT_EQ(materials[3].alpha_cutoff, 0);
}

TEST(AssetLibrary, an_image_with_clear_places_makes_a_blended_material_clear) {
  for (const int alpha : {255, 120}) {
    AssetLibrary library([&](const std::string&) -> Expected<content::ImportedScene> {
      content::ImportedMaterial material = material_of(content::AlphaMode::blend, 1);
      material.base_colour_texture = 0;
      content::ImportedScene scene = file_with({material});
      content::ImportedTexture texture;
      texture.encoding = content::TextureEncoding::rgba8;
      texture.width = texture.height = 1;
      texture.bytes = {std::byte{9}, std::byte{9}, std::byte{9}, static_cast<std::byte>(alpha)};
      scene.textures.push_back(texture);
      return scene;
    });
    (void)library.model("cloth.glb", "");
    EXPECT_EQ(library.assets().materials.front().clear, alpha < 255);
  }
}

TEST(AssetLibrary, an_occlusion_image_is_numbers_even_where_the_same_image_is_colour) {
  AssetLibrary library([&](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedMaterial material = material_of(content::AlphaMode::opaque, 1);
    material.base_colour_texture = material.metallic_roughness_texture = material.occlusion_texture = 0;
    material.occlusion_strength = 0.25F;
    content::ImportedScene scene = file_with({material});
    content::ImportedTexture& texture = scene.textures.emplace_back();
    texture.encoding = content::TextureEncoding::rgba8;
    texture.width = texture.height = 1;
    texture.bytes = std::vector<std::byte>(4, std::byte{200});
    return scene;
  });
  (void)library.model("stone.glb", "");
  const picture::SceneAssets& assets = library.assets();
  const picture::MaterialData& stone = assets.materials.front();
  ASSERT_TRUE(stone.occlusion_image && stone.base_colour_image);
  EXPECT_FALSE(assets.images[*stone.occlusion_image].srgb);
  EXPECT_TRUE(assets.images[*stone.base_colour_image].srgb);
  EXPECT_EQ(stone.occlusion_image, stone.metallic_roughness_image) << "on the card once";
  EXPECT_FLOAT_EQ(stone.occlusion_strength, 0.25F);
}

}  // namespace
}  // namespace mechane::scene
