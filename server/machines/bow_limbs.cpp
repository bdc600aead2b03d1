#include "server/machines/bow_limbs.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::machines {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kLeast_m = 1e-3;  // shorter limbs and strings are refused

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
/// From a to b, counter-clockwise.
double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// The two bodies that a parameter names. Errors: another count, a fixed one.
Expected<std::array<BodyId, 2>> read_pair(const Build& build, const std::string& parameter) {
  const std::vector<std::string> names = build.parameters.texts(parameter);
  if (names.size() != 2)
    return fail(names.empty() ? ErrorCode::missing : ErrorCode::invalid_value,
                "'" + parameter + "' names " + std::to_string(names.size()) + " bodies", build.place(parameter),
                "give limbs and strings with two bodies each, in the same order; or neither");
  std::array<BodyId, 2> bodies;
  for (std::size_t i = 0; i < 2; ++i) {
    bodies[i] = build.description.find_body(names[i]);
    if (build.description.bodies[bodies[i].index()].fixed)
      return fail(ErrorCode::conflict, "the body '" + names[i] + "' is fixed", build.place(parameter),
                  "name bodies that can move in '" + parameter + "'");
  }
  return bodies;
}

}  // namespace

Expected<BowLimbs> BowLimbs::make(const Build& build, JointId slider, double direction) {
  BowLimbs made;
  if (!build.parameters.given("limbs") && !build.parameters.given("strings")) return made;
  const auto limbs = read_pair(build, "limbs"), strings = read_pair(build, "strings");
  if (!limbs) return tl::unexpected(limbs.error());
  if (!strings) return tl::unexpected(strings.error());
  const state::WorldDescription& world = build.description;
  const state::JointDescription& joint = world.joints[slider.index()];
  made.given_ = true;
  made.stock_ = joint.body1;
  made.draw_S_ = direction * joint.X_B1J.rotate(Vec3::UnitX());
  const Pose X_SW = (made.stock_ ? world.bodies[made.stock_.index()].X_WB : Pose{}).inverse();
  for (std::size_t i = 0; i < 2; ++i) {
    Side& side = made.sides_[i];
    side.limb = (*limbs)[i];
    side.string = (*strings)[i];
    side.X_SL = X_SW * world.bodies[side.limb.index()].X_WB;
    side.X_ST = X_SW * world.bodies[side.string.index()].X_WB;
  }
  made.p_SN_ = 0.5 * (made.sides_[0].X_ST.p + made.sides_[1].X_ST.p);
  for (Side& side : made.sides_) {
    const Vec3 p_NT = side.X_ST.p - made.p_SN_, p_NL = side.X_SL.p - made.p_SN_;
    side.half_m = p_NT.norm();
    if (side.half_m < kLeast_m || std::abs(p_NT.dot(made.draw_S_)) > kLeast_m)
      return fail(ErrorCode::conflict, "the string at rest is too short, or not at right angles to the draw",
                  build.place("strings"), "put the origins of 'strings' at the limbs' tips, level with each other");
    side.across_S = p_NT / side.half_m;
    side.root = {p_NL.dot(side.across_S), p_NL.dot(made.draw_S_)};
    const Vec2 arm = Vec2(side.half_m, 0) - side.root;
    side.arm_m = arm.norm();
    if (side.arm_m < kLeast_m || side.root.norm() < kLeast_m)
      return fail(ErrorCode::conflict, "a limb has no length, or its root lies at the string's middle",
                  build.place("limbs"), "put the origins of 'limbs' where they leave the bow's middle");
    side.sign = cross(-side.root, arm) < 0 ? -1 : 1;
  }
  return made;
}

Vec2 BowLimbs::tip(const Side& side, double draw_m) noexcept {
  const Vec2 way = Vec2(0, draw_m) - side.root;
  const double between_m = std::max(way.norm(), kLeast_m);
  const double along_m =
      (side.arm_m * side.arm_m - side.half_m * side.half_m + between_m * between_m) / (2 * between_m);
  const double held_m = std::clamp(along_m, -side.arm_m, side.arm_m);  // the limb reaches no farther
  const double off_m = std::sqrt(side.arm_m * side.arm_m - held_m * held_m);
  const Vec2 towards = way / between_m;
  return side.root + held_m * towards + side.sign * off_m * Vec2(-towards.y(), towards.x());
}

void BowLimbs::follow(state::WorldState& state, double draw_m) const noexcept {
  if (!given_) return;
  const Pose X_WS = stock_ ? state[stock_].X_WB : Pose{};
  for (const Side& side : sides_) {
    const Vec2 at = tip(side, draw_m), rest(side.half_m, 0);
    const Vec3 axis_S = side.across_S.cross(draw_S_);
    const auto put = [&](BodyId id, const Vec3& p_S, double turn_rad, const Quat& rest_R) {
      state::BodyState& body = state[id];
      body.movable = false;
      body.X_WB = X_WS * Pose{p_S, (Quat(Eigen::AngleAxisd(turn_rad, axis_S)) * rest_R).normalized()};
      body.V_WB = {};
    };
    put(side.limb, side.X_SL.p, angle_between(rest - side.root, at - side.root), side.X_SL.R);
    put(side.string, p_SN_ + at.x() * side.across_S + at.y() * draw_S_, angle_between(-rest, Vec2(0, draw_m) - at),
        side.X_ST.R);
  }
}

void BowLimbs::lose_string(state::WorldState& state) const noexcept {
  if (!given_) return;
  for (const Side& side : sides_)
    state[side.string].visible = false;
}

}  // namespace mechane::machines
