// The thing under a pointer or hand, and its name for visitors.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::picture {

/// What a pointer or finger touches.
struct Touched {
  std::uint32_t object = 0;  ///< of the manifest
  Vec3 p_WT = Vec3::Zero();  ///< the touched point
};

/// A thing with a name for visitors.
struct NamedThing {
  std::uint32_t object = 0;  ///< of the manifest
  std::string name;          ///< in the visitor's language
  Eigen::Affine3f X_WB = Eigen::Affine3f::Identity();
  Eigen::AlignedBox3f box_B;
};

}  // namespace mechane::picture
