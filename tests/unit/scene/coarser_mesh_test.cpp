#include "client-sdk/scene/coarser_mesh.hpp"

#include <set>

#include <gtest/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"
#include "client-sdk/scene/asset_library.hpp"

namespace mechane::scene {
namespace {

content::ImportedMesh as_imported(const picture::MeshData& mesh) {
  content::ImportedMesh out;
  out.positions = mesh.positions;
  out.normals = mesh.normals;
  out.indices = mesh.indices;
  return out;
}

TEST(CoarserMesh, has_fewer_and_fewer_triangles_within_twice_each_level_s_error_of_the_mesh) {
  constexpr float kRadius_m = 0.5F;
  const content::ImportedMesh ball = as_imported(picture::sphere_mesh(kRadius_m, 80, 160));
  std::size_t finer = ball.indices.size();
  const CoarserMeshes levels = coarser_meshes(ball);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    EXPECT_LE(levels[k].size(), finer);
    finer = levels[k].size();
    ASSERT_EQ(finer % 3, 0U);
    for (std::size_t i = 0; i < finer; i += 3) {
      const Vec3f middle =
          (ball.positions[levels[k][i]] + ball.positions[levels[k][i + 1]] + ball.positions[levels[k][i + 2]]) / 3.0F;
      // Where a flat triangle lies deepest in a ball: there all of its error is seen. 0.2 mm are the mesh's own.
      EXPECT_LT(kRadius_m - middle.norm(), 2 * kLevelErrors_m[k] + 0.0003F) << "level " << k;
    }
  }
  EXPECT_LT(levels[3].size() * 8, ball.indices.size()) << "a centimetre of a ball of a metre";
}

TEST(CoarserMesh, open_borders_stay) {
  const content::ImportedMesh disc = as_imported(picture::disc_mesh(1, 64));
  const std::set<std::uint32_t> before(disc.indices.begin(), disc.indices.end());
  for (const std::vector<std::uint32_t>& level : coarser_meshes(disc)) {
    std::set<std::uint32_t> rim(level.begin(), level.end());
    EXPECT_GE(rim.size() + 1, before.size()) << "all but the middle";
  }
}

TEST(CoarserMesh, a_file_without_triangles_has_none) {
  for (const std::vector<std::uint32_t>& level : coarser_meshes({}))
    EXPECT_TRUE(level.empty());
}

/// A file with two balls of one material: the second one mirrored, and ten times as large.
content::ImportedScene two_balls() {
  content::ImportedScene scene;
  scene.materials.resize(1);
  scene.meshes = {as_imported(picture::sphere_mesh(0.1, 40, 80))};
  for (const double scale : {1.0, -10.0}) {
    content::ImportedNode& node = scene.nodes.emplace_back();
    node.meshes = {0};
    node.X_PN.linear().diagonal() = Vec3(scale, std::abs(scale), std::abs(scale));
  }
  return scene;
}

TEST(CoarserMesh, levels_of_merged_meshes_are_merged_with_the_larger_error) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> { return two_balls(); });
  (void)library.model("balls.glb", "");
  ASSERT_EQ(library.assets().meshes.size(), 1U);
  const picture::MeshData& mesh = library.assets().meshes.front();
  ASSERT_FALSE(mesh.coarser.empty());
  std::size_t finer = mesh.indices.size();
  for (const picture::CoarserMesh& level : mesh.coarser) {
    EXPECT_GE(level.error_m, 10 * kLevelErrors_m.front());
    EXPECT_LE(level.indices.size() * 4, finer * 3) << "each saves something";
    finer = level.indices.size();
    if (level.error_m > 0.5F) continue;  // the larger ball's radius is a metre: hardly a ball
    float whole = 0, inwards = 0;
    for (std::size_t i = 0; i + 2 < level.indices.size(); i += 3) {
      const Vec3f& a = mesh.positions[level.indices[i]];
      const Vec3f n = (mesh.positions[level.indices[i + 1]] - a).cross(mesh.positions[level.indices[i + 2]] - a);
      whole += n.norm();
      if (n.dot(a) < 0) inwards += n.norm();
    }
    EXPECT_LT(inwards, 0.01F * whole) << "outsides stay outside, but for slivers";
  }
}

}  // namespace
}  // namespace mechane::scene
