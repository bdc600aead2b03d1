#include "server/x3d/shape_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mechane::x3d {
namespace {

using testing::ElementsAre;

class ShapeTreeOf : public testing::Test {
 protected:
  const ShapeTree& read(const std::string& scene) {
    document_ =
        read_document("<X3D version='4.0' profile='Full'><Scene>" + scene + "</Scene></X3D>", "a.x3d", problems_);
    if (!document_) throw std::runtime_error(document_.error().to_string());
    tree_.emplace(*document_);
    return *tree_;
  }
  NodeId def(std::string_view name) const { return document_->find_def(name); }
  std::vector<std::string> names_of(const std::vector<NodeId>& ids) const {
    std::vector<std::string> names;
    for (const NodeId id : ids)
      names.push_back(node_name(*document_, id));
    return names;
  }

  Problems problems_{"a.x3d"};
  Expected<Document> document_ = fail(ErrorCode::missing, "not read");
  std::optional<ShapeTree> tree_;
};

constexpr const char* kBall =
    "<RigidBodyCollection><RigidBody DEF='BALL' containerField='bodies'>"
    "<CollidableShape DEF='C' containerField='geometry'><Shape "
    "containerField='shape'><Sphere/></Shape></CollidableShape>"
    "</RigidBody><RigidBody DEF='GHOST' containerField='bodies'/></RigidBodyCollection>";

TEST_F(ShapeTreeOf, ABodyHasItsGeometryAndOneTransformForAPicture) {
  const ShapeTree& tree =
      read(std::string(kBall) +
           "<Transform DEF='T'><Shape><Box/></Shape></Transform><Transform DEF='U'><Shape DEF='S'><Box/>"
           "</Shape></Transform>"
           "<ROUTE fromNode='GHOST' fromField='position' toNode='U' toField='translation'/>"
           "<ROUTE fromNode='BALL' fromField='position_changed' toNode='T' toField='set_translation'/>"
           "<ROUTE fromNode='BALL' fromField='orientation' toNode='T' toField='rotation'/>"
           "<ROUTE fromNode='BALL' fromField='position' toNode='U' toField='translation'/>"
           "<ROUTE fromNode='BALL' fromField='mass' toNode='U' toField='translation'/>");
  EXPECT_THAT(tree.bodies(), ElementsAre(def("BALL")));
  EXPECT_EQ(tree.picture_of(def("BALL")), def("T"));
  EXPECT_FALSE(tree.picture_of(def("GHOST")));
  EXPECT_THAT(tree.driven(), ElementsAre(def("U"))) << "no body moves it, but events do";
  EXPECT_FALSE(tree.has_scenery());
  std::size_t routes = 0;
  for (const NodeId route : document_->elements("ROUTE"))
    routes += tree.used().contains(route) ? 1 : 0;
  EXPECT_EQ(routes, 4U);  // all but that of the mass
}

TEST_F(ShapeTreeOf, WhatIsOffHiddenOrUnknownIsNotDrawn) {
  const ShapeTree& tree = read(
      "<Group DEF='HIDDEN' visible='false'><Shape><Box/></Shape></Group><Shape DEF='TEXT'><Text/></Shape>"
      "<Switch DEF='ONE' whichChoice='1'><Shape DEF='A'><Box/></Shape><Shape DEF='B'><Box/></Shape></Switch>"
      "<Switch DEF='NONE'><Shape DEF='D'><Box/></Shape></Switch><Switch DEF='FAR' "
      "whichChoice='9'><Shape><Box/></Shape></Switch>"
      "<RigidBodyCollection><RigidBody DEF='OFF' containerField='bodies'><CollidableShape enabled='false' "
      "containerField='geometry'><Shape containerField='shape'><Sphere/></Shape></CollidableShape></RigidBody>"
      "</RigidBodyCollection>");
  EXPECT_THAT(names_of(tree.children(document_->scene())), ElementsAre("ONE", "NONE", "FAR"));
  EXPECT_THAT(names_of(tree.children(def("ONE"))), ElementsAre("B"));
  EXPECT_THAT(tree.children(def("FAR")), ElementsAre());
  EXPECT_FALSE(tree.used().contains(def("D")));
  EXPECT_THAT(tree.bodies(), ElementsAre());
}

TEST_F(ShapeTreeOf, FilesOfModelsAreNotScenery) {
  const std::string inlines = "<Inline DEF='M' url='\"m.x3d\"'/><Inline DEF='GLB' url='\"m.glb\"'/>";
  EXPECT_TRUE(read(inlines).has_scenery());
  EXPECT_FALSE(read(inlines + "<WorldInfo><MetadataString name='model' value='\"M\"'/></WorldInfo>").has_scenery());
}

TEST_F(ShapeTreeOf, ACollectionSaysHowItsBodiesRub) {
  const ShapeTree& tree =
      read(std::string(kBall) +
           "<CollisionSensor><CollisionCollection DEF='OFF' enabled='false' containerField='collider'>"
           "<CollidableShape USE='C' containerField='collidables'/></CollisionCollection></CollisionSensor>"
           "<CollisionSensor><CollisionCollection DEF='ON' containerField='collider'>"
           "<CollidableShape USE='C' containerField='collidables'/></CollisionCollection></CollisionSensor>");
  EXPECT_EQ(tree.collection_of(def("BALL")), def("ON"));
  EXPECT_TRUE(tree.used().contains(def("C")));
  EXPECT_FALSE(tree.used().contains(def("OFF")));
}

TEST_F(ShapeTreeOf, NamesWithoutDefDiffer) {
  const ShapeTree& tree = read("<Shape><Box/></Shape><Shape><Box/></Shape><Shape DEF='A'><Box/></Shape>");
  const auto names = names_of(tree.children(document_->scene()));
  ASSERT_EQ(names.size(), 3U);
  EXPECT_NE(names[0], names[1]);
  EXPECT_EQ(names[2], "A");
}

TEST_F(ShapeTreeOf, AFileOfVrmlIsSentToItsConverter) {
  for (const char* text : {"#VRML V2.0 utf8\nShape { geometry Box { } }", "#X3D V3.3 utf8\nPROFILE Full\n"}) {
    Problems problems("a.wrl");
    const auto document = read_document(text, "a.wrl", problems);
    ASSERT_FALSE(document);
    EXPECT_EQ(document.error().code, ErrorCode::not_supported);
    EXPECT_THAT(document.error().remedy, testing::HasSubstr("tovrmlx3d --encoding xml"));
  }
}

}  // namespace
}  // namespace mechane::x3d
