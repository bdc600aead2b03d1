// Standard X3D, without our metadata: its bodies have their own shapes, and move as X3D says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Compiled {
  Expected<state::WorldDescription> world = fail(ErrorCode::missing, "not compiled");
  std::vector<std::string> loaded;
  std::vector<x3d::Problem> problems;
  std::size_t left_out = 0;
};

Compiled compiled(const std::string& scene) {
  x3d::Problems problems("plain.x3d");
  FakeLoader loader;
  Compiled result;
  const auto document = x3d::read_document("<X3D version='4.0' profile='Full'><Scene>\n" + scene + "</Scene></X3D>",
                                           "plain.x3d", problems);
  if (document) result.world = compile(*document, loader, problems);
  EXPECT_TRUE(result.world) << result.world.error().to_string();
  return {std::move(result.world), loader.loaded, problems.all(), problems.left_out()};
}

/// Its CollidableShape is called C_ and its own name; without a name neither has one.
std::string body(const std::string& def, const std::string& fields) {
  const auto name = [&](const std::string& prefix) { return def.empty() ? "" : "DEF='" + prefix + def + "' "; };
  return "<RigidBody " + name("") + "containerField='bodies' " + fields + "><CollidableShape " + name("C_") +
         "containerField='geometry'><Shape containerField='shape'><Box/></Shape></CollidableShape></RigidBody>\n";
}

std::string bodies(const std::string& inside) {
  return "<RigidBodyCollection>" + inside + "</RigidBodyCollection>\n";
}

TEST(PlainX3d, ABodyHasItsOwnShapeAndWhatDrivesIt) {
  const Compiled is =
      compiled(bodies(body("A",
                           "mass='2' inertia='1 0 0 0 1 0 0 0 1' centerOfMass='0 1 0' linearVelocity='1 0 0' "
                           "angularVelocity='0 0 2' forces='1 2 3 1 0 0' torques='0 0 5'")));
  ASSERT_TRUE(is.world);
  const state::BodyDescription& a = is.world->bodies.at(0);
  EXPECT_THAT(is.loaded, ElementsAre("plain.x3d#A"));
  EXPECT_EQ(a.mesh.uri, "plain.x3d");
  EXPECT_EQ(a.mesh.content_hash.size(), 32U);
  EXPECT_TRUE(a.object && a.collides);
  EXPECT_EQ(a.drive.f, Vec3(2, 2, 3));
  EXPECT_EQ(a.drive.t, Vec3(0, 0, 5));
  EXPECT_EQ(a.V_WB.w, Vec3(0, 0, 2));
  EXPECT_LT((a.V_WB.at(a.p_BCm) - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(a.linear_damping, 0);
  EXPECT_EQ(is.left_out, 0U);
  EXPECT_THAT(is.problems,
              testing::Not(testing::Contains(testing::Field(&x3d::Problem::code, ErrorCode::not_supported))));
}

TEST(PlainX3d, DampingIsX3dsWithAutoDamp) {
  const Compiled is = compiled(bodies(body("A", "autoDamp='true' linearDampingFactor='0.5'")));
  EXPECT_EQ(is.world->bodies[0].linear_damping, 0.5);
  EXPECT_EQ(is.world->bodies[0].angular_damping, 0.001);
}

TEST(PlainX3d, ATransformThatABodyMovesIsItsPicture) {
  const Compiled is = compiled(bodies(body("A", "")) +
                               "<Transform DEF='T'><Shape><Sphere/></Shape></Transform>"
                               "<ROUTE fromNode='A' fromField='position' toNode='T' toField='translation'/>");
  EXPECT_EQ(is.world->bodies.at(0).mesh.node, "T");
  EXPECT_THAT(is.loaded, ElementsAre("plain.x3d#A"));
  EXPECT_EQ(is.left_out, 0U);
}

TEST(PlainX3d, OtherShapesAreSceneryThatIsTouched) {
  const Compiled is = compiled("<Group><Shape><Box/></Shape></Group>");
  const state::BodyDescription& scenery = is.world->bodies.at(0);
  EXPECT_TRUE(scenery.fixed && scenery.object && !scenery.collides);
  EXPECT_EQ(scenery.mesh.node, "SCENE");
}

TEST(PlainX3d, CollectionsGiveBounceAndFriction) {
  const std::string in = "'><CollidableShape USE='C_A' containerField='collidables'/></CollisionCollection>";
  const auto of = [&](const std::string& fields) {
    return compiled(
               bodies("<CollisionCollection containerField='collider' bounce='0.25' frictionCoefficients='0.75 0.5' "
                      "appliedParameters='" +
                      fields + in + body("A", "")))
        .world->bodies.at(0);
  };
  EXPECT_EQ(of("").restitution, 0.25);
  EXPECT_EQ(of("").haptic.static_friction, state::HapticMaterial{}.static_friction);
  EXPECT_EQ(of("\"FRICTION_COEFFICIENT-2\"").haptic.dynamic_friction, 0.75);
  EXPECT_EQ(of("\"FRICTION_COEFFICIENT-2\"").restitution, 0);
}

TEST(PlainX3d, BodiesNeedNoDefAndEitherSideOfAJointMayBeFixed) {
  const Compiled is = compiled(bodies(body("", "") + body("", "") + body("POST", "fixed='true'") + body("ARM", "") +
                                      "<SingleAxisHingeJoint containerField='joints' minAngle='-0.5' maxAngle='1'>"
                                      "<RigidBody USE='ARM' containerField='body1'/><RigidBody USE='POST' "
                                      "containerField='body2'/></SingleAxisHingeJoint>"));
  ASSERT_EQ(is.world->bodies.size(), 4U);
  EXPECT_NE(is.world->bodies[0].name, is.world->bodies[1].name);
  const state::JointDescription& joint = is.world->joints.at(0);
  EXPECT_EQ(joint.body2, is.world->find_body("ARM"));
  EXPECT_EQ(joint.min_position, -1);
  EXPECT_EQ(joint.max_position, 0.5);
}

TEST(PlainX3d, WhatIsNotUsedIsCounted) {
  const Compiled is = compiled(
      "<Shape><Text><FontStyle/></Text></Shape><TimeSensor "
      "DEF='T'/><Shape><Appearance><TextureTransform/></Appearance><Box/>"
      "</Shape><ROUTE fromNode='T' fromField='time' toNode='T' toField='startTime'/>");
  EXPECT_EQ(is.left_out, 6U);  // Shape, Text, FontStyle, TimeSensor, TextureTransform, ROUTE
}

TEST(PlainX3d, AScenarioToo) {
  const std::string text =
      edited("<RigidBody DEF='INNER'",
             "<RigidBody DEF='BLOCK' containerField='bodies' mass='1'>"
             "<CollidableShape containerField='geometry'><Shape containerField='shape'><Box size='0.1 0.1 0.1'/>"
             "</Shape></CollidableShape></RigidBody><RigidBody DEF='INNER'");
  FakeLoader loader;
  x3d::Problems problems("screw.x3d");
  const auto document = x3d::read_document(text, "screw.x3d", problems);
  ASSERT_TRUE(document);
  const auto world = compile(*document, loader, problems);
  ASSERT_TRUE(world) << world.error().to_string();
  const state::BodyDescription& block = world->bodies.at(world->find_body("BLOCK").index());
  EXPECT_TRUE(block.object && block.collides);
  EXPECT_EQ(block.linear_damping, 0.02);
}

}  // namespace
}  // namespace mechane::scenario
