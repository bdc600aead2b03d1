#include "server/geometry/pieces/piece_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "server/base/random.hpp"

namespace mechane::geometry {
namespace {

constexpr double kOnPlane_m = 1e-9;

Vec3 twice_area(const std::array<Vec3, 3>& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]);
}

void append_fan(const std::vector<Vec3>& polygon, std::vector<std::array<Vec3, 3>>& triangles) {
  for (std::size_t i = 2; i < polygon.size(); ++i)
    triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
}

}  // namespace

PieceSurface::PieceSurface(const Mesh& mesh) : mesh_(&mesh), whole_(mesh.triangles.size()) {
  std::iota(whole_.begin(), whole_.end(), 0U);
}

PieceSurface::Triangle PieceSurface::triangle(std::size_t i) const {
  if (i >= whole_.size()) return cut_[i - whole_.size()];
  const auto& t = mesh_->triangles[whole_[i]];
  return {mesh_->vertices[t[0]], mesh_->vertices[t[1]], mesh_->vertices[t[2]]};
}

std::pair<PieceSurface, PieceSurface> PieceSurface::split(const HalfSpace& plane) const {
  std::pair<PieceSurface, PieceSurface> sides{*this, *this};
  for (PieceSurface* side : {&sides.first, &sides.second}) {
    side->whole_.clear();
    side->cut_.clear();
  }
  std::vector<Vec3> polygon;
  std::vector<Vec3> scratch;
  for (std::size_t i = 0; i < whole_.size() + cut_.size(); ++i) {
    const Triangle t = triangle(i);
    const Vec3 e(plane.excess(t[0]), plane.excess(t[1]), plane.excess(t[2]));
    const bool within = e.maxCoeff() <= kOnPlane_m;
    const bool beyond = e.minCoeff() >= -kOnPlane_m;
    if (within || beyond) {
      const bool first = within && beyond ? twice_area(t).dot(plane.n) > 0 : within;
      PieceSurface& side = first ? sides.first : sides.second;
      if (i < whole_.size()) {
        side.whole_.push_back(whole_[i]);
      } else {
        side.cut_.push_back(t);
      }
      continue;
    }
    polygon.assign(t.begin(), t.end());
    clip_polygon(polygon, plane, scratch);
    append_fan(polygon, sides.first.cut_);
    polygon.assign(t.begin(), t.end());
    clip_polygon(polygon, plane.flipped(), scratch);
    append_fan(polygon, sides.second.cut_);
  }
  return sides;
}

PieceSurface PieceSurface::joined(const PieceSurface& a, const PieceSurface& b) {
  PieceSurface both = a;
  both.whole_.insert(both.whole_.end(), b.whole_.begin(), b.whole_.end());
  both.cut_.insert(both.cut_.end(), b.cut_.begin(), b.cut_.end());
  return both;
}

double PieceSurface::area_m2() const {
  double area = 0;
  for (std::size_t i = 0; i < whole_.size() + cut_.size(); ++i)
    area += 0.5 * twice_area(triangle(i)).norm();
  return area;
}

std::vector<OrientedPoint> PieceSurface::sample(std::size_t count, std::uint64_t seed) const {
  // Stratified along the running area, as sample_by_area does with a whole mesh.
  std::vector<OrientedPoint> points;
  const double area = area_m2();
  if (!(area > 0)) return points;
  points.reserve(count);
  Random random(seed);
  double running = 0;
  const std::size_t triangles = whole_.size() + cut_.size();
  double next = area * random.unit() / static_cast<double>(count);
  for (std::size_t i = 0; i < triangles; ++i) {
    const Triangle t = triangle(i);
    const Vec3 normal = twice_area(t);
    running += 0.5 * normal.norm();
    while (points.size() < count && next < running) {
      const double root = std::sqrt(random.unit());
      const double v = random.unit();
      points.push_back({(1 - root) * t[0] + root * (1 - v) * t[1] + root * v * t[2], normal.normalized()});
      next = area * (static_cast<double>(points.size()) + random.unit()) / static_cast<double>(count);
    }
  }
  return points;
}

std::vector<OrientedPoint> PieceSurface::corners(std::size_t count) const {
  std::vector<OrientedPoint> points;
  const std::size_t triangles = whole_.size() + cut_.size();
  const std::size_t stride = std::max<std::size_t>(1, triangles / std::max<std::size_t>(count, 1));
  for (std::size_t i = 0; i < triangles && points.size() < count; i += stride) {
    const Triangle t = triangle(i);
    const Vec3 normal = twice_area(t);
    if (normal.norm() > 0) points.push_back({t[i / stride % 3], normal.normalized()});
  }
  return points;
}

double PieceSurface::reach(const Vec3& n) const {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < whole_.size() + cut_.size(); ++i) {
    for (const Vec3& p : triangle(i))
      most = std::max(most, n.dot(p));
  }
  return most;
}

}  // namespace mechane::geometry
