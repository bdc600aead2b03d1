// Blocks and plates that collide, for the tests of dynamics. Their collision objects are built once.
#pragma once

#include <map>
#include <tuple>

#include "server/collision_build/object_builder.hpp"
#include "tests/support/shapes.hpp"
#include "tests/unit/dynamics/scene.hpp"

namespace mechane::dynamics::test {

inline constexpr double kDensity_kg_per_m3 = 700;  // wood

inline std::shared_ptr<const collision::Object> box_object(const Vec3& half_m) {
  static std::map<std::tuple<double, double, double>, std::shared_ptr<const collision::Object>> built;
  auto& object = built[{half_m.x(), half_m.y(), half_m.z()}];
  if (object == nullptr) {
    const std::vector<geometry::NamedMesh> parts{{"box", mechane::test::box(half_m)}};
    auto made = collision_build::build_object(parts, {});
    if (!made) throw std::runtime_error(made.error().to_string());
    object = std::make_shared<const collision::Object>(std::move(*made));
  }
  return object;
}

inline Vec3 box_inertia(double mass_kg, const Vec3& half_m) {
  const Vec3 square = half_m.cwiseProduct(half_m);
  return mass_kg / 3 * Vec3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y());
}

/// A wooden block that falls and collides, at a place.
inline state::BodyDescription block(const std::string& name, const Vec3& half_m, const Pose& X_WB,
                                    double friction = 0.5) {
  const double mass_kg = kDensity_kg_per_m3 * 8 * half_m.prod();
  state::BodyDescription out = body(name, mass_kg, box_inertia(mass_kg, half_m));
  out.use_gravity = true;
  out.X_WB = X_WB;
  out.object = box_object(half_m);
  out.collides = true;
  out.haptic.static_friction = out.haptic.dynamic_friction = friction;
  return out;
}

inline const Vec3 kTableHalf_m(0.3, 0.02, 0.2);

/// A fixed plate whose top is at y = 0, turned about z through the middle of its top.
inline state::BodyDescription table(double slope_rad = 0, double friction = 0.5) {
  const Quat R(Eigen::AngleAxisd(slope_rad, Vec3::UnitZ()));
  state::BodyDescription out = block("TABLE", kTableHalf_m, {R * Vec3(0, -kTableHalf_m.y(), 0), R}, friction);
  out.fixed = true;
  return out;
}

/// A world of bodies that stand in W.
inline state::WorldDescription world_of(std::vector<state::BodyDescription> bodies) {
  state::WorldDescription out;
  out.bodies = std::move(bodies);
  return out;
}

}  // namespace mechane::dynamics::test
