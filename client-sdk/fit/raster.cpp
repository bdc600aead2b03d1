#include "client-sdk/fit/raster.hpp"

#include <algorithm>
#include <cmath>

#include "server/geometry/area_normal.hpp"

namespace mechane::fit {
namespace {

constexpr std::size_t kMostNeighbours = 64;  // with more, at the tip of a fan, faces are shaded flat

/// Twice the signed area of (a, b, p) on the screen.
double edge(const Vec3& a, const Vec3& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

int clamped(double value, int low, int high) {
  return static_cast<int>(std::clamp(value, static_cast<double>(low), static_cast<double>(high)));
}

void draw_triangle(const std::array<Vec3, 3>& p, std::uint32_t index, DepthBuffer& buffer) {
  const double area = edge(p[0], p[1], p[2].x(), p[2].y());
  if (std::abs(area) < 1e-12) return;
  const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  const int x_end = clamped(std::ceil(right + 0.5), 0, buffer.width);
  const int y_end = clamped(std::ceil(bottom + 0.5), 0, buffer.height);
  for (int y = clamped(std::floor(top - 0.5), 0, buffer.height); y < y_end; ++y) {
    for (int x = clamped(std::floor(left - 0.5), 0, buffer.width); x < x_end; ++x) {
      const double w0 = edge(p[1], p[2], x + 0.5, y + 0.5) / area;
      const double w1 = edge(p[2], p[0], x + 0.5, y + 0.5) / area;
      const double w2 = 1 - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) continue;
      const auto z = static_cast<float>(w0 * p[0].z() + w1 * p[1].z() + w2 * p[2].z());
      const std::size_t at = static_cast<std::size_t>(y) * buffer.width + x;
      if (z <= buffer.z[at]) continue;
      buffer.z[at] = z;
      buffer.triangle[at] = index;
    }
  }
}

}  // namespace

Vec3 View::to_screen(const Vec3& p_O) const {
  const Vec3 p_V = px_per_m * (R_VO * (p_O - center_O));
  return {0.5 * width + p_V.x(), 0.5 * height - p_V.y(), p_V.z()};
}

Vec3 View::to_object(const Vec3& p_screen) const {
  const Vec3 p_V(p_screen.x() - 0.5 * width, 0.5 * height - p_screen.y(), p_screen.z());
  return center_O + R_VO.transpose() * p_V / px_per_m;
}

View View::finer(int factor) const {
  View out = *this;
  out.px_per_m *= factor;
  out.width *= factor;
  out.height *= factor;
  return out;
}

View view_from(const geometry::Mesh& mesh, double azimuth, double elevation, Vec3& size_m) {
  View view;
  const Vec3 viewer(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                    std::cos(azimuth) * std::cos(elevation));
  const Vec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
  view.R_VO.row(0) = right;
  view.R_VO.row(1) = viewer.cross(right);
  view.R_VO.row(2) = viewer;
  Eigen::AlignedBox3d box;
  for (const Vec3& v : mesh.vertices)
    box.extend(view.R_VO * v);
  view.center_O = view.R_VO.transpose() * box.center();
  size_m = box.diagonal();
  return view;
}

DepthBuffer rasterise(const geometry::Mesh& mesh, const View& view) {
  DepthBuffer buffer{view.width, view.height, {}, {}};
  const auto pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
  buffer.z.assign(pixels, DepthBuffer::kFar);
  buffer.triangle.assign(pixels, DepthBuffer::kNothing);
  std::vector<Vec3> screen;
  screen.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices)
    screen.push_back(view.to_screen(v));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    draw_triangle({screen[v[0]], screen[v[1]], screen[v[2]]}, t, buffer);
  }
  return buffer;
}

std::vector<std::array<Vec3f, 3>> corner_normals(const geometry::Mesh& mesh, double crease_rad) {
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  std::vector<Vec3> face(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    face[t] = geometry::area_normal(mesh, t);
    for (const std::uint32_t v : mesh.triangles[t])
      around[v].push_back(t);
  }
  const double cosine = std::cos(crease_rad);
  std::vector<std::array<Vec3f, 3>> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 sum = face[t];
      if (around[mesh.triangles[t][k]].size() > kMostNeighbours) {
        normals[t][k] = sum.normalized().cast<float>();
        continue;
      }
      for (const std::uint32_t other : around[mesh.triangles[t][k]]) {
        if (other != t && face[other].dot(face[t]) >= cosine * face[other].norm() * face[t].norm()) sum += face[other];
      }
      normals[t][k] = sum.normalized().cast<float>();
    }
  }
  return normals;
}

}  // namespace mechane::fit
