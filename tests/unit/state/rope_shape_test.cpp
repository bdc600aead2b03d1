// What a display is told of a rope: its line is as long as the rope, goes where the rope goes, and keeps its number of points.
#include "server/state/rope_shape.hpp"

#include <gtest/gtest.h>

namespace mechane::state {
namespace {

const Vec3 kDown(0, -1, 0);

/// From a drum over a sheave down to a load: a crane.
struct Crane {
  Coupling rope;
  std::vector<Pose> X_WB = std::vector<Pose>(3);

  Crane() {
    rope.kind = CouplingKind::rope;
    rope.enabled = true;
    rope.drum = true;
    rope.diameter_m = 0.02;
    rope.body1 = BodyId(0);
    rope.node_count = 3;
    rope.nodes[0] = {BodyId(0), Vec3(0, 1, 0), Vec3::UnitZ(), 0.1, -1};
    rope.nodes[1] = {BodyId(1), Vec3(-2, 3, 0), Vec3::UnitZ(), 0.08, 1};
    rope.nodes[2] = {BodyId(2), Vec3(0, 0.4, 0), Vec3::UnitZ(), 0, 1};
    hang(1);
  }

  /// The load's height; the rope is as long as its way.
  void hang(double height_m) {
    X_WB[2].p = {-2.08, height_m, 0};
    std::array<Pose, kMaxRopeNodes> X_WN;
    for (std::size_t i = 0; i < 3; ++i)
      X_WN[i] = X_WB[i];
    rope.length_m = measure_rope(rope, X_WN, Quat::Identity()).length_m;
    if (rope.offset == 0) rope.offset = rope.length_m;
    rope.slack_m = 0;
  }
  [[nodiscard]] std::vector<Vec3> shape() const { return rope_shape(rope, X_WB, kDown); }
};

double length_of(const std::vector<Vec3>& line, std::size_t from) {
  double sum = 0;
  for (std::size_t i = from + 1; i < line.size(); ++i)
    sum += (line[i] - line[i - 1]).norm();
  return sum;
}

/// Index of the point where the line leaves the drum, whose axis is along z.
std::size_t off_drum(const std::vector<Vec3>& line, const Vec3& p_W) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    if ((line[i] - p_W).head<2>().norm() > 0.101) return i - 1;
  }
  return 0;
}

TEST(RopeShape, IsAsLongAsTheRopeAndEndsAtTheLoad) {
  const Crane crane;
  const std::vector<Vec3> line = crane.shape();
  EXPECT_LT((line.back() - Vec3(-2.08, 1.4, 0)).norm(), 1e-9);
  // Arcs are cut short by their chords.
  EXPECT_NEAR(length_of(line, off_drum(line, {0, 1, 0})), crane.rope.length_m, 0.005 * crane.rope.length_m);
}

TEST(RopeShape, KeepsItsCountAndMovesLittleWhileTheLoadRises) {
  Crane crane;
  std::vector<Vec3> before = crane.shape();
  for (double height_m = 1; height_m < 2.4; height_m += 0.01) {
    crane.hang(height_m);
    const std::vector<Vec3> now = crane.shape();
    ASSERT_EQ(now.size(), before.size());
    for (std::size_t i = 0; i < now.size(); ++i)
      ASSERT_LT((now[i] - before[i]).norm(), 0.03) << "point " << i << " at " << height_m;
    before = now;
  }
}

TEST(RopeShape, WhatComesOffTheLoadIsWoundOnTheDrum) {
  Crane crane;
  const std::vector<Vec3> low = crane.shape();
  crane.hang(2.2);  // 1.2 m: almost two turns of 0.628 m
  const std::vector<Vec3> high = crane.shape();
  const auto on_drum = [](const std::vector<Vec3>& line) {
    const std::size_t end = off_drum(line, {0, 1, 0});
    return length_of(line, 0) - length_of(line, end);
  };
  EXPECT_NEAR(on_drum(high) - on_drum(low), 1.2, 0.05);
  for (std::size_t i = 0; i < off_drum(high, {0, 1, 0}); ++i)
    EXPECT_NEAR((high[i] - Vec3(0, 1, high[i].z())).norm(), 0.1, 1e-9) << i;
}

TEST(RopeShape, SlackHangsInTheLongestPart) {
  Crane crane;
  const std::vector<Vec3> taut = crane.shape();
  crane.rope.slack_m = 0.05;
  const std::vector<Vec3> slack = crane.shape();
  const std::size_t from = off_drum(taut, {0, 1, 0});
  EXPECT_NEAR(length_of(slack, from) - length_of(taut, from), 0.05, 0.02);
  for (std::size_t i = 0; i < taut.size(); ++i)
    EXPECT_LE(slack[i].y(), taut[i].y() + 1e-12);
  EXPECT_LT((slack.back() - taut.back()).norm(), 1e-12);
}

TEST(RopeShape, TheEndOfACutRopeHangsDown) {
  Crane crane;
  const std::vector<Vec3> tied = crane.shape();
  crane.rope.enabled = false;
  crane.X_WB[2].p += Vec3(1, -0.5, 0);  // the load has gone
  const std::vector<Vec3> loose = crane.shape();
  ASSERT_EQ(loose.size(), tied.size());
  EXPECT_NEAR(loose.back().x(), -2.08, 0.1) << "below the sheave's rim";
  EXPECT_NEAR(loose.back().y(), 1.4, 0.1) << "where the load was";
}

TEST(RopeShape, ThroughBarePointsAndOverNothingItIsFinite) {
  Crane crane;
  crane.rope.drum = false;
  for (RopeNode& node : crane.rope.nodes)
    node.radius_m = 0;
  crane.X_WB[2].p = {0, 0.6, 0};  // the load's eye in the first node
  const std::vector<Vec3> line = crane.shape();
  ASSERT_FALSE(line.empty());
  for (const Vec3& p_W : line)
    EXPECT_TRUE(p_W.allFinite());
}

}  // namespace
}  // namespace mechane::state
