#include "client-sdk/draw/stillness.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::draw {
namespace {

picture::Instance instance_at(std::uint32_t mesh, float x_m) {
  picture::Instance out;
  out.mesh = mesh;
  out.X_WM.translation().x() = x_m;
  return out;
}

RC_GTEST_PROP(Stillness, counts_the_pictures_since_a_thing_last_moved, ()) {
  Stillness<InstanceKey> stillness;
  const auto moves = *rc::gen::container<std::vector<bool>>(12, rc::gen::arbitrary<bool>());
  float x_m = 0;
  std::uint32_t expected = 0;
  for (const bool move : moves) {
    if (move) x_m += 0.001F;
    expected = move ? 1 : expected + 1;
    const std::vector<picture::Instance> things{instance_at(1, x_m), instance_at(2, 0)};
    stillness.see(std::span(things));
    RC_ASSERT(stillness.pictures(InstanceKey(things[0])) == expected);
  }
  RC_ASSERT(stillness.pictures(InstanceKey(instance_at(2, 0))) == moves.size());
}

TEST(Stillness, what_is_hidden_for_a_picture_begins_anew) {
  Stillness<InstanceKey> stillness;
  const std::vector<picture::Instance> things{instance_at(1, 0.5F)};
  stillness.see(std::span(things));
  stillness.see(std::span(things));
  stillness.see(std::span<const picture::Instance>());
  EXPECT_EQ(stillness.pictures(InstanceKey(things[0])), 0U);
  stillness.see(std::span(things));
  EXPECT_EQ(stillness.pictures(InstanceKey(things[0])), 1U);
}

TEST(Stillness, a_key_has_the_whole_pose) {
  picture::Instance thing = instance_at(3, 0.25F);
  thing.X_WM.rotate(Eigen::AngleAxisf(0.7F, Vec3f::UnitY()));
  EXPECT_EQ(InstanceKey(thing).pose().matrix(), thing.X_WM.matrix());
}

}  // namespace
}  // namespace mechane::draw
