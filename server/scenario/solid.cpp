#include "server/scenario/solid.hpp"

#include "server/geometry/mesh_check.hpp"

namespace mechane::scenario {
namespace {

/// Integrals over a solid, about a point near it, where no digits are lost.
struct Integrals {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();  ///< of x x^T
};

/// By signed tetrahedra from the reference point to each triangle.
Integrals integrals_of(const geometry::Mesh& mesh, const Vec3& about) {
  Integrals sum;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - about, b = mesh.vertices[t[1]] - about, c = mesh.vertices[t[2]] - about;
    const double six_volumes = a.dot(b.cross(c));
    const Vec3 corners = a + b + c;
    sum.volume += six_volumes / 6;
    sum.first += six_volumes / 24 * corners;
    sum.second +=
        six_volumes / 120 * (corners * corners.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }
  return sum;
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
  Integrals all;
  for (const geometry::NamedMesh& part : parts) {
    const Integrals one = integrals_of(part.mesh, about);
    const double sign = one.volume < 0 ? -1 : 1;  // a part may be inside out
    all.volume += sign * one.volume;
    all.first += sign * one.first;
    all.second += sign * one.second;
  }
  solid.volume_m3 = all.volume;
  if (!solid.is_closed()) return solid;
  const Vec3 middle = all.first / all.volume;
  const Mat3 spread = all.second / all.volume - middle * middle.transpose();
  solid.p_OC = about + middle;
  solid.inertia_per_kg_m2 = spread.trace() * Mat3::Identity() - spread;
  return solid;
}

}  // namespace mechane::scenario
