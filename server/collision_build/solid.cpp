#include "server/collision_build/solid.hpp"

#include <algorithm>

#include "server/geometry/mesh_check.hpp"

namespace mechane::collision_build {
namespace {

geometry::Mesh merge_closed(std::span<const geometry::Mesh> parts) {
  geometry::Mesh whole;
  for (const geometry::Mesh& part : parts) {
    if (geometry::open_edges(part) == 0) whole.append(part);
  }
  return whole;
}

/// A ray through the exact middle of a symmetric part runs along edges of its triangles and counts them twice. Moved aside by a
/// millionth it meets faces.
Vec3 aside(const Vec3& direction) {
  return direction + 1e-7 * direction.norm() * Vec3(0.371, -0.713, 0.594);
}

}  // namespace

Solid::Solid(std::span<const geometry::Mesh> welded_parts, double seam_gap_m)
    : seam_gap_m_(welded_parts.size() > 1 ? seam_gap_m : 0), whole_(merge_closed(welded_parts)) {
  for (const geometry::Mesh& part : welded_parts) {
    parts_.emplace_back(part);
    boxes_.push_back(part.bounds());
    closed_.push_back(geometry::open_edges(part) == 0);
  }
}

bool Solid::is_exposed(std::size_t part, const Vec3& p, const Vec3& n) const {
  // Half a gap more than the widest crack, so that a neighbour across it is reached.
  const Vec3 before = p + (1.5 * seam_gap_m_ + 1e-6) * n;
  for (std::size_t other = 0; other < parts_.size(); ++other) {
    if (other == part || !closed_[other] || !boxes_[other].contains(before)) continue;
    if (parts_[other].winding(before) > 0) return false;
  }
  return true;
}

double Solid::walk(std::size_t part, const Vec3& origin, const Vec3& direction, double limit) const {
  std::vector<geometry::RayHit> hits;
  if (!closed_[part]) {
    parts_[part].cast(origin, aside(direction), hits);
    return hits.empty() ? 0 : std::min(hits.back().t, limit);
  }
  whole_.cast(origin, aside(direction), hits);
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
