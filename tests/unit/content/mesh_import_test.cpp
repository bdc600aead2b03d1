#include "server/content/mesh_import.hpp"

#include <chrono>
#include <map>
#include <stop_token>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/content/scene_codec.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/unit/content/model_files.hpp"

namespace mechane::content {
namespace {

using test::is_error;
using testing::ElementsAre;
using testing::SizeIs;

/// For faulty files whose error code depends on assimp's version.
MATCHER_P(HasRemedyAndWhere, where, "") {
  return arg.where.find(where) != std::string::npos && !arg.what.empty() && !arg.remedy.empty();
}

/// Six times the volume that the triangles enclose, and 1e9 if an edge does not meet its opposite: closed and turned outwards.
double closed_volume(const geometry::Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i)
      ++edges[{t[i], t[(i + 1) % 3]}];
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end()) return 1e9;
  }
  return volume;
}

class MeshImport : public testing::Test {
 protected:
  Expected<ImportedScene> import(const std::string& name, std::string_view bytes) {
    return import_mesh(folder_.write(name, bytes), limits_);
  }
  /// Empty where the file is read after all.
  Error fault(const std::string& name, std::string_view bytes) {
    const auto scene = import(name, bytes);
    return scene ? Error{} : scene.error();
  }
  Error fault_with(const std::filesystem::path& helper) {
    limits_.helper = helper;
    return fault("cube.obj", cube_obj());
  }

  ScratchFolder folder_;
  ImportLimits limits_;
};

TEST_F(MeshImport, ReadsACubeFromEachFormatAsOneClosedPart) {
  const std::pair<const char*, std::string> files[] = {{"cube.obj", cube_obj()},
                                                       {"cube.ply", cube_ply()},
                                                       {"cube.stl", cube_stl()},
                                                       {"cube.glb", cube_glb()},
                                                       {"CUBE.GLB", cube_glb()}};
  for (const auto& [name, bytes] : files) {
    const auto scene = import(name, bytes);
    ASSERT_TRUE(scene) << scene.error().to_string();
    const auto parts = collision_parts(*scene, "");
    ASSERT_TRUE(parts) << name << ": " << parts.error().to_string();
    ASSERT_THAT(*parts, SizeIs(1)) << name;
    EXPECT_THAT(parts->front().mesh.vertices, SizeIs(8)) << name;
    EXPECT_NEAR(closed_volume(parts->front().mesh), 8.0, 1e-6) << name;
  }
}

TEST_F(MeshImport, KeepsNodesMaterialsAndImagesOfAGlb) {
  const auto scene = import("cube.glb", cube_glb());
  ASSERT_TRUE(scene) << scene.error().to_string();
  const auto block = find_node(*scene, "part_block");
  ASSERT_TRUE(block);
  EXPECT_TRUE(pose_in(*scene, *block, std::nullopt).translation().isApprox(Vec3::UnitX()));
  EXPECT_TRUE(pose_in(*scene, *block, find_node(*scene, "BODY")).isApprox(Eigen::Affine3d::Identity()));
  ASSERT_THAT(scene->nodes[*block].meshes, SizeIs(1));
  const ImportedMesh& mesh = scene->meshes[scene->nodes[*block].meshes[0]];
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  const ImportedMaterial& material = scene->materials[mesh.material];
  EXPECT_EQ(material.name, "bronze");
  EXPECT_TRUE(material.base_colour.isApprox(Eigen::Vector4f(0.8F, 0.5F, 0.2F, 0.9F)));
  EXPECT_FLOAT_EQ(material.metallic, 0.75F);
  EXPECT_FLOAT_EQ(material.roughness, 0.25F);
  EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
  EXPECT_TRUE(material.double_sided);
  ASSERT_TRUE(material.base_colour_texture);
  const ImportedTexture& image = scene->textures[*material.base_colour_texture];
  EXPECT_EQ(image.encoding, TextureEncoding::png);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()), kPng);
}

TEST_F(MeshImport, KeepsTheOcclusionImageOfAGlb) {
  const auto material_with = [&](const std::string& texture) {
    const auto scene = import("cube.glb", cube_glb(-1, R"("occlusionTexture":{)" + texture + "},"));
    EXPECT_TRUE(scene) << scene.error().to_string();
    return scene ? scene->materials.at(0) : ImportedMaterial{};
  };
  const ImportedMaterial half = material_with(R"("index":0,"strength":0.5)");
  EXPECT_EQ(half.occlusion_texture, half.base_colour_texture) << "one image, however often it is used";
  EXPECT_FLOAT_EQ(half.occlusion_strength, 0.5F);
  EXPECT_FLOAT_EQ(material_with(R"("index":0)").occlusion_strength, 1);
  EXPECT_FLOAT_EQ(material_with(R"("index":0,"strength":7)").occlusion_strength, 1) << "no light below none";
  EXPECT_FALSE(material_with(R"("index":0,"texCoord":1)").occlusion_texture) << "it lies by other uv than ours";
  EXPECT_FALSE(import("cube.glb", cube_glb())->materials.at(0).occlusion_texture);
}

TEST_F(MeshImport, AMirroredPartIsTurnedOutwardsAgain) {
  const auto scene = import("cube.glb", cube_glb());
  ASSERT_TRUE(scene);
  const auto parts = collision_parts(*scene, "trimming");
  ASSERT_TRUE(parts) << parts.error().to_string();
  EXPECT_NEAR(closed_volume(parts->front().mesh), 8.0, 1e-6);  // in its own frame it is neither mirrored nor scaled
  const auto whole = collision_parts(*scene, "BODY");
  ASSERT_TRUE(whole);
  EXPECT_THAT(*whole, ElementsAre(testing::Field(&geometry::NamedMesh::name,
                                                 "part_block")));  // a part is named, so the rest is trimming
  ImportedScene unnamed = *scene;
  unnamed.nodes[*find_node(unnamed, "part_block")].name = "block";
  const auto all = collision_parts(unnamed, "BODY");
  ASSERT_TRUE(all);
  ASSERT_THAT(*all, SizeIs(2));
  EXPECT_NEAR(closed_volume(all->at(1).mesh), 1.0, 1e-6);
}

TEST_F(MeshImport, TangentFrameLooksToTheUpperEdgeOfTheImage) {
  // A sign on a wall, seen from +z: u grows to the right, v (as OBJ has it) upwards.
  const auto scene =
      import("sign.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
  ASSERT_TRUE(scene) << scene.error().to_string();
  const ImportedMesh& mesh = scene->meshes.at(0);
  ASSERT_THAT(mesh.uv, SizeIs(4));
  ASSERT_THAT(mesh.tangents, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(mesh.uv[i].y(), 1 - mesh.positions[i].y(), 1e-6);  // the image's upper edge is v = 0
    EXPECT_TRUE(mesh.tangents[i].isApprox(Eigen::Vector4f(1, 0, 0, 1), 1e-5F)) << mesh.tangents[i].transpose();
  }
}

TEST_F(MeshImport, RefusesFaultyFilesWithAReason) {
  const std::string obj = cube_obj();
  const std::string good = cube_glb();
  std::string empty_glb = glb(R"({"asset":{"version":"2.0"}})", "");
  EXPECT_THAT(fault("half.glb", good.substr(0, good.size() / 2)), is_error(ErrorCode::damaged, 0, {"half.glb"}));
  EXPECT_THAT(fault("empty.glb", empty_glb), HasRemedyAndWhere("empty.glb"));
  EXPECT_THAT(fault("range.obj", obj + "f 1 2 99\n"), HasRemedyAndWhere("range.obj"));
  EXPECT_THAT(fault("nan.glb", cube_glb(std::numeric_limits<float>::quiet_NaN())),
              is_error(ErrorCode::invalid_value, 0, {"nan.glb", "corner 1", "not a finite number"}));
  EXPECT_THAT(fault("far.glb", cube_glb(-1e30F)), is_error(ErrorCode::invalid_value, 0, {"far.glb", "metres"}));
  EXPECT_THAT(fault("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasRemedyAndWhere("points.obj"));
  EXPECT_THAT(fault("text.stl", "this is not a mesh"), HasRemedyAndWhere("text.stl"));
  EXPECT_THAT(fault("nothing.obj", ""), is_error(ErrorCode::damaged, 0, {"nothing.obj", "empty"}));
  EXPECT_THAT(fault("scene.dae", "<COLLADA/>"), is_error(ErrorCode::not_supported, 0, {"'.dae'", ".glb"}));
  EXPECT_THAT(import_mesh(folder_.path() / "missing.glb").error(), is_error(ErrorCode::not_found, 0, {"missing.glb"}));
  EXPECT_THAT(import_mesh(folder_.path()).error(),
              is_error(ErrorCode::invalid_value, 0, {folder_.path().string(), ".glb"}));
}

TEST_F(MeshImport, AnyTruncationOfAGlbIsRefusedOrReadWithoutCrash) {
  const std::string good = cube_glb();
  for (std::size_t size = 1; size < good.size(); size += good.size() / 23) {
    EXPECT_THAT(fault("cut.glb", good.substr(0, size)), HasRemedyAndWhere("cut.glb")) << size;
  }
}

TEST_F(MeshImport, ReadsNothingOutsideTheModelsFolder) {
  ScratchFolder elsewhere;
  const auto secret = elsewhere.write("secret.png", kPng);
  const std::string textured = "mtllib look.mtl\nusemtl m\n" + cube_obj() + "vt 0 0\n";
  folder_.write("look.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + secret.string() + "\n");
  EXPECT_THAT(fault("cube.obj", textured), is_error(ErrorCode::not_found, 0, {"cube.obj", secret.string()}));
  std::filesystem::create_symlink(secret, folder_.path() / "link.png");
  folder_.write("look.mtl", "newmtl m\nKd 1 1 1\nmap_Kd link.png\n");
  EXPECT_THAT(fault("cube.obj", textured), is_error(ErrorCode::not_found, 0, {"cube.obj", "link.png"}));
  folder_.write("own.png", kPng);
  folder_.write("look.mtl", "newmtl m\nKd 1 1 1\nmap_Kd own.png\n");
  const auto scene = import("cube.obj", textured);
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_THAT(scene->textures, SizeIs(1));
}

TEST_F(MeshImport, LimitsHold) {
  limits_.triangles = 11;
  EXPECT_THAT(fault("cube.obj", cube_obj()), is_error(ErrorCode::too_large, 0, {"12 triangles", "11"}));
  limits_ = {};
  limits_.texture_bytes = 10;
  EXPECT_THAT(fault("cube.glb", cube_glb()), is_error(ErrorCode::too_large, 0, {"bytes of textures", "10"}));
  limits_ = {};
  limits_.file_bytes = 100;
  EXPECT_THAT(fault("cube.glb", cube_glb()),
              is_error(ErrorCode::too_large, 0, {std::to_string(cube_glb().size()), "100"}));
}

TEST_F(MeshImport, ALineOfAnObjMayBeIndentedBeginNumbersWithTheirPointAndEndWithAComment) {
  const auto plain = import("plain.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nvt 0 0\nvt 0.5 0\nvt 0 0.5\nf 1/1 2/2 3/3\n");
  ASSERT_TRUE(plain) << plain.error().to_string();
  const std::string folded[] = {
      "v 0 0 0 # 1 corner\r\n  v .1 0 0\r\nv\t0 .1 -.0 # .7\r\nvt .0 0\r\nvt .5 0\r\nvt 0 .5#\r\nf 1/1 2/2 3/3 # 4\r\n",
      "v 0 0 0\nv .1 \\\n.0 .0\nv 0 .1 0\nvt 0 0\nvt .5 0\nvt 0 .5\nf 1/1 2/2 \\\n3/3"};
  for (const std::string& text : folded) {
    const auto scene = import("folded.obj", text);
    ASSERT_TRUE(scene) << scene.error().to_string() << " in\n" << text;
    EXPECT_EQ(scene->meshes.at(0).positions, plain->meshes.at(0).positions) << text;
    EXPECT_EQ(scene->meshes.at(0).uv, plain->meshes.at(0).uv) << text;
  }
}

TEST_F(MeshImport, NamesInAnObjStayAsTheyAre) {
  folder_.write(".5#look.mtl", "newmtl .5#m\nKd .5 0 0\n");
  const auto scene = import("cube.obj", "mtllib .5#look.mtl\no .5#cube\nusemtl .5#m\n" + cube_obj());
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_EQ(scene->meshes.at(0).name, ".5#cube");
  EXPECT_EQ(scene->materials.at(scene->meshes.at(0).material).name, ".5#m");
  EXPECT_FLOAT_EQ(scene->materials.at(scene->meshes.at(0).material).base_colour.x(), 0.5F);
}

/// A .gltf of one triangle. `nodes` and `primitives`: the JSON of these lists. `vertices`: the count of the only accessor.
std::string triangle_gltf(const std::string& nodes, const std::string& primitives, int vertices = 3) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[)" + primitives +
         R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + std::to_string(vertices) +
         R"(,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
         R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}
constexpr const char* kPrimitive = R"({"attributes":{"POSITION":0}})";

TEST_F(MeshImport, CopiesAreCountedBeforeTheyAreMade) {
  const auto scene = import("triangle.gltf", triangle_gltf(R"({"children":[1,1]},{"mesh":0})", kPrimitive));
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_THAT(scene->nodes, SizeIs(3)) << "a mesh that is placed twice is not a fault";
  // 2^40 copies in a kilobyte; a node that is its own child; vertices that are shared by many meshes, each of which would get a copy.
  std::string doubled;
  for (int i = 1; i <= 40; ++i)
    doubled += fmt::format(R"({{"children":[{0},{0}]}},)", i);
  limits_.cpu_seconds = 2;
  for (const auto& nodes : {doubled + R"({"mesh":0})", std::string(R"({"mesh":0,"children":[0]})")}) {
    EXPECT_THAT(fault("copies.gltf", triangle_gltf(nodes, kPrimitive)),
                is_error(ErrorCode::too_large, 0, {"copies.gltf", "20000 nodes", "leave out copies"}));
  }
  std::string shared = kPrimitive;
  for (int i = 0; i < 1000; ++i)
    shared += std::string(",") + kPrimitive;
  EXPECT_THAT(fault("shared.gltf", triangle_gltf(R"({"mesh":0})", shared, 300'000)),
              is_error(ErrorCode::too_large, 0, {"16000000 vertices", "own vertices"}));
  limits_.meshes = 1000;
  EXPECT_THAT(fault("many.gltf", triangle_gltf(R"({"mesh":0})", shared)),
              is_error(ErrorCode::too_large, 0, {"1001 meshes", "1000"}));
}

TEST(ImportedScene, CopiesAreCountedBeforeTheyAreMadeSolid) {
  ImportedScene scene;
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int i = 0; i < 1000; ++i)
    scene.meshes[0].indices.insert(scene.meshes[0].indices.end(), {0, 1, 2});
  scene.nodes.resize(4001);
  for (ImportedNode& node : scene.nodes)
    node.meshes = {0};
  const auto parts = collision_parts(scene, "");
  ASSERT_FALSE(parts);
  EXPECT_THAT(parts.error(), is_error(ErrorCode::too_large, 0, {"4001000 triangles", "part_"}));
  scene.nodes[7].name = "part_of_it";
  EXPECT_TRUE(collision_parts(scene, "")) << "only this one is touched";
}

TEST_F(MeshImport, SurvivesEveryEndOfItsHelper) {
  EXPECT_THAT(fault_with("/bin/false"), is_error(ErrorCode::failed_process, 0, {"cube.obj", "status 1"}));
  EXPECT_THAT(fault_with(folder_.path() / "absent"), is_error(ErrorCode::failed_process, 0, {"absent"}));
  EXPECT_THAT(fault_with(folder_.script("crash", "kill -SEGV $$")),
              is_error(ErrorCode::failed_process, 0, {"cube.obj", "signal 11"}));
  EXPECT_THAT(fault_with(folder_.script("slow", "kill -XCPU $$")),
              is_error(ErrorCode::timed_out, 0, {"cube.obj", "processor time"}));
  EXPECT_THAT(fault_with(folder_.script("garbage", "cat /bin/sh")),
              is_error(ErrorCode::damaged, 0, {"cube.obj", "MSCN"}));
  EXPECT_THAT(fault_with(folder_.script("half", "printf MSCN")),
              is_error(ErrorCode::damaged, 0, {"cube.obj", "4 bytes"}));
  limits_.vertices = limits_.triangles = limits_.texture_bytes = limits_.nodes = limits_.meshes = limits_.materials = 1;
  limits_.textures = 1;
  EXPECT_THAT(fault_with(folder_.script("flood", "exec cat /dev/zero")),
              is_error(ErrorCode::too_large, 0, {"cube.obj"}));
}

TEST_F(MeshImport, AHelperThatHangsIsKilledWithItsChildren) {
  limits_.wall_time = std::chrono::milliseconds(300);
  const auto started = std::chrono::steady_clock::now();
  EXPECT_THAT(fault_with(folder_.script("hang", "sleep 60 & sleep 60")),
              is_error(ErrorCode::timed_out, 0, {"cube.obj", "300 ms"}));
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(20));
}

TEST_F(MeshImport, AStoppedImportEndsAtOnceWithItsHelper) {
  const auto begun = folder_.path() / "begun";
  limits_.helper = folder_.script("hang", "touch '" + begun.string() + "'; sleep 60 & sleep 60");
  std::stop_source stop;
  const std::jthread stopper([&](const std::stop_token& over) {
    while (!over.stop_requested() && !std::filesystem::exists(begun))
      std::this_thread::yield();
    stop.request_stop();
  });
  const auto scene = import_mesh(folder_.write("cube.obj", cube_obj()), limits_, stop.get_token());
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error(), is_error(ErrorCode::cancelled, 0, {"cube.obj", "stopped"})) << "and not killed after 20 s";
  EXPECT_FALSE(import_mesh(folder_.path() / "cube.obj", {}, stop.get_token())) << "a stop that came before counts, too";
}

TEST_F(MeshImport, AChildThatClosesItsOutputAndLingersIsKilledToo) {
  limits_.wall_time = std::chrono::milliseconds(300);
  EXPECT_THAT(fault_with(folder_.script("linger", "exec >&-; sleep 60")),
              is_error(ErrorCode::timed_out, 0, {"cube.obj", "300 ms"}));
}

TEST_F(MeshImport, AFileThatEatsMemoryIsRefused) {
  MECHANE_NOT_SANITIZED("a sanitizer's shadow is larger than any limit");
  limits_.memory_bytes = 128ULL << 20U;
  std::string obj;
  for (int i = 0; i < 400'000; ++i)
    obj += "v " + std::to_string(i % 600) + " " + std::to_string(i / 600) + " 1\n";
  for (int i = 1; i + 2 < 400'000; ++i)
    obj += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  EXPECT_THAT(fault("big.obj", obj), is_error(ErrorCode::too_large, 0, {"big.obj", "128 MiB"}));
}

TEST_F(MeshImport, ReadsMeshesFromElsewhere) {
  const std::filesystem::path shared = mechane::test::source_folder() / "../shared/meshes";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "no shared meshes beside the source tree";
  for (const char* name : {"fandisk.obj", "rocker-arm.obj", "spot.obj"}) {
    const auto scene = import_mesh(shared / name, limits_);
    ASSERT_TRUE(scene) << scene.error().to_string();
    const auto parts = collision_parts(*scene, "");
    ASSERT_TRUE(parts) << parts.error().to_string();
    for (const auto& part : *parts)
      EXPECT_LT(closed_volume(part.mesh), 1e8) << name << ", " << part.name << " is not closed";
  }
}

TEST_F(MeshImport, TheShippedScrewHasItsPartsAndTheyAreClosed) {
  const auto scene = import_mesh(mechane::test::source_folder() / "scenarios/models/archimedes-screw.glb", limits_);
  ASSERT_TRUE(scene) << scene.error().to_string();
  const auto inner = collision_parts(*scene, "INNER");
  const auto outer = collision_parts(*scene, "OUTER");
  ASSERT_TRUE(inner && outer);
  EXPECT_THAT(*outer, SizeIs(16));
  EXPECT_THAT(*inner, SizeIs(8 * 28 + 3));
  for (const auto* parts : {&*inner, &*outer}) {
    for (const auto& part : *parts) {
      const double volume = closed_volume(part.mesh);
      EXPECT_TRUE(volume > 0 && volume < 1) << part.name << ": " << volume;
    }
  }
  for (const char* node : {"SCENE", "WATER_BASIN", "WATER_RIVER"})
    EXPECT_TRUE(find_node(*scene, node)) << node;
}

}  // namespace
}  // namespace mechane::content
