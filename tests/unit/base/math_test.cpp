#include "server/base/math.hpp"

#include <bit>
#include <cstdint>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"

namespace mechane {
namespace {

RC_GTEST_PROP(Rotate, GivesTheBitsOfEigens, ()) {
  const Quat R = quat_from_rotation_vector(*test::between(0, kPi) * test::any_unit());
  const Vec3 v = *test::between(0, 100) * test::any_unit();
  const Vec3 ours = rotate(R, v);
  const Vec3 eigens = R * v;
  for (Eigen::Index i = 0; i < 3; ++i)
    RC_ASSERT(std::bit_cast<std::uint64_t>(ours[i]) == std::bit_cast<std::uint64_t>(eigens[i]));
}

}  // namespace
}  // namespace mechane
