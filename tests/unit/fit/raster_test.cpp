#include "client-sdk/fit/raster.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/geometry/superquadric_mesh.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::fit {
namespace {

View framed(const geometry::Mesh& mesh, double azimuth, double elevation) {
  Vec3 size_m;
  View view = view_from(mesh, azimuth, elevation, size_m);
  view.px_per_m = 100 / size_m.maxCoeff();
  view.width = view.height = 110;
  return view;
}

RC_GTEST_PROP(Raster, EachPixelShowsAPointOfItsTriangleAndNothingStandsBeforeIt, (int azimuth, int elevation)) {
  const geometry::Mesh mesh = geometry::tessellate({{0.3, 0.2, 0.5}, 0.4, 1.3}, 6);
  const View view = framed(mesh, azimuth, std::remainder(elevation, 3.0));
  const DepthBuffer buffer = rasterise(mesh, view);
  std::size_t covered = 0;
  for (std::size_t pixel = 0; pixel < buffer.z.size(); pixel += 7) {
    if (!buffer.covered(pixel)) continue;
    ++covered;
    const double x = static_cast<double>(pixel % 110) + 0.5;
    const double y = static_cast<double>(pixel / 110) + 0.5;
    const Vec3 p = view.to_object({x, y, buffer.z[pixel]});
    RC_ASSERT((view.to_screen(p) - Vec3(x, y, buffer.z[pixel])).norm() < 1e-6);
    const auto& v = mesh.triangles[buffer.triangle[pixel]];
    const Vec3 n =
        (mesh.vertices[v[1]] - mesh.vertices[v[0]]).cross(mesh.vertices[v[2]] - mesh.vertices[v[0]]).normalized();
    RC_ASSERT(std::abs(n.dot(p - mesh.vertices[v[0]])) < 1e-4);
    // The shape is convex: what is seen faces the viewer.
    RC_ASSERT(n.dot(view.R_VO.row(2)) > -1e-3);
  }
  RC_ASSERT(covered > 100);
}

TEST(Raster, ABoxCoversItsOwnArea) {
  const geometry::Mesh mesh = test::box({0.5, 0.25, 0.1});
  const DepthBuffer buffer = rasterise(mesh, framed(mesh, 0, 0));
  std::size_t covered = 0;
  for (std::size_t pixel = 0; pixel < buffer.z.size(); ++pixel)
    covered += buffer.covered(pixel) ? 1 : 0;
  EXPECT_EQ(covered, 100U * 50U);
}

TEST(Raster, NormalsAreSmoothOnACylindersSideAndKeepItsRimSharp) {
  const geometry::Mesh mesh = test::cylinder(0.1, 0.2, 40);
  const auto normals = corner_normals(mesh, 0.7);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices[mesh.triangles[t][k]];
      const Vec3f n = normals[t][k];
      const bool cap = t % 4 >= 2;
      const Vec3f expected = cap ? Vec3f(0, 0, p.z() > 0 ? 1 : -1) : Vec3(p.x(), p.y(), 0).normalized().cast<float>();
      // Two of three faces at a side's corner lie on one side of it: a twentieth of a turn is near enough.
      EXPECT_GT(n.dot(expected), 0.99F) << t << " " << k;
    }
  }
}

}  // namespace
}  // namespace mechane::fit
