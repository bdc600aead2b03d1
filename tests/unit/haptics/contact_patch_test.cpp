#include "server/haptics/contact_patch.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::haptics {
namespace {

state::Contact contact(double depth_m, const Vec3& n, std::uint8_t segment = 0, std::size_t body = 0) {
  state::Contact c;
  c.body = BodyId(body);
  c.segment = segment;
  c.n_BH_W = n;
  c.depth_m = depth_m;
  return c;
}

Vec3 total_push(const std::vector<state::Contact>& contacts) {
  ContactPatches patches;
  gather_patches(contacts, patches);
  Vec3 sum = Vec3::Zero();
  for (const ContactPatch& patch : patches)
    sum += patch.push_m;
  return sum;
}

/// The flaw of equation 18 that the product's mode mends: a second point that comes in at no depth must change nothing.
RC_GTEST_PROP(ContactPatch, APointThatJustTouchesChangesNothing, ()) {
  const double depth = 1e-4 * *rc::gen::inRange(1, 100);
  const double angle = 0.01 * *rc::gen::inRange(0, 300);
  const Vec3 n1 = Vec3::UnitY();
  const Vec3 n2(std::sin(angle), std::cos(angle), 0);
  const Vec3 alone = total_push({contact(depth, n1)});
  const Vec3 with_touch = total_push({contact(depth, n1), contact(1e-12, n2)});
  RC_ASSERT((alone - with_touch).norm() < 1e-9);
}

TEST(ContactPatch, APinchDoesNotCancel) {
  ContactPatches patches;
  const std::vector<state::Contact> pinch{contact(0.002, Vec3::UnitX(), 3), contact(0.002, -Vec3::UnitX(), 6)};
  gather_patches(pinch, patches);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_NEAR(patches[0].depth_m, 0.002, 1e-12);
  EXPECT_NEAR(patches[1].depth_m, 0.002, 1e-12);
}

TEST(ContactPatch, EqualPointsPushAsOne) {
  const Vec3 one = total_push({contact(0.003, Vec3::UnitY())});
  const Vec3 many = total_push(std::vector<state::Contact>(20, contact(0.003, Vec3::UnitY())));
  EXPECT_NEAR((one - many).norm(), 0, 1e-12);
}

TEST(ContactPatch, MoreTouchesThanThereIsRoomForAreLeftOut) {
  std::vector<state::Contact> many;
  for (std::size_t body = 0; body < 100; ++body)
    many.push_back(contact(0.001, Vec3::UnitY(), 0, body));
  ContactPatches patches;
  gather_patches(many, patches);
  EXPECT_EQ(patches.size(), kMaxPatches);
}

}  // namespace
}  // namespace mechane::haptics
