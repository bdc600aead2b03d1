#include "server/scenario/solid.hpp"

#include "server/geometry/mesh_check.hpp"

namespace mechane::scenario {
namespace {

/// Integrals over a solid or its skin, about a point near it, so that no digits are lost.
struct Integrals {
  double size = 0;  ///< m^3; of a skin m^2
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();  ///< of x x^T
};

/// By signed tetrahedra from the reference point to each triangle; of a skin, by the triangles. The moments of a simplex of n corners
/// have its size over n and over n (n + 1).
Integrals integrals_of(const geometry::Mesh& mesh, const Vec3& about, bool skin) {
  const Vec3 divisors = skin ? Vec3(2, 6, 24) : Vec3(6, 24, 120);
  Integrals sum;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - about, b = mesh.vertices[t[1]] - about, c = mesh.vertices[t[2]] - about;
    const double product = skin ? (b - a).cross(c - a).norm() : a.dot(b.cross(c));  // two areas, or six volumes
    const Vec3 corners = a + b + c;
    sum.size += product / divisors[0];
    sum.first += product / divisors[1] * corners;
    sum.second += product / divisors[2] *
                  (corners * corners.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return sum;
}

Integrals integrals_of(std::span<const geometry::NamedMesh> parts, const Vec3& about, bool skin) {
  Integrals all;
  for (const geometry::NamedMesh& part : parts) {
    const Integrals one = integrals_of(part.mesh, about, skin);
    const double sign = one.size < 0 ? -1 : 1;  // a part may be inside out
    all.size += sign * one.size;
    all.first += sign * one.first;
    all.second += sign * one.second;
  }
  return all;
}

}  // namespace

Solid solid_of(std::span<const geometry::NamedMesh> parts) {
  Solid solid;
  Eigen::AlignedBox3d box;
  for (const geometry::NamedMesh& part : parts) {
    box.extend(part.mesh.bounds());
    solid.open_edges += geometry::open_edges(part.mesh);
  }
  if (box.isEmpty()) return solid;
  solid.box_m3 = box.volume();
  const Vec3 about = box.center();
  Integrals all = integrals_of(parts, about, false);
  solid.volume_m3 = all.size;
  if (!solid.is_closed()) all = integrals_of(parts, about, true);
  if (all.size <= 0) return solid;
  const Vec3 middle = all.first / all.size;
  const Mat3 spread = all.second / all.size - middle * middle.transpose();
  solid.p_OC = about + middle;
  solid.inertia_per_kg_m2 = spread.trace() * Mat3::Identity() - spread;
  return solid;
}

}  // namespace mechane::scenario
