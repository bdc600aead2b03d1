#include "client-sdk/draw/passes/rope_mesh.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::draw {
namespace {

constexpr std::size_t kAround = 11;  // vertices of a ring, the seam's twice

float coordinate() {
  return static_cast<float>(*rc::gen::inRange(-1000, 1000)) / 1000.0F;
}

struct RopeRing {
  Vec3f middle = Vec3f::Zero();
  Vec3f along = Vec3f::Zero();
  std::vector<Vec3f> spokes;  ///< from the middle to the vertices
};

std::vector<RopeRing> rings_in(const picture::MeshData& mesh) {
  std::vector<RopeRing> rings;
  const std::size_t ends = 2 * (kAround + 1);
  for (std::size_t first = 0; first + kAround + ends <= mesh.positions.size(); first += kAround) {
    RopeRing ring;
    for (std::size_t k = 0; k + 1 < kAround; ++k)
      ring.middle += mesh.positions[first + k] / static_cast<float>(kAround - 1);
    for (std::size_t k = 0; k < kAround; ++k)
      ring.spokes.push_back(mesh.positions[first + k] - ring.middle);
    ring.along = mesh.tangents[first].head<3>();
    rings.push_back(ring);
  }
  return rings;
}

RC_GTEST_PROP(RopeMesh, keeps_its_thickness_and_does_not_twist_however_it_bends, ()) {
  picture::RenderRope rope;
  rope.radius_m = 0.02F;
  const int count = *rc::gen::inRange(2, 40);
  for (int i = 0; i < count; ++i) {
    const Vec3f p(coordinate(), coordinate(), coordinate());
    // Points that repeat, as where a rope lies coiled up on its drum.
    const int times = *rc::gen::inRange(1, 3);
    for (int k = 0; k < times; ++k)
      rope.points_W.push_back(p);
    // And a rope that doubles back on itself.
    if (i > 1 && *rc::gen::inRange(0, 5) == 0) rope.points_W.push_back(rope.points_W[rope.points_W.size() - 1 - 2]);
  }
  picture::MeshData mesh;
  append_rope(rope, mesh);
  for (const Vec3f& p : mesh.positions)
    RC_ASSERT(p.allFinite());
  for (const Vec3f& n : mesh.normals)
    RC_ASSERT(std::abs(n.norm() - 1) < 1e-3F);
  const std::vector<RopeRing> rings = rings_in(mesh);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (const Vec3f& spoke : rings[i].spokes) {
      RC_ASSERT(std::abs(spoke.norm() - rope.radius_m) < 1e-5F);
      RC_ASSERT(std::abs(spoke.dot(rings[i].along)) < 1e-5F);
    }
    if (i == 0) continue;
    // The least turn that takes one ring's direction to the next takes its spokes to the next, too.
    const auto turn = Eigen::Quaternionf::FromTwoVectors(rings[i - 1].along, rings[i].along);
    RC_ASSERT(rings[i - 1].along.dot(rings[i].along) > std::cos(0.25F));
    for (std::size_t k = 0; k < kAround; ++k)
      RC_ASSERT((turn * rings[i - 1].spokes[k] - rings[i].spokes[k]).norm() < 0.02F * rope.radius_m);
  }
}

RC_GTEST_PROP(RopeMesh, passes_by_each_point_within_a_radius_or_two, ()) {
  picture::RenderRope rope;
  rope.radius_m = 0.01F;
  const int count = *rc::gen::inRange(2, 20);
  for (int i = 0; i < count; ++i)
    rope.points_W.emplace_back(coordinate(), coordinate(), coordinate());
  RC_PRE((rope.points_W.front() - rope.points_W[1]).norm() > rope.radius_m);
  picture::MeshData mesh;
  append_rope(rope, mesh);
  const std::vector<RopeRing> rings = rings_in(mesh);
  for (const Vec3f& p : rope.points_W) {
    float nearest = 1e9F;
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      const Vec3f way = rings[i + 1].middle - rings[i].middle;
      const float share = way.norm() > 0 ? (p - rings[i].middle).dot(way) / way.squaredNorm() : 0;
      nearest = std::min(nearest, (rings[i].middle + std::clamp(share, 0.0F, 1.0F) * way - p).norm());
    }
    RC_ASSERT(nearest < 2.1F * rope.radius_m);
  }
}

TEST(RopeMesh, draws_nothing_where_there_is_no_rope) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Vec3f p(1, 2, 3);
  for (const picture::RenderRope& rope :
       {picture::RenderRope{}, picture::RenderRope{{p}, 0.01F}, picture::RenderRope{{p, p, p}, 0.01F},
        picture::RenderRope{{p, Vec3f(nan, 0, 0)}, 0.01F}, picture::RenderRope{{p, Vec3f(0, 0, 0)}, 0},
        picture::RenderRope{{p, Vec3f(0, 0, 0)}, nan}}) {
    picture::MeshData mesh;
    append_rope(rope, mesh);
    EXPECT_TRUE(mesh.positions.empty());
    EXPECT_TRUE(mesh.indices.empty());
  }
}

TEST(RopeMesh, is_closed_and_looks_outwards) {
  picture::MeshData mesh;
  append_rope({{Vec3f(0, 0, 0), Vec3f(0.5F, 0, 0), Vec3f(0.5F, 0.5F, 0)}, 0.05F}, mesh);
  double volume = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3f& a = mesh.positions[mesh.indices[i]];
    const Vec3f& b = mesh.positions[mesh.indices[i + 1]];
    const Vec3f& c = mesh.positions[mesh.indices[i + 2]];
    volume += static_cast<double>(a.dot(b.cross(c))) / 6;
    const Vec3f n = (b - a).cross(c - a);
    EXPECT_GT(n.dot(mesh.normals[mesh.indices[i]]), -1e-6F);
  }
  // Ten sides have 0.935 of the circle's area; the corner is cut.
  const double straight = 1.0 * kPi * 0.05 * 0.05 * 0.935;
  EXPECT_GT(volume, 0.80 * straight);
  EXPECT_LT(volume, 1.01 * straight);
}

}  // namespace
}  // namespace mechane::draw
