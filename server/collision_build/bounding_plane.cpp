#include "server/collision_build/bounding_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mechane::collision_build {
namespace {

using Plane = collision::DistanceField::Plane;

constexpr double kHalfDiagonal = 0.8661;  // of a block, rounded up
constexpr double kRounding = 1e-3;        // of a block: more than a kernel's float32 can be wrong by
constexpr std::size_t kFewFacets = 8;     // that are not divided further
constexpr int kLooks = 3;                 // places of the block from which a triangle is looked at
constexpr int kLeans = 4;                 // directions that are tried between the plane's own and another
constexpr auto kValueStep = static_cast<double>(collision::kFieldValueStep);
constexpr auto kSlopeStep = static_cast<double>(collision::kFieldSlopeStep);

Vec3 slope_of(const Plane& plane) {
  return kSlopeStep * Vec3(plane.slope[0], plane.slope[1], plane.slope[2]);
}

Vec3 closest_on_edge(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  if (square <= 0) return from;
  return from + std::clamp(along.dot(p - from) / square, 0.0, 1.0) * along;
}

}  // namespace

BoundingPlanes::BoundingPlanes(const geometry::Mesh& mesh_B) {
  facets_.reserve(mesh_B.triangles.size());
  for (const auto& corners : mesh_B.triangles) {
    Facet f;
    f.a = mesh_B.vertices[corners[0]];
    f.b = mesh_B.vertices[corners[1]];
    f.c = mesh_B.vertices[corners[2]];
    const Vec3 normal = (f.b - f.a).cross(f.c - f.a);
    f.n = normal.norm() > 0 ? Vec3(normal.normalized()) : Vec3::Zero();
    f.middle = (f.a + f.b + f.c) / 3;
    f.radius = std::sqrt(
        std::max({(f.a - f.middle).squaredNorm(), (f.b - f.middle).squaredNorm(), (f.c - f.middle).squaredNorm()}));
    facets_.push_back(f);
  }
  if (!facets_.empty()) grow(0, facets_.size());
}

void BoundingPlanes::grow(std::size_t begin, std::size_t end) {
  const std::size_t at = tree_.size();
  Branch branch{{}, begin, end, 0};
  Eigen::AlignedBox3d middles;
  for (std::size_t i = begin; i < end; ++i) {
    for (const Vec3& corner : {facets_[i].a, facets_[i].b, facets_[i].c})
      branch.box.extend(corner);
    middles.extend(facets_[i].middle);
  }
  tree_.push_back(branch);
  if (end - begin <= kFewFacets) return;
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::size_t half = begin + (end - begin) / 2;
  const auto from = [&](std::size_t i) { return facets_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(from(begin), from(half), from(end),
                   [&](const Facet& l, const Facet& r) { return l.middle[axis] < r.middle[axis]; });
  grow(begin, half);
  tree_[at].second = tree_.size();
  grow(half, end);
}

/// How high the plane may lie for one triangle: the best of several directions u. Stops once it is `enough`.
double BoundingPlanes::least(const Facet& facet, const Vec3& middle, const Vec3& g, double enough) {
  const std::array<Vec3, 3> corners = {facet.a - middle, facet.b - middle, facet.c - middle};
  double best = -std::numeric_limits<double>::infinity();
  const auto try_direction = [&](const Vec3& u) {
    const double farthest = std::max({u.dot(corners[0]), u.dot(corners[1]), u.dot(corners[2])});
    best = std::max(best, -0.5 * (u - g).cwiseAbs().sum() - farthest);
    return best >= enough;
  };
  const Vec3 own = g / std::max(1.0, g.norm());
  // What the plane's own direction cannot prove, one that leans towards the triangle may.
  const auto try_leaning = [&](const Vec3& towards) {
    for (int step = kLeans; step > 0; --step) {
      const Vec3 u = own + static_cast<double>(step) / kLeans * (towards - own);
      if (try_direction(u / std::max(u.norm(), 1e-9))) return true;
    }
    return false;
  };
  if (try_direction(own)) return best;
  if (facet.n.squaredNorm() > 0 && (try_leaning(facet.n) || try_leaning(-facet.n))) return best;
  Vec3 from = Vec3::Zero();
  for (int turn = 0; turn < kLooks; ++turn) {
    Vec3 nearest = Vec3::UnitZ();
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 away = from - closest_on_edge(from, corners[i], corners[(i + 1) % 3]);
      const double length = away.norm();
      if (length <= 1e-12 || length >= distance) continue;
      distance = length;
      nearest = away / length;
    }
    if (try_leaning(nearest)) return best;
    // The corner of the block that binds for this direction.
    for (int axis = 0; axis < 3; ++axis)
      from[axis] = nearest[axis] > g[axis] ? -0.5 : 0.5;
  }
  return best;
}

Plane BoundingPlanes::make(const Vec3& middle, const Vec3& slope, double distance) const {
  Plane plane;
  const Vec3 wish = slope.norm() > 1 ? Vec3(slope.normalized()) : slope;
  for (std::size_t i = 0; i < 3; ++i)
    plane.slope[i] = static_cast<int>(std::lround(wish[static_cast<Eigen::Index>(i)] / kSlopeStep));
  const Vec3 g = slope_of(plane);
  const double rise = 0.5 * g.cwiseAbs().sum();
  double v = distance;  // the nearest triangle allows no more
  // What is farther away than the plane is high anywhere in the block does not matter.
  const auto is_far = [&](double square) {
    const double far = v + rise + kHalfDiagonal;
    return far <= 0 || square >= far * far;
  };
  std::vector<std::size_t> open;
  if (!tree_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::size_t at = open.back();
    const Branch& branch = tree_[at];
    open.pop_back();
    if (is_far(branch.box.squaredExteriorDistance(middle))) continue;
    if (branch.second != 0) {
      open.insert(open.end(), {branch.second, at + 1});
      continue;
    }
    for (std::size_t i = branch.begin; i < branch.end; ++i) {
      const double away = std::max((facets_[i].middle - middle).norm() - facets_[i].radius, 0.0);
      if (!is_far(away * away)) v = std::min(v, least(facets_[i], middle, g, v));
    }
  }
  plane.value = static_cast<int>(std::clamp(std::floor((v - kRounding) / kValueStep),
                                            -static_cast<double>(collision::DistanceField::kMaxValue),
                                            static_cast<double>(collision::DistanceField::kMaxValue)));
  return plane;
}

Vec3 BoundingPlanes::highest(const Plane& plane) {
  Vec3 p_B;
  for (std::size_t i = 0; i < 3; ++i)
    p_B[static_cast<Eigen::Index>(i)] = plane.slope[i] > 0 ? 1 : 0;
  return p_B;
}

Plane BoundingPlanes::sunk(Plane plane) {
  const double rise = 0.5 * slope_of(plane).cwiseAbs().sum();
  plane.value = static_cast<int>(std::floor((-rise - kRounding) / kValueStep));
  return plane;
}

}  // namespace mechane::collision_build
