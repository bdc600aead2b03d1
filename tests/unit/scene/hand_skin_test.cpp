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

hand::HandBuild any_build() {
  const auto any = [](double least, double most) {
    return least + (most - least) * *rc::gen::inRange(0, 1001) / 1000.0;
  };
  hand::HandBuild build;
  build.side = *rc::gen::element(hand::HandSide::right, hand::HandSide::left);
  build.hand_scale = any(0.6, 1.4);
  for (double& scale : build.finger_scale)
    scale = any(0.75, 1.35);
  return build;
}

HandBend any_bend() {
  HandBend bend{};
  for (FingerBend& finger : bend) {
    finger.aside = *rc::gen::inRange(-20, 21) / 57.3;
    for (double& angle : finger.flexion)
      angle = *rc::gen::inRange(0, 90) / 57.3;
  }
  return bend;
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
  const picture::MeshData moved = skin().follow(X_WS, {});
  const picture::MeshData& rest = skin().rest();
  for (std::size_t v = 0; v < rest.positions.size(); v += 37) {
    RC_ASSERT((moved.positions[v].cast<double>() - X_WH * rest.positions[v].cast<double>()).norm() < 1e-5);
    RC_ASSERT((moved.normals[v].cast<double>() - X_WH.rotate(rest.normals[v].cast<double>())).norm() < 1e-4);
  }
}

RC_GTEST_PROP(HandSkin, fingertips_end_where_the_server_touches, ()) {
  const hand::HandBuild build = any_build();
  const SegmentPoses X_HS = place_hand(any_bend(), build);
  const picture::MeshData hand = skin().follow(X_HS, build);
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    const hand::FingerSize& size = finger_sizes()[f];
    const double end_m = 0.5 * size.length_m[2] + 0.4 * size.radius_m[2];
    const Vec3 end = X_HS[3 + 3 * f] * Vec3(build.length_scale(3 + 3 * f) * end_m, 0, 0);
    RC_ASSERT(away_from(hand.positions, end) < 0.004);
  }
}

RC_GTEST_PROP(HandSkin, of_a_left_hand_is_the_mirror_image_and_looks_outwards, ()) {
  const HandBend bend = any_bend();
  hand::HandBuild build = any_build();
  build.side = hand::HandSide::right;
  const picture::MeshData right = skin().follow(place_hand(bend, build), build);
  build.side = hand::HandSide::left;
  const picture::MeshData left = skin().follow(place_hand(bend, build), build);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < left.indices.size(); i += 3) {
    const std::uint32_t v = left.indices[i];
    RC_ASSERT((left.positions[v] - Vec3f(1, 1, -1).cwiseProduct(right.positions[v])).norm() < 1e-6F);
    const auto side = [&](std::size_t k) { return Vec3f(left.positions[left.indices[i + k]] - left.positions[v]); };
    wrong += side(1).cross(side(2)).dot(left.normals[v]) < 0 ? 1 : 0;
  }
  RC_ASSERT(wrong < left.indices.size() / 3 / 20);  // some faces fold where fingers bend
}

RC_GTEST_PROP(HandShape, tells_which_hand_it_is_and_how_large_from_its_poses, ()) {
  const hand::HandBuild build = any_build();
  SegmentPoses X_WS = place_hand(any_bend(), build);
  const Pose X_WH = any_pose();
  for (Pose& X : X_WS)
    X = X_WH * X;
  const hand::HandBuild found = build_of(X_WS);
  RC_ASSERT(found.side == build.side);
  RC_ASSERT(std::abs(found.hand_scale - build.hand_scale) < 1e-6);
  for (std::size_t f = 0; f < client::kFingers; ++f)
    RC_ASSERT(std::abs(found.finger_scale[f] - build.finger_scale[f]) < 1e-6);
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
