// X3D's joints. A joint is at position 0 in its bodies' poses at the start.
#include <array>
#include <utility>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/state/limits.hpp"

namespace mechane::scenario {
namespace {

// X3D cannot write a hinge without stops: its defaults are -pi and pi. Stops at pi or beyond on both sides are read as no stops, so that
// a crank can turn on and on.
constexpr double kNoStop = kPi - 1e-3;

/// The body in a field of the joint; none where the field is empty, and after a problem.
BodyId body_of(Compilation& c, x3d::NodeId joint, std::string_view field, bool& good) {
  for (const x3d::NodeId child : c.document.child_elements(joint)) {
    if (c.document[child].name != "RigidBody" || c.document.container_field(child, "body1") != field) continue;
    const std::string name = x3d::node_name(c.document, c.document.resolve(child));
    const BodyId body = c.world.find_body(name);
    if (body) return body;
    good = false;
    if (c.copies.contains(name)) {
      Attributes(c.document, child, c.problems)
          .error(ErrorCode::conflict, fmt::format("{} is {} bodies, and a joint joins one", name, c.copies.at(name)),
                 "write the body that is joined as a RigidBody of its own, without copies");
      return BodyId::none();
    }
    Attributes(c.document, child, c.problems)
        .error(ErrorCode::unknown_name, fmt::format("{} is not a body of this world", field),
               "USE a RigidBody that has a DEF");
  }
  return BodyId::none();
}

/// Reads the joint's bodies. `swapped`: whether body1 and body2 changed places.
bool read_bodies(Compilation& c, x3d::NodeId id, Attributes& attributes, state::JointDescription& joint,
                 bool& swapped) {
  bool good = true;
  swapped = false;
  joint.body1 = body_of(c, id, "body1", good);
  joint.body2 = body_of(c, id, "body2", good);
  if (!good) return false;
  // A single body is joined to the world, which is the frame side.
  if (joint.body1 && !joint.body2) std::swap(joint.body1, joint.body2);
  if (!joint.body2) {
    attributes.error(ErrorCode::missing, "the joint has no bodies",
                     "add <RigidBody containerField='body1' USE='...'/> and body2");
    return false;
  }
  if (joint.body1 == joint.body2) {
    attributes.error(ErrorCode::conflict, "the joint ties a body to itself", "give two bodies");
    return false;
  }
  if (c.world.bodies[joint.body2.index()].fixed) {
    if (!joint.body1 || c.world.bodies[joint.body1.index()].fixed) {
      attributes.error(ErrorCode::conflict, "the joint ties two fixed bodies", "let one of them move");
      return false;
    }
    if (!is_plain(c)) {
      attributes.error(ErrorCode::conflict, "body2 is fixed, but it is the side that moves",
                       "write the fixed body as body1");
      return false;
    }
    // To X3D both sides are equal. Angles and distances then count the other way.
    std::swap(joint.body1, joint.body2);
    swapped = true;
  }
  return true;
}

Vec3 read_axis(Attributes& attributes) {
  const Vec3 axis = attributes.vector("axis");
  if (axis.norm() > 1e-9) return axis.normalized();
  attributes.error(ErrorCode::invalid_value, "the axis has no length", "write a direction, like 0 1 0");
  return Vec3::UnitY();
}

void read_stops(Attributes& attributes, std::string_view least, std::string_view most, state::JointDescription& joint) {
  joint.min_position = attributes.number(least);
  joint.max_position = attributes.number(most);
  if (joint.min_position > joint.max_position)
    attributes.error(ErrorCode::conflict, fmt::format("{} is above {}", least, most), "swap them");
}

/// A rotation that turns the unit vector `which` into the joint's axis.
Quat frame_along(const Vec3& axis_W, const Vec3& which) {
  return Quat::FromTwoVectors(which, axis_W).normalized();
}

Pose read_geometry(Compilation& c, Attributes& attributes, state::JointDescription& joint) {
  switch (joint.kind) {
    case state::JointKind::hinge: {
      read_stops(attributes, "minAngle", "maxAngle", joint);
      if (joint.min_position <= -kNoStop && joint.max_position >= kNoStop) {
        joint.min_position = 0;
        joint.max_position = -1;
      }
      return {attributes.vector("anchorPoint"), frame_along(read_axis(attributes), Vec3::UnitZ())};
    }
    case state::JointKind::slider:
      read_stops(attributes, "minSeparation", "maxSeparation", joint);
      // X3D's slider has no anchor: its frame is at the moving body's origin.
      return {c.world.bodies[joint.body2.index()].X_WB.p, frame_along(read_axis(attributes), Vec3::UnitX())};
    case state::JointKind::ball:
      break;
  }
  return {attributes.vector("anchorPoint"), Quat::Identity()};
}

void compile_joint(Compilation& c, x3d::NodeId id, state::JointKind kind) {
  Attributes attributes(c.document, id, c.problems);
  state::JointDescription joint;
  joint.name = attributes.text("DEF");
  if (joint.name.empty()) joint.name = fmt::format("{}-line-{}", c.document[id].name, attributes.line());
  joint.kind = kind;
  bool swapped = false;
  if (!read_bodies(c, id, attributes, joint, swapped)) return;
  const Pose X_WJ = read_geometry(c, attributes, joint);
  if (swapped && joint.min_position <= joint.max_position)
    joint.min_position = -std::exchange(joint.max_position, -joint.min_position);
  const Pose X_WB1 = joint.body1 ? c.world.bodies[joint.body1.index()].X_WB : Pose{};
  joint.X_B1J = X_WB1.inverse() * X_WJ;
  joint.X_B2J = c.world.bodies[joint.body2.index()].X_WB.inverse() * X_WJ;
  if (c.world.joints.size() == state::kMaxJoints)
    attributes.error(ErrorCode::too_large,
                     fmt::format("a world takes {} joints, and this is one more", state::kMaxJoints),
                     "make one body of those that do not move on each other, or divide the exhibit");
  c.world.joints.push_back(std::move(joint));
}

}  // namespace

void compile_joints(Compilation& c) {
  using Kind = state::JointKind;
  for (const x3d::NodeId id : c.document.elements("SingleAxisHingeJoint"))
    compile_joint(c, id, Kind::hinge);
  for (const x3d::NodeId id : c.document.elements("SliderJoint"))
    compile_joint(c, id, Kind::slider);
  for (const x3d::NodeId id : c.document.elements("BallJoint"))
    compile_joint(c, id, Kind::ball);
}

}  // namespace mechane::scenario
