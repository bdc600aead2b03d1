#include "server/collision_build/solid.hpp"

#include <algorithm>

#include "server/geometry/mesh_check.hpp"

namespace mechane::collision_build {
namespace {

/// A ray through the exact middle of a symmetric part runs along edges of its triangles and counts them twice. Moved aside by a
/// millionth it meets faces.
Vec3 aside(const Vec3& direction) {
  return direction + 1e-7 * direction.norm() * Vec3(0.371, -0.713, 0.594);
}

}  // namespace

geometry::Mesh merged(std::span<const geometry::Mesh> parts) {
  geometry::Mesh whole;
  for (const geometry::Mesh& part : parts)
    whole.append(part);
  return whole;
}

double Solid::reach_m() const {
  return 1.5 * seam_gap_m_ + 1e-6;
}

Solid::Solid(std::span<const geometry::Mesh> parts, double seam_gap_m)
    : seam_gap_m_(parts.size() > 1 ? seam_gap_m : 0), whole_(merged(parts)) {
  for (const geometry::Mesh& part : parts) {
    const bool closed = geometry::open_edges(part) == 0;
    parts_.emplace_back(part, closed ? geometry::Inside::by_rays : geometry::Inside::by_winding_number);
    boxes_.push_back(part.bounds());
    closed_ = closed_ && closed;
  }
}

bool Solid::contains(const Vec3& p) const {
  if (closed_) return whole_.winding(p) > 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (boxes_[i].contains(p) && parts_[i].contains(p)) return true;
  }
  return false;
}

bool Solid::is_exposed(std::size_t part, const Vec3& p, const Vec3& n) const {
  const Vec3 before = p + reach_m() * n;
  for (std::size_t other = 0; other < parts_.size(); ++other) {
    if (other != part && boxes_[other].contains(before) && parts_[other].contains(before)) return false;
  }
  return true;
}

bool Solid::is_alone(std::size_t part, const std::array<Vec3, 3>& triangle) const {
  Eigen::AlignedBox3d box;
  for (const Vec3& corner : triangle)
    box.extend(corner);
  const Vec3 reach = Vec3::Constant(reach_m());
  const Eigen::AlignedBox3d near(box.min() - reach, box.max() + reach);
  for (std::size_t other = 0; other < parts_.size(); ++other) {
    if (other != part && boxes_[other].intersects(near)) return false;
  }
  return true;
}

bool Solid::is_in_crack(const Vec3& p, double air_side_m) const {
  if (seam_gap_m_ <= 0) return false;
  return whole_.closest(p, 0.5 * reach_m()).distance_m < air_side_m - 1e-6;
}

double Solid::walk(const Vec3& origin, const Vec3& direction, double limit) const {
  std::vector<geometry::RayHit> hits;
  whole_.cast(origin, aside(direction), hits);
  return closed_ ? walk_by_counting(hits, direction, limit) : walk_by_asking(hits, origin, direction, limit);
}

double Solid::walk_by_counting(std::span<const geometry::RayHit> hits, const Vec3& direction, double limit) const {
  int winding = 0;
  for (const geometry::RayHit& hit : hits)
    winding += hit.entering ? -1 : 1;
  const geometry::RayHit* last_exit = nullptr;
  for (const geometry::RayHit& hit : hits) {
    if (winding <= 0) {
      if (last_exit == nullptr) return 0;
      if (!is_crack(*last_exit, hit, direction)) break;
    }
    winding += hit.entering ? 1 : -1;
    last_exit = &hit;
  }
  return last_exit == nullptr ? 0 : std::min(last_exit->t, limit);
}

/// A ray may slip through a crack of a mesh that was mended: what lies between two hits is asked of the solid.
double Solid::walk_by_asking(std::span<const geometry::RayHit> hits, const Vec3& origin, const Vec3& direction,
                             double limit) const {
  if (hits.empty() || !contains(origin + 0.5 * hits.front().t * direction)) return 0;
  for (std::size_t i = 0; i + 1 < hits.size() && hits[i].t < limit; ++i) {
    const double middle = 0.5 * (hits[i].t + hits[i + 1].t);
    if (!is_crack(hits[i], hits[i + 1], direction) && !contains(origin + middle * direction)) return hits[i].t;
  }
  return std::min(hits.back().t, limit);
}

/// A ray may cross a crack at a slant, so its way through the air is longer than the crack is wide: the width is measured along the faces'
/// normals.
bool Solid::is_crack(const geometry::RayHit& exit, const geometry::RayHit& entry, const Vec3& direction) const {
  const Vec3 way = (entry.t - exit.t) * direction;
  if (way.norm() < 1e-9) return true;  // faces in contact
  const Vec3 n_exit = whole_.triangle_normal(exit.triangle);
  const Vec3 n_entry = whole_.triangle_normal(entry.triangle);
  return n_exit.dot(n_entry) < -0.5 && std::max(std::abs(way.dot(n_exit)), std::abs(way.dot(n_entry))) <= seam_gap_m_;
}

}  // namespace mechane::collision_build
