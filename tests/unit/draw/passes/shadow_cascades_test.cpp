#include "client-sdk/draw/passes/shadow_cascades.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::draw {
namespace {

constexpr std::uint32_t kMapSize = 1024;

float drawn_number(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'000)) / 10'000.0F;
}

Vec3f any_sun() {
  return {drawn_number(-1, 1), drawn_number(0.1F, 1), drawn_number(-1, 1)};
}

Eigen::AlignedBox3f about(const Vec3f& middle, float half) {
  return {middle - Vec3f::Constant(half), middle + Vec3f::Constant(half)};
}

Vec3f corner_of(const Eigen::AlignedBox3f& box, int corner) {
  return box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner));
}

Vec3f in_map(const ShadowSetup& setup, std::size_t cascade, const Vec3f& p_W) {
  return (setup.PV(cascade) * p_W.homogeneous()).head<3>();
}

RC_GTEST_PROP(ShadowCascades, the_widest_covers_all_and_the_narrowest_the_focus, ()) {
  const Vec3f touched(drawn_number(-5, 5), drawn_number(0, 2), drawn_number(-5, 5));
  const Eigen::AlignedBox3f focus = about(touched, drawn_number(0.2F, 2));
  const Eigen::AlignedBox3f all = about(touched, drawn_number(2, 90));
  const ShadowSetup setup = shadow_setup(focus, all, any_sun(), kMapSize);
  for (int corner = 0; corner < 8; ++corner) {
    RC_ASSERT(in_map(setup, setup.cascades.size() - 1, corner_of(all, corner)).cwiseAbs().maxCoeff() <= 1.0F);
    // Even before the next one is mixed in.
    const Vec3f near = in_map(setup, 0, corner_of(focus, corner));
    RC_ASSERT(near.head<2>().cwiseAbs().maxCoeff() <= kCascadeBlend + 0.01F);
  }
  for (std::size_t k = 1; k < setup.cascades.size(); ++k)
    RC_ASSERT(setup.cascades[k].half_m > 1.2F * setup.cascades[k - 1].half_m);
}

RC_GTEST_PROP(ShadowCascades, a_focus_that_moves_moves_the_maps_by_whole_texels, ()) {
  const Vec3f sun = any_sun();
  const Eigen::AlignedBox3f all = about(Vec3f::Zero(), 60);
  const Vec3f moved(drawn_number(-1, 1), drawn_number(-1, 1), drawn_number(-1, 1));
  const ShadowSetup a = shadow_setup(about(Vec3f::Zero(), 1), all, sun, kMapSize);
  const ShadowSetup b = shadow_setup(about(moved, 1), all, sun, kMapSize);
  RC_ASSERT(a.cascades.size() == kMostCascades);
  RC_ASSERT(b.cascades.size() == kMostCascades);
  const Vec3f p(drawn_number(-0.5F, 0.5F), drawn_number(-0.5F, 0.5F), drawn_number(-0.5F, 0.5F));
  for (std::size_t k = 0; k < a.cascades.size(); ++k) {
    RC_ASSERT(a.cascades[k].half_m == b.cascades[k].half_m);
    const Eigen::Vector2f texels = 0.5F * kMapSize * (in_map(b, k, p) - in_map(a, k, p)).head<2>();
    RC_ASSERT((texels - texels.array().round().matrix()).cwiseAbs().maxCoeff() < 0.02F);
  }
}

RC_GTEST_PROP(ShadowCascades, what_is_left_out_of_a_wider_map_shades_nothing_there, ()) {
  const ShadowSetup setup = shadow_setup(about(Vec3f(0, 1, 0), 1), about(Vec3f::Zero(), 40), any_sun(), kMapSize);
  const Eigen::AlignedBox3f box =
      about(Vec3f(drawn_number(-3, 3), drawn_number(0, 3), drawn_number(-3, 3)), drawn_number(0.01F, 0.5F));
  if (!is_shadow_within(setup, 1, Eigen::Affine3f::Identity(), box)) return;
  // All along the sun's rays through the box the narrower map is looked at, alone.
  const Vec3f along = setup.X_LW.block<1, 3>(2, 0).transpose();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f p = corner_of(box, corner) + drawn_number(-5, 50) * along;
    RC_ASSERT(in_map(setup, 0, p).head<2>().cwiseAbs().maxCoeff() < kCascadeBlend);
  }
}

TEST(ShadowCascades, a_small_place_needs_one_map) {
  const Eigen::AlignedBox3f room = about(Vec3f(0, 1, 0), 1);
  EXPECT_EQ(shadow_setup(room, room, Vec3f(1, 1, 0), kMapSize).cascades.size(), 1U);
  EXPECT_EQ(shadow_setup({}, room, Vec3f(1, 1, 0), kMapSize).cascades.size(), 1U);
  EXPECT_FALSE(
      is_shadow_within(shadow_setup(room, room, Vec3f(1, 1, 0), kMapSize), 0, Eigen::Affine3f::Identity(), room));
}

}  // namespace
}  // namespace mechane::draw
