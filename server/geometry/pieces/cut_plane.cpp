#include "server/geometry/pieces/cut_plane.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::geometry {
namespace {

/// The same plane, looked at from either side.
bool same_plane(const HalfSpace& a, const HalfSpace& b, double size_m) {
  const double sign = a.n.dot(b.n) < 0 ? -1 : 1;
  return (a.n - sign * b.n).norm() < 1e-9 && std::abs(a.d - sign * b.d) < 1e-9 * size_m;
}

}  // namespace

double polygon_area_m2(const std::vector<Vec3>& polygon) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return 0.5 * twice.norm();
}

bool cell_contains(std::span<const HalfSpace> cell, const Vec3& p, double slack_m) {
  return std::all_of(cell.begin(), cell.end(), [&](const HalfSpace& h) { return h.excess(p) <= slack_m; });
}

void clip_polygon(std::vector<Vec3>& polygon, const HalfSpace& half_space, std::vector<Vec3>& scratch) {
  // Sutherland and Hodgman 1974.
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double ea = half_space.excess(a);
    const double eb = half_space.excess(b);
    if (ea <= 0) scratch.push_back(a);
    if ((ea < 0 && eb > 0) || (ea > 0 && eb < 0)) scratch.push_back(a + (b - a) * (ea / (ea - eb)));
  }
  polygon.swap(scratch);
  if (polygon.size() < 3) polygon.clear();
}

std::vector<Vec3> plane_section(const HalfSpace& plane, std::span<const HalfSpace> cell,
                                const Eigen::AlignedBox3d& box) {
  const double size = box.diagonal().norm();
  const Vec3 center = box.center() - plane.excess(box.center()) * plane.n;
  const Vec3 u = plane.n.unitOrthogonal();
  const Vec3 v = plane.n.cross(u);
  std::vector<Vec3> polygon;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    polygon.push_back(center + size * (x * u + y * v));
  std::vector<Vec3> scratch;
  for (int axis = 0; axis < 3; ++axis) {
    clip_polygon(polygon, {Vec3::Unit(axis), box.max()[axis]}, scratch);
    clip_polygon(polygon, {-Vec3::Unit(axis), -box.min()[axis]}, scratch);
  }
  for (const HalfSpace& h : cell) {
    if (!same_plane(h, plane, size)) clip_polygon(polygon, h, scratch);
  }
  return polygon;
}

std::vector<Vec3> lattice_on(const std::vector<Vec3>& polygon, const Vec3& n, double spacing_m, std::size_t most) {
  std::vector<Vec3> points;
  const double area = polygon_area_m2(polygon);
  if (polygon.size() < 3 || !(area > 0)) return points;
  const double spacing = std::max(spacing_m, std::sqrt(area / static_cast<double>(std::max<std::size_t>(most, 1))));
  const Vec3 u = n.unitOrthogonal();
  const Vec3 v = n.cross(u);
  Eigen::AlignedBox2d bounds;
  for (const Vec3& p : polygon)
    bounds.extend(Eigen::Vector2d(u.dot(p), v.dot(p)));
  const double height = n.dot(polygon.front());
  // The direction in which the polygon runs about n.
  Vec3 turn = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    turn += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  const double way = turn.dot(n) < 0 ? -1 : 1;
  const auto steps = [&](double length) { return static_cast<int>(std::ceil(length / spacing - 0.5)); };
  for (int row = 0; row < steps(bounds.sizes().y()); ++row) {
    for (int column = 0; column < steps(bounds.sizes().x()); ++column) {
      const double x = bounds.min().x() + (column + 0.5) * spacing;
      const double y = bounds.min().y() + (row + 0.5) * spacing;
      const Vec3 p = x * u + y * v + height * n;
      bool in = true;
      for (std::size_t i = 0; i < polygon.size() && in; ++i) {
        const Vec3& a = polygon[i];
        in = way * n.dot((polygon[(i + 1) % polygon.size()] - a).cross(p - a)) >= 0;
      }
      if (in) points.push_back(p);
    }
  }
  return points;
}

std::vector<HalfSpace> without_redundant(std::span<const HalfSpace> cell, const Eigen::AlignedBox3d& box) {
  const double least_area = 1e-12 * box.diagonal().squaredNorm();
  std::vector<HalfSpace> kept(cell.begin(), cell.end());
  // The oldest first: later cuts lie closer to the piece.
  for (std::size_t i = 0; i < kept.size();) {
    std::vector<HalfSpace> others = kept;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (polygon_area_m2(plane_section(kept[i], others, box)) > least_area) {
      ++i;
      continue;
    }
    kept = std::move(others);
  }
  return kept;
}

}  // namespace mechane::geometry
