#include "client-sdk/scene/landscape.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::scene {
namespace {

AssetLibrary empty_library() {
  return AssetLibrary([](const std::string&) -> Expected<content::ImportedScene> {
    return fail(ErrorCode::not_found, "none", "", "");
  });
}

/// A machine at (3, -1), and a river 4 m wide along z, 40 m to its right.
LandscapePlan plan_by_a_river() {
  LandscapePlan plan;
  plan.middle_W = Vec3f(3, -0.06F, -1);
  plan.clearing_m = 20;
  plan.to_sun_W = picture::Sun{}.to_sun_W;
  picture::MeshData river = picture::box_mesh(Vec3(2, 0.001, 300));
  Eigen::Affine3f X_WM = Eigen::Affine3f::Identity();
  X_WM.translation() = Vec3f(43, -0.1F, 0);
  add_water(river, X_WM, plan);
  return plan;
}

float level_distance_m(const Vec3f& a, const Vec3f& b) {
  return std::hypot(a.x() - b.x(), a.z() - b.z());
}

TEST(Landscape, grows_about_the_clearing_and_not_in_the_river) {
  const LandscapePlan plan = plan_by_a_river();
  const std::vector<Plant> plants = plants_of(plan);
  std::size_t right_of_river = 0;
  EXPECT_GT(plants.size(), 150U);
  for (const Plant& plant : plants) {
    EXPECT_GE(level_distance_m(plant.p_W, plan.middle_W), plan.clearing_m - 0.01F);
    EXPECT_FLOAT_EQ(plant.p_W.y(), plan.middle_W.y());
    EXPECT_GT(std::abs(plant.p_W.x() - 43), 2 + 2.4F) << "in the water or on its bank";
    if (plant.p_W.x() > 43) ++right_of_river;
  }
  EXPECT_GT(right_of_river, 10U);
}

TEST(Landscape, water_without_an_area_wets_nothing) {
  LandscapePlan plan = plan_by_a_river();
  plan.waters_W.assign(3, {Vec3f::Zero(), Vec3f::Zero(), Vec3f::Zero()});
  EXPECT_GT(plants_of(plan).size(), 150U);
}

TEST(Landscape, another_place_has_other_trees) {
  LandscapePlan plan = plan_by_a_river();
  const std::vector<Plant> here = plants_of(plan);
  ++plan.seed;
  const std::vector<Plant> there = plants_of(plan);
  ASSERT_FALSE(there.empty());
  EXPECT_NE(here[0].p_W, there[0].p_W);
  EXPECT_NE(here[0].seed, there[0].seed);
}

TEST(Landscape, is_the_same_each_time) {
  const std::vector<Plant> once = plants_of(plan_by_a_river());
  const std::vector<Plant> again = plants_of(plan_by_a_river());
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].p_W, again[i].p_W);
    EXPECT_EQ(once[i].height_m, again[i].height_m);
  }
}

TEST(Landscape, its_meshes_are_whole_and_their_faces_look_along_their_normals) {
  AssetLibrary library = empty_library();
  const LandscapePlan plan = plan_by_a_river();
  std::size_t triangles = 0;
  for (const picture::Instance& instance : add_plants(grow(plan, plants_of(plan)), library)) {
    EXPECT_FALSE(instance.casts_shadow);
    EXPECT_FALSE(instance.object) << "nobody takes a tree";
    EXPECT_FALSE(instance.near) << "nor looks for one under a finger";
    const picture::MeshData& mesh = library.assets().meshes[instance.mesh];
    triangles += mesh.indices.size() / 3;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uv.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_LT(mesh.indices[i + k], mesh.positions.size());
      const Vec3f& a = mesh.positions[mesh.indices[i]];
      const Vec3f face = (mesh.positions[mesh.indices[i + 1]] - a).cross(mesh.positions[mesh.indices[i + 2]] - a);
      const Vec3f& n = mesh.normals[mesh.indices[i]];
      ASSERT_NEAR(n.norm(), 1, 1e-4);
      ASSERT_GE(face.dot(n), 0);
    }
  }
  EXPECT_GT(triangles, 5'000U);
  EXPECT_LT(triangles, 80'000U) << "a processor draws it, too";
}

TEST(Landscape, the_farther_away_the_fewer_leaves) {
  const LandscapePlan plan = plan_by_a_river();
  const auto triangles_at = [&](float away_m) {
    AssetLibrary library = empty_library();
    std::size_t triangles = 0;
    const Plant olive{Plant::Kind::olive, plan.middle_W + Vec3f(-away_m, 0, 0), 4, 3};
    for (const picture::Instance& instance : add_plants(grow(plan, {olive}), library))
      triangles += library.assets().meshes[instance.mesh].indices.size() / 3;
    return triangles;
  };
  EXPECT_GT(triangles_at(30), 2 * triangles_at(90));
  EXPECT_GT(triangles_at(150), 100U);
}

TEST(Landscape, shade_lies_away_from_the_sun) {
  const LandscapePlan plan = plan_by_a_river();
  for (const auto kind : {Plant::Kind::olive, Plant::Kind::cypress}) {
    AssetLibrary library = empty_library();
    const Plant tree{kind, plan.middle_W + Vec3f(0, 0, -40), 4, 3};
    const picture::MeshData& shade = library.assets().meshes[add_plants(grow(plan, {tree}), library).back().mesh];
    ASSERT_EQ(shade.positions.size(), 4U);
    const Vec3f middle = (shade.positions[0] + shade.positions[2]) / 2;
    // Of a crown's middle at some 0.6 of its height, along the sun's ray.
    const float along = (middle - tree.p_W).dot(Vec3f(plan.to_sun_W.x(), 0, plan.to_sun_W.z()).normalized());
    EXPECT_LT(along, -1.5F);
    EXPECT_GT(along, -4.5F);
    EXPECT_NEAR(middle.y(), plan.middle_W.y(), 0.15F);
  }
}

}  // namespace
}  // namespace mechane::scene
