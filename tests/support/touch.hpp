// What tests and benchmarks of touch have in common.
#pragma once

#include <cmath>
#include <memory>
#include <span>

#include "server/collision_build/object_builder.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::test {

/// The object of parts that can be built; throws otherwise.
inline std::shared_ptr<const collision::Object> built(std::span<const geometry::NamedMesh> parts) {
  return std::make_shared<const collision::Object>(collision_build::build_object(parts, {}).value());
}
inline std::shared_ptr<const collision::Object> built(const geometry::Mesh& mesh) {
  const geometry::NamedMesh part{"part", mesh};
  return built(std::span(&part, 1));
}

inline double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / kPi;
}

/// Bends a glove's finger: 0 flat, 1 around a bar of 36 mm.
inline void close_finger(hand::HandSample& sample, std::size_t finger, double closed) {
  for (std::size_t k = 1; k < hand::kFingerJoints; ++k)
    sample.joints[hand::kFingerJoints * finger + k] = closed * (finger == 0 ? 0.2 : k == 1 ? 0.9 : 1.25);
}

}  // namespace mechane::test
