// What a pointer or a hand is on, and what visitors call it.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Dense>

#include "server/base/math.hpp"

namespace mechane::picture {

/// What a pointer or a finger is on.
struct Touched {
  std::uint32_t object = 0;  ///< of the manifest
  Vec3 p_WT = Vec3::Zero();  ///< there
};

/// A thing that visitors have a name for, and where it is.
struct NamedThing {
  std::uint32_t object = 0;  ///< of the manifest
  std::string name;          ///< in the visitor's language
  Eigen::Affine3f X_WB = Eigen::Affine3f::Identity();
  Eigen::AlignedBox3f box_B;
};

}  // namespace mechane::picture
