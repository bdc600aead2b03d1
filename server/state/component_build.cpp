#include "server/state/component_build.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mechane::state {
namespace {

std::string_view plain_name(JointKind kind) {
  switch (kind) {
    case JointKind::hinge:
      return "hinge";
    case JointKind::slider:
      return "slider";
    case JointKind::ball:
      break;
  }
  return "ball joint";
}

}  // namespace

std::string_view x3d_name(JointKind kind) {
  switch (kind) {
    case JointKind::hinge:
      return "SingleAxisHingeJoint";
    case JointKind::slider:
      return "SliderJoint";
    case JointKind::ball:
      break;
  }
  return "BallJoint";
}

Expected<JointId> ComponentBuild::joint(std::string_view parameter, JointKind kind) const {
  const JointId joint = parameters.joint(parameter);
  if (description.joints[joint.index()].kind == kind) return joint;
  return fail(
      ErrorCode::invalid_value,
      fmt::format("the joint '{}' in '{}' is not a {}", parameters.text(parameter), parameter, plain_name(kind)),
      place(parameter), fmt::format("name a {} in '{}'", x3d_name(kind), parameter));
}

Expected<JointId> ComponentBuild::hinge_or_slider(std::string_view parameter) const {
  const JointId joint = parameters.joint(parameter);
  if (description.joints[joint.index()].kind != JointKind::ball) return joint;
  return fail(ErrorCode::invalid_value,
              fmt::format("the joint '{}' in '{}' is a ball joint", parameters.text(parameter), parameter),
              place(parameter), fmt::format("name a SingleAxisHingeJoint or a SliderJoint in '{}'", parameter));
}

Vec3 ComponentBuild::vector(std::string_view parameter) const {
  const std::vector<double> numbers = parameters.numbers(parameter);
  return {numbers[0], numbers[1], numbers[2]};
}

Expected<Vec3> ComponentBuild::direction(std::string_view parameter, const Vec3& otherwise) const {
  if (!parameters.given(parameter)) return otherwise;
  const Vec3 given = vector(parameter);
  if (given.norm() < 1e-9)
    return fail(ErrorCode::invalid_value, fmt::format("'{}' is 0 0 0, which has no direction", parameter),
                place(parameter), "write a vector that is not 0 0 0, or leave it out");
  return Vec3(given.normalized());
}

Expected<double> ComponentBuild::whole_number(std::string_view parameter) const {
  const double number = parameters.number(parameter);
  if (number == std::floor(number)) return number;
  return fail(ErrorCode::invalid_value, fmt::format("'{}' is {}, which is not a whole number", parameter, number),
              place(parameter), "write it without a fraction, like 1 or 2");
}

}  // namespace mechane::state
