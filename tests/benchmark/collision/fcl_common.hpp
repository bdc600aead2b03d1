// What both FCL peers share. Only their sources include it: FCL's headers take minutes.
#pragma once

#include <fcl/math/bv/OBBRSS.h>

#include "server/base/math.hpp"

namespace mechane::benchmark {

inline fcl::Transform3d fcl_transform(const Pose& X) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  result.linear() = X.R.toRotationMatrix();
  result.translation() = X.p;
  return result;
}

}  // namespace mechane::benchmark
