#include "client-sdk/draw/culling.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/procedural_mesh.hpp"

namespace mechane::draw {
namespace {

float between(float low, float high) {
  return low + (high - low) * static_cast<float>(*rc::gen::inRange(0, 10'000)) / 10'000.0F;
}

Eigen::Matrix4f any_picture() {
  picture::Camera camera;
  camera.p_WC = Vec3(between(-3, 3), between(-3, 3), between(-3, 3));
  camera.p_WT = camera.p_WC + Vec3(between(-1, 1), between(-0.5, 0.5), between(0.2F, 1));
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::left, 1.6);
  return view.P * view.V_CW;
}

RC_GTEST_PROP(Culling, what_is_seen_is_never_taken_for_hidden, ()) {
  const Eigen::Matrix4f PV = any_picture();
  const Vec3f low(between(-6, 6), between(-6, 6), between(-6, 6));
  const Eigen::AlignedBox3f box(low, low + Vec3f(between(0, 4), between(0, 4), between(0, 4)));
  bool seen = false;
  for (int i = 0; i < 200; ++i) {
    const Vec3f p = low + box.sizes().cwiseProduct(Vec3f(between(0, 1), between(0, 1), between(0, 1)));
    const Eigen::Vector4f c = PV * p.homogeneous();
    seen = seen || c.head<3>().cwiseAbs().maxCoeff() < c.w();
  }
  if (is_outside(PV, box)) RC_ASSERT(!seen);
}

TEST(Culling, what_lies_behind_or_beside_is_hidden) {
  picture::Camera camera;
  camera.p_WC = Vec3::Zero();
  camera.p_WT = Vec3(0, 0, -1);
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::middle, 1.5);
  const Eigen::Matrix4f PV = view.P * view.V_CW;
  const auto box_at = [](const Vec3f& p) {
    return Eigen::AlignedBox3f(p - Vec3f::Constant(0.5F), p + Vec3f::Constant(0.5F));
  };
  EXPECT_FALSE(is_outside(PV, box_at(Vec3f(0, 0, -3))));
  EXPECT_TRUE(is_outside(PV, box_at(Vec3f(0, 0, 3)))) << "behind the camera";
  EXPECT_TRUE(is_outside(PV, box_at(Vec3f(5, 0, -3))));
  EXPECT_TRUE(is_outside(PV, box_at(Vec3f(0, -5, -3))));
  EXPECT_TRUE(is_outside(PV, box_at(Vec3f(0, 0, -900)))) << "beyond what a picture reaches";
  EXPECT_FALSE(is_outside(PV, Eigen::AlignedBox3f(Vec3f::Constant(-50), Vec3f::Constant(50)))) << "all about the eye";
  EXPECT_TRUE(is_outside(PV, Eigen::AlignedBox3f()));
}

TEST(Culling, pieces_are_all_of_the_mesh_and_lie_in_their_boxes) {
  const picture::MeshData mesh = picture::sphere_mesh(1, 40, 60);
  const PiecedIndices cut = cut_up(mesh, mesh.indices, 100);
  EXPECT_GT(cut.pieces.size(), 40U);
  const auto triangles_in = [](const std::vector<std::uint32_t>& indices) {
    std::vector<std::array<std::uint32_t, 3>> out;
    for (std::size_t i = 0; i < indices.size(); i += 3)
      out.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(out);
    return out;
  };
  EXPECT_EQ(triangles_in(cut.indices), triangles_in(mesh.indices));
  std::uint32_t next = 0;
  double volume = 0;
  for (const MeshPiece& piece : cut.pieces) {
    EXPECT_EQ(piece.first_index, next);
    next += piece.index_count;
    EXPECT_LE(piece.index_count, 300U);
    for (std::uint32_t i = piece.first_index; i < next; ++i)
      EXPECT_TRUE(piece.box_M.contains(mesh.positions[cut.indices[i]]));
    volume += static_cast<double>(piece.box_M.volume());
  }
  EXPECT_EQ(next, cut.indices.size());
  EXPECT_LT(volume, 6) << "pieces lie together: 64 boxes of the whole would have 512";
  EXPECT_TRUE(cut_up(picture::MeshData{}, {}, 100).pieces.empty());
}

}  // namespace
}  // namespace mechane::draw
