#include "client-sdk/scene/hand_skin.hpp"

#include <map>
#include <numeric>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/scene/hand_model.hpp"

namespace mechane::scene {
namespace {

const HandSkin& skin() {
  return HandSkin::shared();
}

Pose any_pose() {
  const auto any = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
  const Vec3 axis = Vec3(any(), any(), any()) + Vec3(0, 2, 0);
  return {Vec3(any(), any(), any()), Quat(Eigen::AngleAxisd(3 * any(), axis.normalized()))};
}

double away_from(const std::vector<Vec3f>& points, const Vec3& p) {
  double least = 1;
  for (const Vec3f& q : points)
    least = std::min(least, (q.cast<double>() - p).norm());
  return least;
}

TEST(HandSkin, is_closed_and_of_one_piece) {
  const picture::MeshData& rest = skin().rest();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<std::uint32_t> piece(rest.positions.size());
  std::iota(piece.begin(), piece.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (piece[v] != v)
      v = piece[v] = piece[piece[v]];
    return v;
  };
  for (std::size_t i = 0; i < rest.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = rest.indices[i + k];
      const std::uint32_t b = rest.indices[i + (k + 1) % 3];
      ++edges[{a, b}];
      --edges[{b, a}];
      piece[root(a)] = root(b);
    }
  }
  for (const auto& [edge, sum] : edges)
    ASSERT_EQ(sum, 0) << "an edge with one side only: a hole";
  for (std::uint32_t v = 0; v < piece.size(); ++v)
    ASSERT_EQ(root(v), root(0)) << "beads, not a hand";
}

TEST(HandSkin, faces_look_the_way_of_their_normals) {
  const picture::MeshData& rest = skin().rest();
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rest.indices.size(); i += 3) {
    const Vec3f& a = rest.positions[rest.indices[i]];
    const Vec3f face = (rest.positions[rest.indices[i + 1]] - a).cross(rest.positions[rest.indices[i + 2]] - a);
    wrong += face.dot(rest.normals[rest.indices[i]]) < 0 ? 1 : 0;
  }
  EXPECT_LT(wrong, rest.indices.size() / 3 / 100) << "of " << rest.indices.size() / 3;
}

RC_GTEST_PROP(HandSkin, moves_as_a_whole_with_its_segments, ()) {
  const Pose X_WH = any_pose();
  SegmentPoses X_WS = HandSkin::rest_poses();
  for (Pose& X : X_WS)
    X = X_WH * X;
  const picture::MeshData moved = skin().follow(X_WS, 1);
  const picture::MeshData& rest = skin().rest();
  for (std::size_t v = 0; v < rest.positions.size(); v += 37) {
    RC_ASSERT((moved.positions[v].cast<double>() - X_WH * rest.positions[v].cast<double>()).norm() < 1e-5);
    RC_ASSERT((moved.normals[v].cast<double>() - X_WH.rotate(rest.normals[v].cast<double>())).norm() < 1e-4);
  }
}

RC_GTEST_PROP(HandSkin, fingertips_end_where_the_server_touches, ()) {
  HandBend bend{};
  for (FingerBend& finger : bend) {
    for (double& angle : finger.flexion)
      angle = *rc::gen::inRange(0, 90) / 57.3;
  }
  const SegmentPoses X_HS = place_hand(bend);
  const picture::MeshData hand = skin().follow(X_HS, 1);
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    const hand::FingerSize& size = finger_sizes()[f];
    const Vec3 end = X_HS[3 + 3 * f] * Vec3(0.5 * size.length_m[2] + 0.4 * size.radius_m[2], 0, 0);
    RC_ASSERT(away_from(hand.positions, end) < 0.004);
  }
}

RC_GTEST_PROP(HandModel, a_tip_has_a_hand_that_ends_in_it, ()) {
  const Vec3 p_WT = any_pose().p;
  picture::Camera camera;
  camera.p_WC = Vec3(0.3, 1.6, 4);
  const SegmentPoses pointing = hand_at_tip(p_WT, false, camera);
  RC_ASSERT((finger_tip(pointing, 1) - p_WT).norm() < 1e-6);
  const SegmentPoses holding = hand_at_tip(p_WT, true, camera);
  RC_ASSERT((0.5 * (finger_tip(holding, 0) + finger_tip(holding, 1)) - p_WT).norm() < 1e-6);
  RC_ASSERT((finger_tip(holding, 0) - finger_tip(holding, 1)).norm() < 0.025);
  const Eigen::Vector4f ahead_W = -picture::eye_view(camera, picture::Eye::middle, 1).V_CW.row(2).transpose();
  const auto depth = [&](const Vec3& p_W) { return ahead_W.head<3>().cast<double>().dot(p_W); };
  for (const SegmentPoses& hand : {pointing, holding})
    RC_ASSERT(depth(hand[0].p) < depth(p_WT));
}

}  // namespace
}  // namespace mechane::scene
