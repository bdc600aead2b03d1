#include "client-sdk/draw/passes/rope_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::draw {
namespace {

constexpr std::uint32_t kSides = 10;
/// The most that a rope's direction turns from one ring to the next.
constexpr float kTurn_rad = 0.2F;
/// How far before and after a point its corner is rounded, in radii.
constexpr float kRounded = 4;

struct TubeRing {
  Vec3f p_WR;
  Vec3f along_W;  ///< unit
};

std::vector<Vec3f> distinct(const picture::RenderRope& rope) {
  std::vector<Vec3f> out;
  for (const Vec3f& p : rope.points_W) {
    if (p.allFinite() && (out.empty() || (p - out.back()).norm() > 0.1F * rope.radius_m)) out.push_back(p);
  }
  return out;
}

/// Any unit vector perpendicular to `along_W`.
Vec3f across(const Vec3f& along) {
  return along.unitOrthogonal();
}

/// Rings around the corner at p. They lie on the parabola that touches both sides at `reach` from the corner, and turn
/// by equal angles. Where there is no room for a curve, as in a rope that doubles back, they turn about one point, so
/// that the tube keeps its thickness.
void add_corner(const Vec3f& p, const Vec3f& from, const Vec3f& to, float reach, std::vector<TubeRing>& rings) {
  const Vec3f turn = from.cross(to);
  const float angle = std::atan2(turn.norm(), from.dot(to));
  if (angle < 0.5F * kTurn_rad) {
    rings.push_back({p, (from + to).normalized()});
    return;
  }
  const Vec3f axis = turn.norm() > 1e-5F ? Vec3f(turn.normalized()) : across(from);
  const int steps = static_cast<int>(std::ceil(angle / kTurn_rad));
  for (int step = 0; step <= steps; ++step) {
    const float turned = angle * static_cast<float>(step) / static_cast<float>(steps);
    // The point of the parabola with the direction of `turned`: (1 - t) from + t to.
    const float t = step == 0       ? 0.0F
                    : step == steps ? 1.0F
                                    : std::sin(turned) / (std::sin(turned) + std::sin(angle - turned));
    const Vec3f place = p - (1 - t) * (1 - t) * reach * from + t * t * reach * to;
    rings.push_back({place, Eigen::AngleAxisf(turned, axis) * from});
  }
}

std::vector<TubeRing> rings_of(const std::vector<Vec3f>& points, float radius_m) {
  std::vector<TubeRing> rings;
  Vec3f before = (points[1] - points[0]).normalized();
  rings.push_back({points[0], before});
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3f next = points[i + 1] - points[i];
    const float room = 0.5F * std::min(next.norm(), (points[i] - points[i - 1]).norm());
    add_corner(points[i], before, next.normalized(), std::min(room, kRounded * radius_m), rings);
    before = next.normalized();
  }
  rings.push_back({points.back(), before});
  return rings;
}

/// A direction across the first ring that changes little while the rope's end swings. No such choice is continuous for
/// all directions: it jumps at one that ropes seldom have.
Vec3f first_side(const Vec3f& along) {
  const Vec3f reference = Vec3f(1, 0.29F, 0.73F).normalized();
  return Eigen::Quaternionf::FromTwoVectors(reference, along) * across(reference);
}

void add_end(const TubeRing& ring, std::uint32_t first_of_ring, bool last, picture::MeshData& into) {
  const auto middle = static_cast<std::uint32_t>(into.positions.size());
  const Vec3f n = last ? ring.along_W : Vec3f(-ring.along_W);
  const auto add = [&](const Vec3f& p, const Eigen::Vector2f& uv) {
    into.positions.push_back(p);
    into.normals.push_back(n);
    into.tangents.emplace_back(ring.along_W.x(), ring.along_W.y(), ring.along_W.z(), 1.0F);
    into.uv.push_back(uv);
  };
  add(ring.p_WR, {0, 0});
  for (std::uint32_t side = 0; side <= kSides; ++side)
    add(Vec3f(into.positions[first_of_ring + side]), Eigen::Vector2f(into.uv[first_of_ring + side]));
  for (std::uint32_t side = 1; side <= kSides; ++side) {
    const std::uint32_t a = middle + side;
    into.indices.insert(into.indices.end(), {middle, last ? a : a + 1, last ? a + 1 : a});
  }
}

}  // namespace

void append_rope(const picture::RenderRope& rope, picture::MeshData& into) {
  if (!(rope.radius_m > 0)) return;
  const std::vector<Vec3f> points = distinct(rope);
  if (points.size() < 2) return;
  const std::vector<TubeRing> rings = rings_of(points, rope.radius_m);
  const auto first = static_cast<std::uint32_t>(into.positions.size());
  Vec3f side_W = first_side(rings[0].along_W);
  float length_m = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const TubeRing& ring = rings[i];
    if (i > 0) {
      length_m += (ring.p_WR - rings[i - 1].p_WR).norm();
      side_W = Eigen::Quaternionf::FromTwoVectors(rings[i - 1].along_W, ring.along_W) * side_W;
    }
    side_W = (side_W - ring.along_W * ring.along_W.dot(side_W)).normalized();
    const Vec3f up_W = ring.along_W.cross(side_W);
    for (std::uint32_t side = 0; side <= kSides; ++side) {
      const float share = static_cast<float>(side) / kSides;
      const float a = kTwoPiF * share;
      const Vec3f n = std::cos(a) * side_W + std::sin(a) * up_W;
      into.positions.push_back(ring.p_WR + rope.radius_m * n);
      into.normals.push_back(n);
      into.tangents.emplace_back(ring.along_W.x(), ring.along_W.y(), ring.along_W.z(), 1.0F);
      into.uv.emplace_back(share, length_m / rope.radius_m);
    }
  }
  const auto count = static_cast<std::uint32_t>(rings.size());
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t a = first + i * (kSides + 1) + side;
      const std::uint32_t d = a + kSides + 1;
      into.indices.insert(into.indices.end(), {a, a + 1, d + 1, a, d + 1, d});
    }
  }
  add_end(rings.front(), first, false, into);
  add_end(rings.back(), first + (count - 1) * (kSides + 1), true, into);
}

}  // namespace mechane::draw
