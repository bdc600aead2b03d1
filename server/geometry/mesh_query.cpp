#include "server/geometry/mesh_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/base/assert.hpp"

namespace mechane::geometry {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
// A node this many times its radius away is seen as a point.
constexpr double kFar = 2;
constexpr std::size_t kStackDepth = 96;  // a median split of 2^32 triangles is 30 levels deep, two entries a level

/// Ericson, Real-Time Collision Detection, 5.1.5: the region of the triangle decides which feature is closest.
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 > d3 ? d1 / (d1 - d3) : 0.0);
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 > d6 ? d2 / (d2 - d6) : 0.0);
  const double va = d3 * d6 - d5 * d4;
  const double e = d4 - d3;
  const double f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0) return b + (c - b) * (e + f > 0 ? e / (e + f) : 0.0);
  const double sum = va + vb + vc;
  if (sum <= 0) return a;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

/// From p = 0; positive where the triangle shows its inner side (Van Oosterom & Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double across = a.dot(b.cross(c));
  const double along = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return across == 0 && along == 0 ? 0 : 2 * std::atan2(across, along);
}

}  // namespace

MeshQuery::MeshQuery(const Mesh& mesh, Inside inside) : slot_of_(mesh.triangles.size()) {
  triangles_.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    triangles_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], i});
  }
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(triangles_.size())});
  // Children are appended, so this loop reaches them too.
  for (std::uint32_t n = 0; n < nodes_.size(); ++n)
    split(n);
  for (std::uint32_t slot = 0; slot < triangles_.size(); ++slot)
    slot_of_[triangles_[slot].index] = slot;
  add_quads();
  if (inside == Inside::by_winding_number) add_moments();
}

void MeshQuery::Moments::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 area_normal = 0.5 * (b - a).cross(c - a);
  const Vec3 middle = (a + b + c) / 3;
  const Vec3 d = middle - center;
  Mat3 square = d * d.transpose();
  for (const Vec3& corner : {a, b, c})
    square += (corner - middle) * (corner - middle).transpose() / 12;
  dipole += area_normal;
  spread += d * area_normal.transpose();
  for (std::size_t k = 0; k < 3; ++k)
    bend[k] += area_normal[static_cast<Eigen::Index>(k)] * square;
}

void MeshQuery::Moments::add(const Moments& child) {
  const Vec3 d = child.center - center;
  dipole += child.dipole;
  spread += child.spread + d * child.dipole.transpose();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const Mat3 across = child.spread.col(axis) * d.transpose();
    bend[k] += child.bend[k] + across + across.transpose() + child.dipole[axis] * d * d.transpose();
  }
}

/// The first three terms of the series of r / |r|^3 about the center.
double MeshQuery::Moments::solid_angle(const Vec3& r) const {
  const double square = r.squaredNorm();
  double traces = 0;  // of the third derivative's parts with a Kronecker delta
  double cubic = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const Vec3 bent = bend[k] * r;
    traces += 2 * bent[axis] + bend[k].trace() * r[axis];
    cubic += bent.dot(r) * r[axis];
  }
  const double first = dipole.dot(r);
  const double second = spread.trace() - 3 * r.dot(spread * r) / square;
  const double third = 1.5 * (5 * cubic / square - traces) / square;
  return (first + second + third) / (square * std::sqrt(square));
}

MeshQuery::Moments MeshQuery::moments_of_leaf(const Node& leaf) const {
  Moments m;
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const Triangle& t = triangles_[i];
    const double area = 0.5 * (t.b - t.a).cross(t.c - t.a).norm();
    m.area += area;
    m.center += area / 3 * (t.a + t.b + t.c);
  }
  m.center = m.area > 0 ? Vec3(m.center / m.area) : leaf.box.center();
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
    m.add_triangle(triangles_[i].a, triangles_[i].b, triangles_[i].c);
  return m;
}

MeshQuery::Moments MeshQuery::moments_of_children(const Node& node) const {
  const Moments& a = moments_[node.first];
  const Moments& b = moments_[node.first + 1];
  Moments m;
  m.area = a.area + b.area;
  m.center = m.area > 0 ? Vec3((a.area * a.center + b.area * b.center) / m.area) : node.box.center();
  m.add(a);
  m.add(b);
  return m;
}

void MeshQuery::add_moments() {
  moments_.resize(nodes_.size());
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children stand behind their parents
    const Node& node = nodes_[n];
    moments_[n] = node.count > 0 ? moments_of_leaf(node) : moments_of_children(node);
    const Vec3 reach = (node.box.max() - moments_[n].center).cwiseMax(moments_[n].center - node.box.min());
    moments_[n].radius = reach.norm();
  }
}

void MeshQuery::split(std::uint32_t n) {
  const std::uint32_t first = nodes_[n].first;
  const std::uint32_t count = nodes_[n].count;
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centers;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i];
    box.extend(t.a).extend(t.b).extend(t.c);
    centers.extend(Vec3(t.a + t.b + t.c));
  }
  nodes_[n].box = box;
  if (count <= kLeafTriangles) return;
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const auto begin = triangles_.begin() + first;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [axis](const Triangle& l, const Triangle& r) {
    const double cl = l.a[axis] + l.b[axis] + l.c[axis];
    const double cr = r.a[axis] + r.b[axis] + r.c[axis];
    return cl < cr || (cl == cr && l.index < r.index);
  });
  const auto children = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, half});
  nodes_.push_back({{}, first + half, count - half});
  nodes_[n].first = children;
  nodes_[n].count = 0;
}

void MeshQuery::add_quads() {
  reach_ = std::max(nodes_[0].box.min().cwiseAbs().maxCoeff(), nodes_[0].box.max().cwiseAbs().maxCoeff());
  quads_.reserve(nodes_.size());
  quads_.emplace_back();
  // Children are appended, so this loop reaches them too.
  for (std::size_t q = 0; q < quads_.size(); ++q) {
    Quad quad;
    quad.node = quads_[q].node;
    const Node& node = nodes_[quad.node];
    quad.is_leaf = node.count > 0;
    const auto put = [&](const Eigen::AlignedBox3d& box, std::uint32_t child) {
      quad.boxes.set(quad.count, box);
      quad.child[quad.count++] = child;
    };
    const auto put_node = [&](std::uint32_t n) {
      put(nodes_[n].box, static_cast<std::uint32_t>(quads_.size()));
      quads_.emplace_back().node = n;
    };
    const auto put_under = [&](std::uint32_t n) {
      if (nodes_[n].count > 0) return put_node(n);
      put_node(nodes_[n].first);
      put_node(nodes_[n].first + 1);
    };
    for (std::uint32_t slot = node.first; quad.is_leaf && slot < node.first + node.count; ++slot) {
      const Triangle& t = triangles_[slot];
      put(Eigen::AlignedBox3d(t.a).extend(t.b).extend(t.c), slot);
    }
    if (!quad.is_leaf) {
      put_under(node.first);
      put_under(node.first + 1);
    }
    for (Eigen::Index lane = quad.count; lane < 4; ++lane)
      quad.boxes.set(lane, node.box);
    quads_[q] = quad;
  }
}

SurfacePoint MeshQuery::closest(const Vec3& p, double max_distance_m) const {
  return closest_within(p, max_distance_m * max_distance_m);
}

SurfacePoint MeshQuery::closest(const Vec3& p, const SurfacePoint& near) const {
  if (std::isinf(near.distance_m)) return closest(p);
  constexpr double kRoom = 1 + 1e-9;  // ties are decided as they are without a limit
  const Triangle& t = triangles_[slot_of_[near.triangle]];
  return closest_within(p, kRoom * (closest_on_triangle(p, t.a, t.b, t.c) - p).squaredNorm());
}

bool MeshQuery::comes_before(std::uint32_t slot, std::uint32_t other, const Vec3& p) const {
  std::uint32_t n = 0;
  std::uint32_t first = 0;
  auto count = static_cast<std::uint32_t>(triangles_.size());
  while (nodes_[n].count == 0) {
    const std::uint32_t half = count / 2;  // as split() does it
    const bool in_first = slot < first + half;
    const std::uint32_t child = nodes_[n].first;
    if (in_first != (other < first + half)) {
      const bool first_is_nearer =
          nodes_[child].box.squaredExteriorDistance(p) < nodes_[child + 1].box.squaredExteriorDistance(p);
      return in_first == first_is_nearer;
    }
    n = in_first ? child : child + 1;
    first += in_first ? 0 : half;
    count = in_first ? half : count - half;
  }
  return slot < other;
}

SurfacePoint MeshQuery::closest_within(const Vec3& p, double best_square) const {
  SurfacePoint best;
  if (nodes_.empty()) return best;
  const QuadPlace place(p, reach_);
  struct Open {
    std::uint32_t quad = 0;
    float square = 0;  // of the distance to its box, or less
  };
  std::array<Open, kStackDepth> stack;
  std::size_t top = 0;
  stack[top++] = {};
  std::uint32_t best_slot = 0;
  const auto limit = [&] { return static_cast<float>(best_square) * (1 + 2 * QuadPlace::kSlack); };
  while (top > 0) {
    const Open open = stack[--top];
    if (open.square > limit()) continue;
    const Quad& quad = quads_[open.quad];
    const Eigen::Array4f squares = place.squares(quad.boxes);
    const std::size_t bottom = top;
    for (std::uint8_t lane = 0; lane < quad.count; ++lane) {
      if (squares[lane] > limit()) continue;
      if (!quad.is_leaf) {  // the nearest on top
        std::size_t at = top++;
        for (; at > bottom && stack[at - 1].square < squares[lane]; --at)
          stack[at] = stack[at - 1];
        stack[at] = {quad.child[lane], squares[lane]};
        continue;
      }
      const std::uint32_t slot = quad.child[lane];
      const Triangle& t = triangles_[slot];
      const Vec3 q = closest_on_triangle(p, t.a, t.b, t.c);
      const double square = (q - p).squaredNorm();
      if (square > best_square) continue;
      if (square == best_square && !std::isinf(best.distance_m) && !comes_before(slot, best_slot, p)) continue;
      best_square = square;
      best_slot = slot;
      best = {q, std::sqrt(square), t.index};
    }
  }
  return best;
}

template <class Found>
void MeshQuery::cast_each(const Vec3& origin, const Vec3& direction, const Found& found) const {
  if (nodes_.empty()) return;
  const QuadRay ray(origin, direction, reach_);
  const double square = direction.squaredNorm();
  std::array<std::uint32_t, kStackDepth> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  Eigen::Array4f enters;
  Eigen::Array4f leaves;
  while (top > 0) {
    const Quad& quad = quads_[stack[--top]];
    ray.spans(quad.boxes, enters, leaves);
    if (!quad.is_leaf) {
      for (std::size_t lane = 0; lane < 4; ++lane) {  // without branches, which could not be foreseen
        stack[top] = quad.child[lane];
        top += lane < quad.count && enters[static_cast<Eigen::Index>(lane)] <= leaves[static_cast<Eigen::Index>(lane)];
      }
      continue;
    }
    for (std::size_t lane = 0; lane < quad.count; ++lane) {
      if (enters[static_cast<Eigen::Index>(lane)] > leaves[static_cast<Eigen::Index>(lane)]) continue;
      const Triangle& tri = triangles_[quad.child[lane]];
      // Signed volumes: an edge shared by two triangles gives both the same number, so no ray slips between them.
      const Vec3 a = tri.a - origin;
      const Vec3 b = tri.b - origin;
      const Vec3 c = tri.c - origin;
      const double u = direction.dot(c.cross(b));
      const double v = direction.dot(a.cross(c));
      const double w = direction.dot(b.cross(a));
      if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
      const double sum = u + v + w;
      if (sum == 0) continue;
      const double t = (u * a + v * b + w * c).dot(direction) / (sum * square);
      if (t > 0) found(RayHit{t, tri.index, sum > 0});
    }
  }
}

void MeshQuery::cast(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const {
  hits.clear();
  cast_each(origin, direction, [&](const RayHit& hit) { hits.push_back(hit); });
  std::sort(hits.begin(), hits.end(),
            [](const RayHit& l, const RayHit& r) { return l.t < r.t || (l.t == r.t && l.triangle < r.triangle); });
}

int MeshQuery::winding(const Vec3& p) const {
  // Directions along no axis and no likely edge; three, so that one ray through an edge is outvoted.
  static const std::array<Vec3, 3> kDirections = {Vec3(0.5773, 0.6113, 0.5412), Vec3(-0.7071, 0.3019, 0.6397),
                                                  Vec3(0.1327, -0.8913, 0.4336)};
  const auto count = [&](const Vec3& direction) {
    int crossings = 0;
    cast_each(p, direction, [&](const RayHit& hit) { crossings += hit.entering ? -1 : 1; });
    return crossings;
  };
  const int first = count(kDirections[0]);
  const int second = count(kDirections[1]);
  if (first == second) return first;
  return std::clamp(count(kDirections[2]), std::min(first, second), std::max(first, second));
}

double MeshQuery::winding_number(const Vec3& p) const {
  MECHANE_ASSERT(nodes_.empty() || !moments_.empty());
  if (nodes_.empty()) return 0;
  double angle = 0;
  std::array<std::uint32_t, kStackDepth> stack{};
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const std::uint32_t n = stack[--top];
    const Node& node = nodes_[n];
    const Moments& m = moments_[n];
    const Vec3 r = m.center - p;
    if (r.squaredNorm() > kFar * kFar * m.radius * m.radius) {
      angle += m.solid_angle(r);
    } else if (node.count == 0) {
      stack[top++] = node.first + 1;
      stack[top++] = node.first;
    } else {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        angle += solid_angle(triangles_[i].a - p, triangles_[i].b - p, triangles_[i].c - p);
    }
  }
  return angle / (4 * kPi);
}

bool MeshQuery::contains(const Vec3& p) const {
  return moments_.empty() ? winding(p) > 0 : winding_number(p) > 0.5;
}

double MeshQuery::signed_distance(const Vec3& p) const {
  const double distance = closest(p).distance_m;
  return contains(p) ? -distance : distance;
}

Vec3 MeshQuery::triangle_normal(std::uint32_t triangle) const {
  const Triangle& t = triangles_[slot_of_[triangle]];
  return (t.b - t.a).cross(t.c - t.a).normalized();
}

}  // namespace mechane::geometry
