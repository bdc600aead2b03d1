#include "client-sdk/scene/scene_builder.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::scene {
namespace {

content::ImportedMesh imported(const picture::MeshData& mesh) {
  content::ImportedMesh out;
  out.positions = mesh.positions;
  out.normals = mesh.normals;
  out.indices = mesh.indices;
  return out;
}

/// A barrel along z with two staves, scenery, and two surfaces of water: the names of the shipped models.
content::ImportedScene machine_file() {
  content::ImportedScene scene;
  scene.materials.resize(2);
  scene.meshes = {imported(picture::box_mesh(Vec3(0.1, 0.1, 1))), imported(picture::box_mesh(Vec3(2, 0.1, 2))),
                  imported(picture::disc_mesh(0.3, 8))};
  const auto add = [&](const std::string& name, std::optional<std::uint32_t> parent,
                       std::vector<std::uint32_t> meshes) {
    content::ImportedNode node;
    node.name = name;
    node.parent = parent;
    node.meshes = std::move(meshes);
    scene.nodes.push_back(node);
  };
  add("OUTER", {}, {});
  add("part_a", 0, {0});
  add("part_b", 0, {0});
  add("SCENE", {}, {1});
  add("WATER_BASIN", {}, {2});
  return scene;
}

AssetLibrary library_of(int& loads) {
  return AssetLibrary([&loads](const std::string& uri) -> Expected<content::ImportedScene> {
    ++loads;
    if (uri != "machine.glb") return fail(ErrorCode::not_found, "no such file", uri, "export it");
    return machine_file();
  });
}

client::SceneObject object(std::uint32_t index, const std::string& uri, const std::string& node) {
  client::SceneObject out;
  out.index = index;
  out.name = node;
  out.mesh_uri = uri;
  out.mesh_node = node;
  out.movable = true;
  return out;
}

client::WorldStatus water_status() {
  client::WorldStatus status;
  status.quantities = {{"level", "m"}, {"flow", "l/s"}};
  return status;
}

/// The screw's effects: a basin that fills, and water that runs out of the barrel's upper end.
std::shared_ptr<const client::WorldPresentation> water_presentation() {
  auto presentation = std::make_shared<client::WorldPresentation>();
  client::Effect basin, spout;
  basin.kind = "level";
  basin.node = "WATER_BASIN";
  basin.quantity = 0;
  spout.kind = "stream";
  spout.object = 0;
  spout.p_BE = Vec3(0, -0.05, 0.5);
  spout.direction_B = Vec3::UnitZ();
  spout.quantity = 1;
  spout.speed_m_per_s = 0.5;
  presentation->effects = {basin, spout};
  return presentation;
}

/// A river that flows along x.
std::shared_ptr<client::WorldPresentation> river_presentation() {
  auto presentation = std::make_shared<client::WorldPresentation>();
  client::Effect river;
  river.kind = "flow";
  river.node = "WATER_RIVER";
  river.direction_B = Vec3::UnitX();
  river.speed_m_per_s = 0.3;
  presentation->effects = {river};
  return presentation;
}

TEST(AssetLibrary, a_missing_file_or_node_is_a_box_and_is_told) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  EXPECT_FALSE(library.model("machine.glb", "OUTER").missing);
  const ObjectModel& no_file = library.model("gone.glb", "X");
  EXPECT_TRUE(no_file.missing);
  EXPECT_EQ(no_file.parts.size(), 1U);
  EXPECT_TRUE(library.model("gone.glb", "Y").missing);
  EXPECT_TRUE(library.model("machine.glb", "NOBODY").missing);
  EXPECT_EQ(library.missing(), (std::set<std::string>{"gone.glb", "machine.glb#NOBODY"}));
  EXPECT_EQ(loads, 2) << "each file is read once, found or not";
}

TEST(AssetLibrary, a_file_that_comes_late_takes_its_placeholders_place) {
  bool there = false;
  AssetLibrary library([&](const std::string& uri) -> Expected<content::ImportedScene> {
    if (!there) return fail(ErrorCode::busy, "it is being fetched", uri);
    return machine_file();
  });
  const ObjectModel& barrel = library.model("machine.glb", "OUTER");
  const ObjectModel& nobody = library.model("machine.glb", "NOBODY");
  EXPECT_TRUE(barrel.missing);
  EXPECT_FALSE(library.load_again("another.glb"));
  there = true;
  EXPECT_TRUE(library.load_again("machine.glb"));
  EXPECT_FALSE(barrel.missing) << "the reference that a scene holds shows the model";
  EXPECT_TRUE(nobody.missing);
  EXPECT_EQ(library.missing(), (std::set<std::string>{"machine.glb#NOBODY"}));
  EXPECT_FALSE(library.load_again("machine.glb")) << "what is here is not read again";
}

TEST(AssetLibrary, what_moves_together_is_one_mesh) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  const ObjectModel& model = library.model("machine.glb", "OUTER");
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(library.assets().meshes[model.parts[0].mesh].indices.size(), 2 * 36U);
}

TEST(SceneBuilder, water_stands_where_the_level_says) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(0, "machine.glb", "OUTER")});
  builder.set_presentation(water_presentation());
  const client::WorldStatus status = water_status();
  client::Frame frame;
  frame.quantities = {0.0, 0.0};
  EXPECT_TRUE(builder.build(&frame, &status, client::LinkState::joined).waters.empty())
      << "an empty basin shows its floor";
  for (const double level : {0.1, 0.25}) {
    frame.quantities = {level, 0.0};
    const picture::RenderScene scene = builder.build(&frame, &status, client::LinkState::joined);
    ASSERT_EQ(scene.waters.size(), 1U);
    EXPECT_FLOAT_EQ(scene.waters[0].X_WM.translation().y(), static_cast<float>(level));
  }
}

TEST(SceneBuilder, the_stream_carries_the_flow) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  client::SceneObject barrel = object(0, "machine.glb", "OUTER");
  barrel.X_WB = {Vec3(0, 1, 0),
                 Quat(Eigen::AngleAxisd(kPi / 4, Vec3::UnitY()) * Eigen::AngleAxisd(-0.6, Vec3::UnitX()))};
  builder.set_manifest({barrel});
  builder.set_presentation(water_presentation());
  const client::WorldStatus status = water_status();
  client::Frame frame;
  frame.quantities = {0.1, 0.0};
  EXPECT_TRUE(builder.build(&frame, &status, client::LinkState::joined).streams.empty());
  frame.quantities = {0.1, 0.25};
  const picture::RenderScene slow = builder.build(&frame, &status, client::LinkState::joined);
  frame.quantities = {0.1, 1.0};
  const picture::RenderScene fast = builder.build(&frame, &status, client::LinkState::joined);
  ASSERT_EQ(slow.streams.size(), 1U);
  EXPECT_NEAR(fast.streams[0].width_m, 2 * slow.streams[0].width_m, 1e-5) << "four times the water, twice the width";
  EXPECT_FLOAT_EQ(slow.streams[0].landing_height_m, 0.1F);
  EXPECT_LT((slow.streams[0].p_WS.cast<double>() - barrel.X_WB * Vec3(0, -0.05, 0.5)).norm(), 1e-6);
  EXPECT_LT((slow.streams[0].v_W.cast<double>() - 0.5 * barrel.X_WB.rotate(Vec3::UnitZ())).norm(), 1e-6);
}

TEST(SceneBuilder, a_river_flows_and_goes_on_beyond_its_model_and_standing_water_does_not) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedScene scene = machine_file();
    scene.nodes.back().name = "WATER_RIVER";
    scene.nodes.back().meshes = {1};
    return scene;
  });
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(0, "machine.glb", "OUTER")});
  const auto waters = [&] { return builder.build(nullptr, nullptr, client::LinkState::joined).waters; };
  ASSERT_EQ(waters().size(), 1U);
  EXPECT_TRUE(waters()[0].flow_W.isZero());
  auto presentation = river_presentation();
  builder.set_presentation(presentation);
  const std::vector<picture::WaterInstance> all = waters();
  ASSERT_EQ(all.size(), 3U) << "the model's, upstream and downstream";
  for (const picture::WaterInstance& water : all)
    EXPECT_TRUE(water.flow_W.isApprox(Vec3f(0.3F, 0, 0))) << water.flow_W.transpose();
  EXPECT_EQ(all[0].width_m, 0);
  EXPECT_GT(all[1].width_m, 3);
  EXPECT_EQ(waters().size(), 3U) << "not more in each picture";
  const std::size_t meshes = library.assets().meshes.size();
  builder.set_presentation(presentation);
  builder.set_manifest({object(0, "machine.glb", "OUTER"), object(1, "machine.glb", "OUTER")});
  EXPECT_EQ(library.assets().meshes.size(), meshes) << "nor with each object that is told";
  EXPECT_EQ(waters().size(), 3U);
  presentation = std::make_shared<client::WorldPresentation>();
  builder.set_presentation(presentation);
  ASSERT_EQ(waters().size(), 1U) << "it stands again";
  EXPECT_TRUE(waters()[0].flow_W.isZero());
}

TEST(SceneBuilder, what_has_a_title_and_is_shown_is_named_in_the_visitors_language) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  std::vector<client::SceneObject> objects(3, object(0, "machine.glb", "OUTER"));
  for (std::uint32_t i = 0; i < 3; ++i)
    objects[i].index = i;
  objects[0].title = {{"el", "Το βαρέλι"}, {"en", "The barrel"}};
  objects[1].title = {{"el", "Κρυμμένο"}, {"en", "Hidden"}};
  builder.set_manifest(objects);
  client::Frame frame;
  frame.visible = {1, 0, 1};
  frame.bodies = {{0, {Vec3(0, 2, 0), Quat::Identity()}}};
  client::HandPose hand;
  hand.X_WS[0].p = Vec3(0, 2, 0.55);
  frame.hands = {hand};
  const picture::RenderScene scene = builder.build(&frame, nullptr, client::LinkState::joined);
  ASSERT_EQ(scene.named.size(), 1U);
  EXPECT_EQ(scene.named[0].name, "The barrel");
  EXPECT_TRUE(scene.named[0].X_WB.translation().isApprox(Vec3f(0, 2, 0))) << "where it is now";
  ASSERT_TRUE(scene.near_hand);
  EXPECT_EQ(scene.near_hand->object, 0U);
  EXPECT_TRUE(scene.near_hand->p_WT.isApprox(hand.X_WS[0].p, 1e-6));
  builder.set_language("el");
  EXPECT_EQ(builder.build(&frame, nullptr, client::LinkState::joined).named[0].name, "Το βαρέλι");
  frame.hands[0].X_WS[0].p = Vec3(0, 0, 0.55);
  EXPECT_FALSE(builder.build(&frame, nullptr, client::LinkState::joined).near_hand) << "it stood there at the start";
}

TEST(SceneBuilder, a_jet_of_the_same_bore_is_faster_with_more_water) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(0, "machine.glb", "OUTER")});
  auto presentation = std::make_shared<client::WorldPresentation>(*water_presentation());
  presentation->effects[1].kind = "jet";
  presentation->effects[1].size_m = 0.01;
  builder.set_presentation(presentation);
  const client::WorldStatus status = water_status();
  client::Frame frame;
  frame.quantities = {0.0, 0.2};  // l/s through 78.5 mm^2: 2.55 m/s
  const picture::RenderScene scene = builder.build(&frame, &status, client::LinkState::joined);
  ASSERT_EQ(scene.streams.size(), 1U);
  EXPECT_NEAR(scene.streams[0].v_W.norm(), 2.546, 0.001);
  EXPECT_FLOAT_EQ(scene.streams[0].width_m, 0.01F);
  EXPECT_TRUE(scene.streams[0].jet);
}

TEST(SceneBuilder, ropes_and_close_ups_are_as_the_server_says) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(0, "machine.glb", "OUTER")});
  auto presentation = std::make_shared<client::WorldPresentation>();
  presentation->views.resize(2);
  presentation->views[0].X_WV.p = Vec3(0, 1.5, 3);
  presentation->views[1].name = "NEAR";
  presentation->views[1].X_WV.p = Vec3(1, 2, 1);
  builder.set_presentation(presentation);
  client::WorldStatus status = water_status();
  client::Frame frame;
  frame.ropes = {{0.016, {Vec3(0, 0, 0), Vec3(0, 1, 0)}}, {0.01, {}}};
  const picture::RenderScene whole = builder.build(&frame, &status, client::LinkState::joined);
  ASSERT_EQ(whole.ropes.size(), 2U);
  EXPECT_FLOAT_EQ(whole.ropes[0].radius_m, 0.008F);
  EXPECT_EQ(whole.ropes[0].points_W.size(), 2U);
  EXPECT_TRUE(whole.camera.p_WC.isApprox(Vec3(0, 1.5, 3)));
  EXPECT_LT(whole.camera.p_WT.y(), 1.5) << "looks a little lower, for the caption lies there";
  EXPECT_FALSE(whole.inset) << "this step has no close-up";
  status.detail = "NEAR";
  const picture::RenderScene near = builder.build(&frame, &status, client::LinkState::joined);
  ASSERT_TRUE(near.inset);
  EXPECT_TRUE(near.inset->camera.p_WC.isApprox(Vec3(1, 2, 1)));
  status.detail = "NOWHERE";
  EXPECT_FALSE(builder.build(&frame, &status, client::LinkState::joined).inset);
}

TEST(SceneBuilder, a_landscape_is_seen_over_what_is_touched) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedScene land = machine_file();
    land.meshes[1] = imported(picture::box_mesh(Vec3(80, 1.5, 80)));
    return land;
  });
  SceneBuilder builder(library, "en");
  client::SceneObject sign = object(0, "land.glb", "OUTER");
  sign.X_WB.p = Vec3(0, 1, 0);
  builder.set_manifest({sign});
  const picture::RenderScene scene = builder.build(nullptr, nullptr, client::LinkState::joined);
  EXPECT_NEAR(scene.camera.p_WC.y(), 1.6, 0.1) << "from a person's height";
  const Vec3 look = (scene.camera.p_WT - scene.camera.p_WC).normalized();
  EXPECT_LT(std::asin(-look.y()), scene.camera.field_of_view_rad / 2) << "the horizon is in the picture";
  EXPECT_GT(scene.shadow_box_W.sizes().maxCoeff(), 100) << "far houses throw shadows";
  EXPECT_LT(scene.focus_box_W.sizes().maxCoeff(), 6) << "where the visitor's hand is they are sharp";
  EXPECT_TRUE(scene.focus_box_W.contains(Vec3f(0, 1, 0)));
  EXPECT_LE(*scene.ground_height_m, -0.75F) << "the plain hides nothing of the modelled land";
}

TEST(SceneBuilder, only_an_exhibit_stands_on_the_plain) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedScene file = machine_file();
    file.nodes.resize(4);  // without water
    return file;
  });
  for (const bool exhibit : {false, true}) {
    client::WorldPresentation presentation;
    if (exhibit) presentation.activities.emplace_back();
    SceneBuilder builder(library, "en");
    client::SceneObject hanging = object(0, "plain.x3d", "OUTER");
    hanging.X_WB.p = Vec3(0, -2, 0);
    client::SceneObject scenery = object(1, "plain.x3d", "SCENE");
    builder.set_manifest({hanging, scenery});
    builder.set_presentation(std::make_shared<client::WorldPresentation>(presentation));
    const picture::RenderScene scene = builder.build(nullptr, nullptr, client::LinkState::joined);
    EXPECT_EQ(scene.ground_height_m.has_value(), exhibit);
  }
}

TEST(SceneBuilder, trees_stand_about_an_exhibit_on_earth_once_and_not_about_a_landscape) {
  for (const double half_m : {2.0, 80.0}) {
    AssetLibrary library([&](const std::string&) -> Expected<content::ImportedScene> {
      content::ImportedScene scene = machine_file();
      scene.meshes[1] = imported(picture::box_mesh(Vec3(half_m, 0.1, half_m)));
      scene.meshes[1].material = 1;
      scene.materials[1].name = "earth";
      return scene;
    });
    SceneBuilder builder(library, "en");
    builder.set_manifest({object(0, "machine.glb", "OUTER")});
    const auto instances = [&] { return builder.build(nullptr, nullptr, client::LinkState::joined).instances.size(); };
    const std::size_t bare = instances();
    const auto presentation = std::make_shared<client::WorldPresentation>();
    builder.set_presentation(presentation);
    const std::size_t grown = instances();
    EXPECT_EQ(grown > bare, half_m < 10) << half_m;
    const std::size_t meshes = library.assets().meshes.size();
    builder.set_presentation(presentation);
    builder.set_manifest({object(0, "machine.glb", "OUTER"), object(1, "machine.glb", "OUTER")});
    EXPECT_EQ(instances(), grown + 1);
    EXPECT_EQ(library.assets().meshes.size(), meshes) << "not more with each word of the server";
  }
}

TEST(SceneBuilder, trees_keep_off_a_river_that_goes_on_and_earth_of_a_body_has_none) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    content::ImportedScene scene = machine_file();
    scene.meshes[1].material = 1;
    scene.materials[1].name = "earth";
    scene.nodes.back().name = "WATER_RIVER";
    scene.nodes.back().meshes = {3};
    scene.meshes.push_back(imported(picture::box_mesh(Vec3(2, 0.1, 1))));
    return scene;
  });
  const auto presentation = river_presentation();
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(0, "machine.glb", "OUTER")});
  builder.set_presentation(presentation);
  const picture::RenderScene scene = builder.build(nullptr, nullptr, client::LinkState::joined);
  std::vector<Vec3f> on_water;
  for (const picture::WaterInstance& water : scene.waters) {
    if (water.width_m <= 0) continue;
    const std::vector<Vec3f>& p_W = library.assets().meshes[water.mesh].positions;
    for (std::size_t i = 0; i + 1 < p_W.size(); i += 2)
      on_water.push_back((p_W[i] + p_W[i + 1]) / 2);
  }
  ASSERT_FALSE(on_water.empty());
  std::size_t trees = 0;
  for (const picture::Instance& instance : scene.instances) {
    // What is under a river's bed: the foot of each trunk is a fifth of a metre under the plain.
    if (instance.near || library.assets().materials[instance.material].clear) continue;
    for (const Vec3f& p_W : library.assets().meshes[instance.mesh].positions) {
      if (p_W.y() > *scene.ground_height_m - 0.19F) continue;
      ++trees;
      for (const Vec3f& water_W : on_water)
        ASSERT_GT(std::hypot(p_W.x() - water_W.x(), p_W.z() - water_W.z()), 2) << p_W.transpose();
    }
  }
  EXPECT_GT(trees, 100U);

  SceneBuilder bodies(library, "en");
  bodies.set_manifest({object(0, "machine.glb", "SCENE")});
  bodies.set_presentation(std::make_shared<client::WorldPresentation>());
  for (const picture::Instance& instance : bodies.build(nullptr, nullptr, client::LinkState::joined).instances)
    EXPECT_TRUE(instance.near) << "a body of earth may fly: no trees keep clear of it";
}

TEST(SceneBuilder, nothing_moves_but_what_the_frame_says) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  builder.set_manifest({object(7, "machine.glb", "OUTER")});
  client::Frame frame;
  frame.tick = 1500;
  frame.bodies = {{7, {Vec3(1, 2, 3), Quat::Identity()}}};
  const client::WorldStatus status;
  const picture::RenderScene first = builder.build(&frame, &status, client::LinkState::joined);
  const picture::RenderScene again = builder.build(&frame, &status, client::LinkState::lost);
  EXPECT_EQ(first.time_s, 1.5);
  EXPECT_EQ(again.time_s, 1.5);
  ASSERT_FALSE(first.instances.empty());
  EXPECT_EQ(first.instances[0].X_WM.translation(), Vec3f(1, 2, 3));
  EXPECT_EQ(again.instances[0].X_WM.matrix(), first.instances[0].X_WM.matrix());
  EXPECT_FALSE(again.overlay.note.empty());
  frame.visible.assign(8, 1);
  frame.visible[7] = 0;
  EXPECT_LT(builder.build(&frame, &status, client::LinkState::joined).instances.size(), first.instances.size());
}

TEST(SceneBuilder, what_came_loose_from_its_world_is_left_out_and_named) {
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  client::SceneObject lost_from_the_start = object(2, "machine.glb", "part_b");
  lost_from_the_start.X_WB.p = Vec3(1e30, 0, 0);
  builder.set_manifest({object(0, "machine.glb", "OUTER"), object(1, "machine.glb", "part_a"), lost_from_the_start});
  builder.set_presentation(water_presentation());
  const client::WorldStatus status = water_status();
  client::Frame frame;
  frame.visible = {1, 1, 1};
  frame.quantities = {0.1, 1.0};
  frame.bodies = {{0, {}}, {1, {}}, {2, {}}};
  const picture::RenderScene whole = builder.build(&frame, &status, client::LinkState::joined);
  EXPECT_EQ(builder.stray(), "");
  EXPECT_TRUE(whole.camera.p_WC.allFinite() && whole.camera.p_WC.norm() < 100) << "one box does not move the eye";
  frame.hands.resize(1);
  frame.ropes = {{0.01, {Vec3(0, 0, 0), Vec3(0, -1e30, 0)}}};
  for (const double far : {1e30, -1e7, std::numeric_limits<double>::quiet_NaN()}) {
    frame.bodies[0].X_WB.p = Vec3(0, far, 0);  // the water spouts from this one
    frame.hands[0].X_WS[0].p = Vec3(far, 0, 0);
    const picture::RenderScene scene = builder.build(&frame, &status, client::LinkState::joined);
    EXPECT_EQ(scene.instances.size(), whole.instances.size() - 1) << far;
    EXPECT_TRUE(scene.streams.empty() && scene.ropes.empty()) << far;
    EXPECT_EQ(builder.stray(), "OUTER");
  }
  frame.bodies[0].X_WB.p = Vec3::Zero();
  EXPECT_EQ(builder.build(&frame, &status, client::LinkState::joined).instances.size(), whole.instances.size());
  EXPECT_EQ(builder.stray(), "") << "it is back";
}

TEST(SceneBuilder, of_ten_thousand_objects_each_is_where_it_belongs) {
  constexpr std::uint32_t kMany = 10'000;
  int loads = 0;
  AssetLibrary library = library_of(loads);
  SceneBuilder builder(library, "en");
  std::vector<client::SceneObject> manifest;
  client::Frame frame;
  for (std::uint32_t i = 0; i < kMany; ++i) {
    manifest.push_back(object(i, i % 1000 == 7 ? "gone.glb" : "machine.glb", "OUTER"));
    frame.visible.push_back(i % 2 == 0 ? 1 : 0);
    if (i % 3 != 0) frame.bodies.push_back({i, {Vec3(0, 0.001 * i, 0), Quat::Identity()}});
  }
  builder.set_manifest(manifest);
  EXPECT_EQ(loads, 2) << "a file is read once, for how many objects ever";
  // An object that no manifest names, as of a world that begins anew in mid-frame.
  frame.bodies.push_back({kMany + 5, {}});
  const picture::RenderScene scene = builder.build(&frame, nullptr, client::LinkState::joined);
  ASSERT_EQ(scene.instances.size(), kMany / 2 + 1) << "with the scenery";
  EXPECT_EQ(builder.unknown(), kMany + 5);
  frame.bodies.pop_back();
  (void)builder.build(&frame, nullptr, client::LinkState::joined);
  EXPECT_EQ(builder.unknown(), std::nullopt);
  for (const picture::Instance& instance : scene.instances) {
    if (!instance.object) continue;
    const float height = *instance.object % 3 != 0 ? 0.001F * static_cast<float>(*instance.object) : 0.0F;
    EXPECT_NEAR(instance.X_WM.translation().y(), height, 1e-5);
  }
}

}  // namespace
}  // namespace mechane::scene
