#include "client-sdk/picture/procedural_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::picture {
namespace {

constexpr float kGravity = 9.81F;

/// Triangles of a grid of (rows + 1) x (columns + 1) vertices.
void add_grid(MeshData& mesh, int rows, int columns) {
  const auto at = [columns](int row, int column) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = at(row, column);
      const std::uint32_t b = at(row, column + 1);
      const std::uint32_t c = at(row + 1, column + 1);
      const std::uint32_t d = at(row + 1, column);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  }
}

}  // namespace

MeshData superquadric_mesh(const Vec3& a_m, double e1, double e2, int rings, int sectors) {
  MeshData mesh;
  for (int ring = 0; ring <= rings; ++ring) {
    const double eta = kPi * (static_cast<double>(ring) / rings - 0.5);
    for (int sector = 0; sector <= sectors; ++sector) {
      const double omega = 2 * kPi * static_cast<double>(sector) / sectors;
      const double ce = std::max(std::cos(eta), 0.0);
      const double se = std::sin(eta);
      const double co = std::cos(omega);
      const double so = std::sin(omega);
      const Vec3 p(a_m.x() * signed_power(ce, e1) * signed_power(co, e2),
                   a_m.y() * signed_power(ce, e1) * signed_power(so, e2), a_m.z() * signed_power(se, e1));
      // Equation 16 of the method: the normals lie on a superquadric of their own.
      Vec3 n(signed_power(ce, 2 - e1) * signed_power(co, 2 - e2) / a_m.x(),
             signed_power(ce, 2 - e1) * signed_power(so, 2 - e2) / a_m.y(), signed_power(se, 2 - e1) / a_m.z());
      n.normalize();
      mesh.positions.push_back(p.cast<float>());
      mesh.normals.push_back(n.cast<float>());
    }
  }
  add_grid(mesh, rings, sectors);
  return mesh;
}

MeshData sphere_mesh(double radius_m, int rings, int sectors) {
  return superquadric_mesh(Vec3::Constant(radius_m), 1, 1, rings, sectors);
}

MeshData phalanx_mesh(double length_m, double radius_m, double taper) {
  const double half = 0.5 * length_m + 0.6 * radius_m;
  MeshData mesh = superquadric_mesh(Vec3(radius_m, radius_m, half), 0.65, 1.0, 16, 16);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3f p = mesh.positions[i];
    const Vec3f n = mesh.normals[i];
    const float along = p.z() / static_cast<float>(half);
    const float narrow = 1.0F - static_cast<float>(taper) * 0.5F * (1.0F + along);
    // z runs along the finger's x; the frame stays right-handed.
    mesh.positions[i] = Vec3f(p.z(), p.x() * narrow, p.y() * narrow);
    mesh.normals[i] = Vec3f(n.z(), n.x(), n.y());
  }
  return mesh;
}

MeshData box_mesh(const Vec3& half_m) {
  MeshData mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      Vec3 n = Vec3::Zero();
      n(axis) = side;
      Vec3 u = Vec3::Zero();
      u((axis + 1) % 3) = 1;
      const Vec3 v = n.cross(u);
      for (const auto& [s, t] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        mesh.positions.push_back((n + s * u + t * v).cwiseProduct(half_m).cast<float>());
        mesh.normals.push_back(n.cast<float>());
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U})
        mesh.indices.push_back(first + k);
    }
  }
  return mesh;
}

MeshData placeholder_mesh() {
  return box_mesh(Vec3::Constant(double{kPlaceholderHalf_m}));
}

MeshData disc_mesh(double radius_m, int sectors) {
  MeshData mesh;
  mesh.positions.emplace_back(0.0F, 0.0F, 0.0F);
  mesh.normals.push_back(Vec3f::UnitY());
  for (int i = 0; i < sectors; ++i) {
    const double a = 2 * kPi * static_cast<double>(i) / sectors;
    mesh.positions.push_back(Vec3(radius_m * std::cos(a), 0, radius_m * std::sin(a)).cast<float>());
    mesh.normals.push_back(Vec3f::UnitY());
    const auto here = static_cast<std::uint32_t>(1 + i);
    const auto next = static_cast<std::uint32_t>(1 + (i + 1) % sectors);
    mesh.indices.insert(mesh.indices.end(), {0U, next, here});
  }
  return mesh;
}

float flight_time_s(const WaterStream& stream) {
  const float drop = std::max(stream.p_WS.y() - stream.landing_height_m, 0.01F);
  const float vy = stream.v_W.y();
  return (vy + std::sqrt(vy * vy + 2 * kGravity * drop)) / kGravity;
}

float jet_breakup_s(const WaterStream& stream) {
  constexpr float kDensity_kg_per_m3 = 998;
  constexpr float kSurfaceTension_N_per_m = 0.0728F;
  const float speed = std::max(stream.v_W.norm(), 0.1F);
  const float weber = kDensity_kg_per_m3 * speed * speed * stream.width_m / kSurfaceTension_N_per_m;
  return 8.51F * stream.width_m * std::pow(weber, 0.31F) / speed;
}

MeshData stream_mesh(const WaterStream& stream) {
  const int ring_count = stream.jet ? 48 : 24;
  constexpr int kSectors = 12;
  const float flight_s = flight_time_s(stream);
  Vec3f across = stream.v_W.cross(Vec3f::UnitY());
  across = across.norm() > 1e-5F ? Vec3f(across.normalized()) : Vec3f(Vec3f::UnitZ());
  const float start_speed = std::max(stream.v_W.norm(), 0.3F);
  MeshData mesh;
  for (int ring = 0; ring <= ring_count; ++ring) {
    const float t = flight_s * static_cast<float>(ring) / static_cast<float>(ring_count);
    const Vec3f v = stream.v_W - Vec3f(0, kGravity * t, 0);
    const Vec3f p = stream.p_WS + stream.v_W * t - Vec3f(0, 0.5F * kGravity * t * t, 0);
    const Vec3f along = v.norm() > 1e-5F ? Vec3f(v.normalized()) : Vec3f(-Vec3f::UnitY());
    const Vec3f up = across.cross(along);
    // The same amount of water passes each ring, so the section shrinks as the speed grows.
    const float shrink = std::sqrt(start_speed / std::max(v.norm(), start_speed));
    const float half_width = 0.5F * stream.width_m * shrink;
    const float half_depth = (stream.jet ? 1.0F : 0.45F) * half_width;
    for (int sector = 0; sector <= kSectors; ++sector) {
      const float a = kTwoPiF * static_cast<float>(sector) / kSectors;
      const Vec3f n = (std::cos(a) * across * half_depth + std::sin(a) * up * half_width).normalized();
      mesh.positions.push_back(p + std::cos(a) * across * half_width + std::sin(a) * up * half_depth);
      mesh.normals.push_back(n);
      mesh.uv.emplace_back(static_cast<float>(sector) / kSectors, t);
    }
  }
  add_grid(mesh, ring_count, kSectors);
  return mesh;
}

}  // namespace mechane::picture
