// X3D's own shapes as meshes: their sizes against closed forms and against another reader, where they lie, and what bad ones say.
#include <cmath>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/content/mesh_import.hpp"
#include "server/geometry/mesh_check.hpp"
#include "tests/support/error_like.hpp"
#include "tests/unit/content/model_files.hpp"

namespace mechane::content {
namespace {

using test::is_error;
using testing::HasSubstr;

/// The scene's first line is line 2 of the file.
std::string x3d_file(const std::string& scene) {
  return "<X3D version='4.0' profile='Full'><Scene>\n" + scene + "\n</Scene></X3D>\n";
}

std::string shape_of(const std::string& geometry) {
  return "<Shape>" + geometry + "</Shape>";
}

struct Size {
  Eigen::AlignedBox3d box;
  double area_m2 = 0;
  double volume_m3 = 0;
  std::size_t open_edges = 0;
};

void add_triangle(Size& size, const Vec3& a, const Vec3& b, const Vec3& c) {
  for (const Vec3& p : {a, b, c})
    size.box.extend(p);
  size.area_m2 += (b - a).cross(c - a).norm() / 2;
  size.volume_m3 += a.dot(b.cross(c)) / 6;
}

Size size_of(const ImportedScene& scene, const std::string& node = "SCENE") {
  Size size;
  const auto parts = collision_parts(scene, node);
  EXPECT_TRUE(parts) << parts.error().to_string();
  if (!parts) return size;
  for (const geometry::NamedMesh& part : *parts) {
    size.open_edges += geometry::open_edges(part.mesh);
    for (const auto& t : part.mesh.triangles)
      add_triangle(size, part.mesh.vertices[t[0]], part.mesh.vertices[t[1]], part.mesh.vertices[t[2]]);
  }
  return size;
}

class X3dImport : public testing::Test {
 protected:
  Expected<ImportedScene> import(const std::string& scene) {
    return import_mesh(folder_.write("scene.x3d", x3d_file(scene)));
  }
  Size size(const std::string& scene) {
    const auto read = import(scene);
    EXPECT_TRUE(read) << scene << ": " << read.error().to_string();
    return read ? size_of(*read) : Size{};
  }
  /// Empty where the file is read after all.
  Error fault(const std::string& scene) {
    const auto read = import(scene);
    return read ? Error{} : read.error();
  }

  ScratchFolder folder_;
};

/// A ring of radius 1, its section a circle of radius 0.25, both of 48 points. The last point is written as the first is.
std::string torus() {
  std::string section, spine;
  for (int i = 0; i <= 48; ++i) {
    const double a = 2 * kPi * (i % 48) / 48;
    section += fmt::format("{} {} ", 0.25 * std::cos(a), -0.25 * std::sin(a));
    spine += fmt::format("{} 0 {} ", std::cos(a), std::sin(a));
  }
  return fmt::format("<Extrusion crossSection='{}' spine='{}'/>", section, spine);
}

/// An L of 3 m2 from above, 0.5 m high, its corners given once.
constexpr const char* kL =
    "<IndexedFaceSet convex='false' coordIndex='0 1 2 3 4 5 -1 11 10 9 8 7 6 -1 0 6 7 1 -1 1 7 8 2 -1 2 8 9 3 -1 "
    "3 9 10 4 -1 4 10 11 5 -1 5 11 6 0'><Coordinate point='0 0 0 2 0 0 2 0 1 1 0 1 1 0 2 0 0 2 "
    "0 0.5 0 2 0.5 0 2 0.5 1 1 0.5 1 1 0.5 2 0 0.5 2'/></IndexedFaceSet>";
constexpr const char* kTetrahedron =
    "<IndexedTriangleSet index='0 2 1 0 1 3 0 3 2 1 2 3'><Coordinate point='0 0 0 1 0 0 0 1 0 0 0 1'/>"
    "</IndexedTriangleSet>";
constexpr const char* kTriangle = "<TriangleSet><Coordinate point='0 0 0 2 0 0 0 1 0'/></TriangleSet>";
constexpr const char* kSlope =
    "<ElevationGrid xDimension='3' zDimension='2' xSpacing='2' zSpacing='3' height='0 1.5 3 0 1.5 3'/>";

struct Solid {
  std::string geometry;
  Vec3 low, high;
  double area_m2, volume_m3;
  bool closed = true;
};

TEST_F(X3dImport, ShapesHaveTheSizesOfClosedForms) {
  const double slant = std::hypot(0.5, 2);
  const Solid solids[] = {
      {"<Box size='1 2 3'/>", {-.5, -1, -1.5}, {.5, 1, 1.5}, 22, 6},
      {"<Sphere radius='0.5'/>", {-.5, -.5, -.5}, {.5, .5, .5}, kPi, kPi / 6},
      {"<Cylinder radius='0.3' height='2'/>", {-.3, -1, -.3}, {.3, 1, .3}, 2 * kPi * .3 * 2.3, kPi * .09 * 2},
      {"<Cylinder radius='0.3' top='false'/>", {-.3, -1, -.3}, {.3, 1, .3}, kPi * .3 * 4.3, -1, false},
      {"<Cone bottomRadius='0.5'/>", {-.5, -1, -.5}, {.5, 1, .5}, kPi * .5 * (slant + .5), kPi * .25 * 2 / 3},
      {"<Extrusion/>", {-1, 0, -1}, {1, 1, 1}, 16, 4},
      {"<Extrusion spine='0 0 0 0 0 -2'/>", {-1, -1, -2}, {1, 1, 0}, 24, 8},
      {"<Extrusion scale='1 1 0.5 0.5' endCap='false'/>", {-1, 0, -1}, {1, 1, 1}, -1, -1, false},
      {torus(), {-1.25, -.25, -1.25}, {1.25, .25, 1.25}, 4 * kPi * kPi * .25, 2 * kPi * kPi * .0625},
      {kL, {0, 0, 0}, {2, .5, 2}, 6 + 8 * .5, 1.5},
      {kTetrahedron, {0, 0, 0}, {1, 1, 1}, 1.5 + std::sqrt(3) / 2, 1. / 6},
      {kTriangle, {0, 0, 0}, {2, 1, 0}, 1, -1, false},
      {kSlope, {0, 0, 0}, {4, 3, 3}, 15, -1, false},
  };
  for (const Solid& solid : solids) {
    const Size is = size(shape_of(solid.geometry));
    EXPECT_LT((is.box.min() - solid.low).norm(), 0.003) << solid.geometry << is.box.min().transpose();
    EXPECT_LT((is.box.max() - solid.high).norm(), 0.003) << solid.geometry << is.box.max().transpose();
    if (solid.area_m2 > 0) {
      EXPECT_NEAR(is.area_m2, solid.area_m2, 0.01 * solid.area_m2) << solid.geometry;
    }
    if (solid.volume_m3 > 0) {
      EXPECT_NEAR(is.volume_m3, solid.volume_m3, 0.01 * solid.volume_m3) << solid.geometry;
    }
    EXPECT_EQ(is.open_edges == 0, solid.closed) << solid.geometry;
  }
}

/// The same file as assimp's reader of X3D has it, which shares nothing with ours.
Size size_by_assimp(const std::filesystem::path& file) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
  Size size;
  EXPECT_NE(scene, nullptr) << importer.GetErrorString();
  if (scene == nullptr) return size;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const auto at = [&](unsigned i) { return Vec3(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z); };
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const unsigned* i = mesh.mFaces[f].mIndices;
      if (mesh.mFaces[f].mNumIndices == 3) add_triangle(size, at(i[0]), at(i[1]), at(i[2]));
    }
  }
  return size;
}

TEST_F(X3dImport, AnotherReaderSeesTheSameShapesInTheSamePlaces) {
  const std::string transform =
      "<Transform translation='3 0 1' rotation='0.6 0.8 0 0.7' scale='1 2 0.5' center='0.2 0 0' scaleOrientation='0 1 "
      "0 "
      "0.4'>";
  for (const std::string& geometry :
       {std::string("<Box size='1 2 3'/>"), std::string(kTetrahedron), std::string(kL),
        std::string("<Extrusion spine='0 0 0 0 1 0 1 2 0' scale='1 1 0.5 0.7 0.2 0.3'/>")}) {
    const std::string scene = transform + shape_of(geometry) + "</Transform>";
    const Size ours = size(scene), theirs = size_by_assimp(folder_.path() / "scene.x3d");
    EXPECT_LT((ours.box.min() - theirs.box.min()).norm(), 1e-4) << geometry;
    EXPECT_LT((ours.box.max() - theirs.box.max()).norm(), 1e-4) << geometry;
    // A twisted side has another area by its other diagonal.
    EXPECT_NEAR(ours.area_m2, theirs.area_m2, 1e-3 * theirs.area_m2) << geometry;
  }
}

RC_GTEST_PROP(X3dImportProperty, AnyStarIsFilledWhateverItsCorners, ()) {
  // A polygon around the origin, seen whole from there: its area is known, however deep its notches are.
  const auto radii = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 100)).as("radii");
  RC_PRE(radii.size() >= 3 && radii.size() <= 60);
  std::string points, index;
  double area_m2 = 0;
  const double step = 2 * kPi / double(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double r = 0.01 * radii[i], next = 0.01 * radii[(i + 1) % radii.size()];
    points += fmt::format("{} 0 {} ", r * std::cos(step * double(i)), -r * std::sin(step * double(i)));
    index += fmt::format("{} ", i);
    area_m2 += r * next * std::sin(step) / 2;
  }
  const ScratchFolder folder;
  const auto scene = import_mesh(folder.write(
      "star.x3d",
      x3d_file(shape_of(fmt::format("<IndexedFaceSet convex='false' coordIndex='{}'><Coordinate point='{}'/>"
                                    "</IndexedFaceSet>",
                                    index, points)))));
  RC_ASSERT(scene.has_value());
  double sum_m2 = 0;
  for (const ImportedMesh& mesh : scene->meshes) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return Vec3(mesh.positions[mesh.indices[i + k]].cast<double>()); };
      sum_m2 += (at(1) - at(0)).cross(at(2) - at(0)).y() / 2;
    }
  }
  RC_ASSERT(std::abs(sum_m2 - area_m2) < 1e-4 * area_m2 + 1e-7);
}

RC_GTEST_PROP(X3dImportProperty, WhateverStandsInAFileItEndsWithASceneOrAWord, ()) {
  std::string text =
      x3d_file(shape_of(kL) + shape_of(kSlope) +
               "<Transform scale='1 1 1'><Shape DEF='A'><Extrusion creaseAngle='1' spine='0 0 0 0 1 0 0 1 0 1 "
               "1 0' scale='1 1' orientation='0 1 0 0'/></Shape></Transform><Shape USE='A'/>");
  const auto changes = *rc::gen::inRange(1, 4);
  for (int i = 0; i < changes; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(60, text.size());
    text.replace(
        at, *rc::gen::inRange<std::size_t>(0, 8),
        *rc::gen::element<std::string>("-1", " 0 ", "1e38", "7", "'", " 0 0 0", "-", "1e9 ", "", "3000000000"));
  }
  const ScratchFolder folder;
  const auto scene = import_mesh(folder.write("mutant.x3d", text));
  if (scene) return;
  RC_ASSERT(scene.error().code != ErrorCode::failed_process && scene.error().code != ErrorCode::timed_out);
  RC_ASSERT(!scene.error().what.empty() && !scene.error().remedy.empty());
}

TEST_F(X3dImport, NormalsAreSmoothBelowTheCreaseAngleAndPointOutwards) {
  const auto scene = import(shape_of("<Cylinder radius='1' height='2'/>"));
  ASSERT_TRUE(scene) << scene.error().to_string();
  const ImportedMesh& mesh = scene->meshes.at(0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f p = mesh.positions[i], n = mesh.normals[i];
    const bool end = std::abs(n.y()) > 0.5F;
    EXPECT_GT(n.dot(end ? Vec3f(0, p.y(), 0) : Vec3f(p.x(), 0, p.z())), 0.999F) << p.transpose();
  }
}

TEST_F(X3dImport, BodiesPicturesAndSceneryHaveNodesOfTheirOwn) {
  const auto scene = import(
      "<Transform DEF='PICTURE' translation='9 9 9' scale='2 2 2'><Shape><Sphere/></Shape></Transform>"
      "<Group DEF='YARD'><Transform translation='0 -1 0'><Shape DEF='GROUND'><Box size='9 1 "
      "9'/></Shape></Transform></Group>"
      "<RigidBodyCollection><RigidBody DEF='BALL' containerField='bodies' position='0 5 0'>"
      "<CollidableOffset containerField='geometry' translation='0 1 0'>"
      "<CollidableShape containerField='collidable'><Shape containerField='shape'><Box size='1 1 1'/></Shape>"
      "</CollidableShape></CollidableOffset></RigidBody></RigidBodyCollection>"
      "<ROUTE fromNode='BALL' fromField='position' toNode='PICTURE' toField='set_translation'/>");
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_LT((size_of(*scene, "BALL").box.center() - Vec3(0, 1, 0)).norm(), 1e-6);
  EXPECT_NEAR(size_of(*scene, "PICTURE").box.sizes().x(), 4, 0.01);
  EXPECT_NEAR(size_of(*scene, "SCENE").box.max().y(), -0.5, 1e-6);
  EXPECT_FALSE(is_under(*scene, *find_node(*scene, "PICTURE"), *find_node(*scene, "SCENE")));
  EXPECT_TRUE(is_under(*scene, *find_node(*scene, "GROUND"), *find_node(*scene, "YARD")));
}

TEST_F(X3dImport, AUseIsTheSameMeshAgain) {
  const auto scene =
      import("<Shape DEF='A'><Sphere/></Shape><Transform translation='5 0 0'><Shape USE='A'/></Transform>");
  ASSERT_TRUE(scene) << scene.error().to_string();
  EXPECT_EQ(scene->meshes.size(), 1U);
  EXPECT_NEAR(size_of(*scene).box.sizes().x(), 7, 0.01);
}

TEST_F(X3dImport, LooksBecomeMaterialsAndImages) {
  folder_.write("oak.png", kPng);
  const auto scene = import(
      "<Shape><Appearance><Material diffuseColor='1 0 0.5' transparency='0.25'/><ImageTexture url='\"none.png\" "
      "\"oak.png\"'/>"
      "</Appearance><Box solid='false'/></Shape>"
      "<Shape><Appearance><PhysicalMaterial baseColor='0.5 0.5 0.5' metallic='0.25' "
      "roughness='0.75'/></Appearance><Box/></Shape>"
      "<Shape><Box/></Shape>");
  ASSERT_TRUE(scene) << scene.error().to_string();
  ASSERT_EQ(scene->materials.size(), 3U);
  const ImportedMaterial& glass = scene->materials[0];
  EXPECT_NEAR(glass.base_colour.z(), 0.2140F, 1e-3F);  // 0.5 on a screen
  EXPECT_FLOAT_EQ(glass.base_colour.w(), 0.75F);
  EXPECT_EQ(glass.alpha_mode, AlphaMode::blend);
  EXPECT_TRUE(glass.double_sided);
  EXPECT_EQ(scene->textures.at(glass.base_colour_texture.value()).name, "oak.png");
  EXPECT_EQ(scene->meshes[0].uv.size(), scene->meshes[0].positions.size());
  EXPECT_FLOAT_EQ(scene->materials[1].base_colour.x(), 0.5F);
  EXPECT_FLOAT_EQ(scene->materials[1].metallic, 0.25F);
  EXPECT_FALSE(scene->materials[2].double_sided);
}

TEST_F(X3dImport, FaultsNameTheLineAndTheRemedy) {
  struct FaultOf {
    std::string scene;
    ErrorCode code;
    std::string where, what;
  };
  const auto set = [](const std::string& fields, const std::string& points = "0 0 0 1 0 0 0 1 0") {
    return "\n" + shape_of("<IndexedFaceSet " + fields + "><Coordinate point='" + points + "'/></IndexedFaceSet>");
  };
  std::string huge_ring, nested = "<Shape DEF='G0'><Sphere/></Shape>";
  for (int i = 0; i < 6000; ++i)
    huge_ring += "0 1 2 ";
  for (int i = 1; i < 20; ++i)
    nested += fmt::format("<Group DEF='G{}'><{} USE='G{}'/><{} USE='G{}'/></Group>", i, i == 1 ? "Shape" : "Group",
                          i - 1, i == 1 ? "Shape" : "Group", i - 1);
  using enum ErrorCode;
  const FaultOf faults[] = {
      {set("coordIndex='0 1 3'"), invalid_value, "line 3", "index 3 is out of range: there are 3 points"},
      {set("coordIndex='0 1 -2'"), invalid_value, "line 3", "index -2 is out of range"},
      {set("coordIndex='" + huge_ring + "'"), too_large, "line 3", "18000 corners"},
      {set("coordIndex='0 1 2'", "0 0 0 1e30 0 0 0 1 0"), invalid_value, "line 3", "too far"},
      {shape_of("<IndexedFaceSet coordIndex='0 1 2'/>"), missing, "line 2", "no points"},
      {shape_of("<TriangleSet><Coordinate point='0 0 0 1 0 0'/></TriangleSet>"), invalid_value, "line 2", "incomplete"},
      {shape_of("<Extrusion spine='0 0 0'/>"), missing, "line 2", "fewer than two"},
      {shape_of("<Extrusion scale=''/>"), missing, "line 2", "empty"},
      {shape_of("<ElevationGrid xDimension='2' zDimension='3' height='1 2 3'/>"), invalid_value, "line 2", "3 heights"},
      {shape_of("<ElevationGrid xDimension='2000000000' zDimension='2000000000' height='1 2'/>"), invalid_value,
       "line 2", ""},
      {shape_of("<Box size='1 -1 1'/>"), invalid_value, "line 2, Box", "above 0"},
      {shape_of("<Sphere radius='nan'/>"), invalid_value, "line 2, Sphere", "nan"},
      {shape_of("<Box/><Appearance><ImageTexture url='\"../oak.png\"'/></Appearance>"), not_found, "line 2", "images"},
      {"<Inline url='\"../other.x3d\"'/>", not_found, "line 2", "other.x3d"},
      {"<Inline url='\"scene.x3d\"'/>", too_large, "line 2", "8 deep"},
      {nested, too_large, "line 2", "nodes"},
      {"<Shape>", damaged, "line", "not well-formed"},
      {"<Shape><Text string='\"words\"'/></Shape>", missing, "", "no triangles"},
  };
  for (const FaultOf& expected : faults) {
    const Error is = fault(expected.scene);
    EXPECT_EQ(is.code, expected.code) << expected.scene.substr(0, 200) << is.to_string();
    EXPECT_THAT(is.where, HasSubstr(expected.where)) << is.to_string();
    EXPECT_THAT(is.what, HasSubstr(expected.what)) << is.to_string();
    EXPECT_FALSE(is.remedy.empty()) << is.to_string();
  }
}

TEST_F(X3dImport, AnInlineOfTheSameFolderIsPartOfTheScene) {
  folder_.write("wheel.x3d", x3d_file("<Shape><Sphere/></Shape>"));
  EXPECT_NEAR(size("<Transform translation='0 3 0'><Inline DEF='W' url='\"wheel.x3d\"'/></Transform>").box.max().y(), 4,
              0.01);
  folder_.write("wheel.x3d", x3d_file("\n\n<Shape><Extrusion spine=''/></Shape>"));
  const Error inner = fault("<Inline url='\"wheel.x3d\"'/>");
  EXPECT_THAT(inner.where, HasSubstr("wheel.x3d, line 4")) << inner.to_string();
  EXPECT_EQ(inner.line, 0);
}

}  // namespace
}  // namespace mechane::content
